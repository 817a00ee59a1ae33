// Finds scenes of the benchmarks and chooses their views.
#include "Bench/BenchScenes.h"

#include <cstdlib>
#include <filesystem>

#include "LanternCore/Text/Log.h"
#include "LanternCore/Text/Quote.h"
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
	if (Scene.Name == "sponza") { Scene.Camera = FCameraOption{{-9, 1.6, -0.4}, {10, 3.2, -1.2}, 60}; }
	else if (Scene.Name == "black_forest")
	{
		Scene.Camera = FCameraOption{{541, 20, -200}, {300, 0, -300}, 60};
		Scene.bNoSceneLights = true;
	}
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

FPictureOptions MakeBenchPicture(const FBenchScene& Scene, const std::string& Size, bool bIsCpu)
{
	FPictureOptions Picture;
	Picture.Scene = Scene.File;
	Picture.Camera = Scene.Camera;
	Picture.bNoSceneLights = Scene.bNoSceneLights;
	Picture.Sun = FSunOption{4, {0.25, -1, 0.35}, 0.53};
	Picture.Width = bIsCpu ? 640 : 1280;
	Picture.Height = bIsCpu ? 360 : 720;
	if (!Size.empty()) { ParseSize(Size, Picture); }
	return Picture;
}

} // namespace Lantern
