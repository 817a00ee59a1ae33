// Finds scenes of the benchmarks and chooses their views.
#include "Bench/BenchScenes.h"

#include <cstdlib>
#include <filesystem>

#include "LanternCore/Text/Log.h"
#include "LanternCore/Text/Quote.h"
#include "LanternHost/BuiltinScenes.h"
#include "Session.h"

namespace Lantern
{

namespace fs = std::filesystem;

FBenchScene MakeBenchScene(const std::string& File)
{
	FBenchScene Scene;
	Scene.File = File;
	const fs::path Path(File);
	Scene.Name = EscapeText(Path.has_parent_path() ? Path.parent_path().filename().string() : Path.stem().string());
	return Scene;
}

std::optional<FBenchScene> FindBenchScene(const char* Path, const char* Bench)
{
	const char* const Folder = std::getenv("LANTERN_SCENES");
	const fs::path Root = Folder ? fs::path(Folder) : fs::path(FindPluginFolders().Root) / ".." / "shared" / "scenes";
	std::error_code Error;
	if (fs::exists(Root / Path, Error)) { return MakeBenchScene((Root / Path).lexically_normal().string()); }
	LogWarning("{}: {} is not there (LANTERN_SCENES names its folder); left out", Bench, EscapePath((Root / Path).string()));
	return std::nullopt;
}

int MakeBenchPicture(const FBenchScene& Scene, const std::string& View, const std::string& Size, bool bIsCpu, FPictureOptions& Out)
{
	Out = {};
	Out.Scene = Scene.File;
	Out.View = View;
	Out.Width = bIsCpu ? 640 : 1280;
	Out.Height = bIsCpu ? 360 : 720;
	if (!Size.empty()) { ParseSize(Size, Out); }
	if (const int Status = ResolveSceneView(Out); Status != ExitDone) { return Status; }
	// A benchmark of shadows needs a sun, also in a scene that has only other lights.
	if (!Out.Sun && !IsBuiltinScene(Out.Scene)) { Out.Sun = FViewSun{4, {0.25, -1, 0.35}, 0.53}; }
	return ExitDone;
}

} // namespace Lantern
