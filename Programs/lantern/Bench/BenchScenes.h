// Scenes of the benchmarks, with the views and the sun of the project's other figures.
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

/// Describes a scene. The name of its folder decides the camera and the lights.
FBenchScene MakeBenchScene(const std::string& File);
/// Looks for Path under the folder that LANTERN_SCENES names, otherwise under shared/scenes beside the repository. Nothing, with a warning
/// in the log, if it is not there.
std::optional<FBenchScene> FindBenchScene(const char* Path, const char* Bench);
/// Size is WIDTHxHEIGHT. If it is empty, the picture has 1280×720 pixels, on a CPU device 640×360.
FPictureOptions MakeBenchPicture(const FBenchScene& Scene, const std::string& Size, bool bIsCpu);

} // namespace Lantern
