// Scenes of the benchmarks, and their views.
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
};

/// Names a scene after its folder.
FBenchScene MakeBenchScene(const std::string& File);
/// Looks for Path under the folder that LANTERN_SCENES names, otherwise under shared/scenes beside the repository. Nothing, with a warning
/// in the log, if it is not there.
std::optional<FBenchScene> FindBenchScene(const char* Path, const char* Bench);
/// Makes the picture of a scene with the view of that name. If View is empty, it is the view main, if there is one. Size is WIDTHxHEIGHT;
/// if it is empty, the picture has 1280×720 pixels, on a CPU device 640×360. Returns an exit status.
int MakeBenchPicture(const FBenchScene& Scene, const std::string& View, const std::string& Size, bool bIsCpu, FPictureOptions& Out);

} // namespace Lantern
