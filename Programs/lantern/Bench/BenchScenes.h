// Scenes that benchmarks run on, with the views and the sun of the project's other figures.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "Options.h"

namespace Lantern
{

struct FBenchScene
{
	std::string Name, File;
	std::optional<FCameraOption> Camera;
	bool bNoSceneLights = false;
};

/// What is known of scenes by the name of their folder.
FBenchScene MakeBenchScene(const std::string& File);
/// Under the folder that LANTERN_SCENES names, else shared/scenes beside the repository; none if it is not there, which
/// is said. Path: relative to it.
std::optional<FBenchScene> FindBenchScene(const char* Path, const char* Bench);
/// Size: WIDTHxHEIGHT; empty: 1280×720, on a CPU device 640×360.
FPictureOptions MakeBenchPicture(const FBenchScene& Scene, const std::string& Size, bool bIsCpu);

} // namespace Lantern
