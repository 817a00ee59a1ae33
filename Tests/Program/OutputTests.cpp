// What the program writes: results on standard output and in files, by the names that scripts rely on.
#include <set>

#include "LanternImage/ImageIO.h"
#include "ProgramTools.h"

namespace Lantern
{
namespace
{

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::Not;

std::vector<std::string> GetKeys(const nlohmann::json& Object)
{
	std::vector<std::string> Keys;
	for (const auto& [Key, Value] : Object.items()) { Keys.push_back(Key); }
	return Keys;
}

class FOutputTest : public ::testing::Test
{
protected:
	std::string At(const std::string& Name) const { return Folder.GetPath() + "/" + Name; }
	/// A run that must succeed without a warning.
	FProgramRun RunCleanly(std::vector<std::string> Arguments)
	{
		const FProgramRun Run = RunProgram(Arguments);
		EXPECT_EQ(Run.Status, 0) << Run.Err;
		EXPECT_THAT(Run.Err, Not(HasSubstr("error")));
		EXPECT_THAT(Run.Err, Not(HasSubstr("warning")));
		return Run;
	}
	std::vector<std::string> RenderPasses(std::vector<std::string> Arguments)
	{
		Arguments.insert(Arguments.begin(), "render");
		Arguments.insert(Arguments.end(), {"--size", "32x24", "--validate", "--json", At("passes.json")});
		RunCleanly(Arguments);
		Json = ReadJson(At("passes.json"));
		std::vector<std::string> Names;
		for (const nlohmann::json& Pass : Json["passes"]) { Names.push_back(Pass["name"]); }
		return Names;
	}

	FTemporaryFolder Folder;
	nlohmann::json Json;
};

TEST_F(FOutputTest, RenderWritesWhatTheContractNames)
{
	// A build without OpenImageIO writes PFM only.
	const std::string Picture = CheckImageOutput(At("a.png")) ? "a.png" : "a.pfm";
	const FProgramRun Run = RunCleanly({"render", "planes", "--size", "40x30", "--frames", "3", "--set", "r.RT.AO=0", "--set", "r.RT.GI=0",
	    "--set", "r.RT.Reflections=0", "--set", "r.RT.Shadow.MoreRays=0", "--validate", "-o", At(Picture), "--json", At("a.json")});
	EXPECT_THAT(Run.Out, HasSubstr("GPU ms"));
	EXPECT_THAT(Run.Out, HasSubstr("SunShadow"));
	EXPECT_THAT(Run.Err, HasSubstr("loaded in")) << "the log";
	const nlohmann::json A = ReadJson(At("a.json"));
	EXPECT_THAT(GetKeys(A), IsSupersetOf({"device", "driver", "width", "height", "frames", "passes", "frame_gpu_ms", "frame_cpu_ms", "rays",
	                            "memory", "rtpso"}));
	EXPECT_THAT(GetKeys(A["memory"]), IsSupersetOf({"blas", "tlas", "sbt", "textures", "peak"}));
	EXPECT_THAT(GetKeys(A["rtpso"]), IsSupersetOf({"hit_groups", "compiled", "missing", "link_ms"}));
	EXPECT_EQ(A["width"], 40);
	EXPECT_EQ(A["height"], 30);
	EXPECT_EQ(A["frames"], 3);
	uint64_t Rays = 0;
	for (const nlohmann::json& Pass : A["passes"])
	{
		EXPECT_THAT(GetKeys(Pass), IsSupersetOf({"name", "gpu_ms", "cpu_ms", "rays"}));
		EXPECT_GE(Pass["cpu_ms"].get<double>(), 0.0);
		Rays += Pass["rays"].get<uint64_t>();
	}
	EXPECT_EQ(A["rays"], Rays);
	EXPECT_EQ(Rays, 40u * 30u);
	EXPECT_GT(A["memory"]["blas"].get<uint64_t>(), 0u);
	EXPECT_GE(A["memory"]["peak"].get<uint64_t>(), A["memory"]["blas"].get<uint64_t>());
	EXPECT_EQ(ListFolder(Folder.GetPath()), (std::vector<std::string>{"a.json", Picture})) << "no temporary file stays";
}

/// A triangle without light of its own.
constexpr const char* Triangle = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
	"meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
	"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [-1, -1, 0], "max": [1, 1, 0]}],
	"bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36,
	"uri": "data:application/octet-stream;base64,AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAAAAAAAAgD8AAAAA"}]})";

TEST_F(FOutputTest, ViewIsTakenBeforeTheOtherOptions)
{
	Folder.Write("a.gltf", Triangle);
	Folder.Write("views.json", R"({"a.gltf": [{"name": "main", "camera": [0, 0, 3, 0, 0, 0, 50], "sun": [2, 0, 0, -1, 0]},
		{"name": "near", "camera": [0, 0, 1, 0, 0, 0, 50], "sun": [2, 0, 0, -1, 0], "sky": [0.25, 0.5, 1]}]})");
	const auto Render = [&](const std::vector<std::string>& View) {
		std::vector<std::string> Arguments = {"render", At("a.gltf"), "--size", "24x16", "--set", "r.RT.GI=0", "--set",
		    "r.RT.Reflections=0", "-o", At("a.pfm"), "--json", At("a.json")};
		Arguments.insert(Arguments.end(), View.begin(), View.end());
		RunCleanly(Arguments);
		FImage Image;
		EXPECT_TRUE(LoadImageFile(At("a.pfm"), Image));
		Json = ReadJson(At("a.json"));
		return Image.Pixels;
	};
	const std::string Main = "0,0,3,0,0,0,50", Near = "0,0,1,0,0,0,50", Sun = "2,0,0,-1,0";
	const auto ByCamera = Render({"--camera", Main, "--sun", Sun});
	EXPECT_TRUE(Json["view"].is_null());
	EXPECT_EQ(Render({}), ByCamera) << "main, since nothing is named";
	EXPECT_EQ(Json["view"], "main");
	EXPECT_EQ(Render({"--view", "near"}), Render({"--camera", Near, "--sun", Sun, "--sky", "0.25,0.5,1"}));
	EXPECT_EQ(Render({"--view", "near", "--sky", "0,0,0"}), Render({"--camera", Near, "--sun", Sun}));
	EXPECT_EQ(Render({"--view", "near", "--camera", Main, "--sky", "0,0,0"}), ByCamera);
	EXPECT_EQ(Json["view"], "near");
	RunCleanly({"reference", At("a.gltf"), "--size", "8x8", "--spp", "1", "--view", "near", "--json", At("r.json")});
	EXPECT_EQ(ReadJson(At("r.json"))["view"], "near");
}

TEST_F(FOutputTest, RenderSettlesUnlessTheNumberOfFramesIsGiven)
{
	const auto Render = [&](std::vector<std::string> Arguments) {
		Arguments.insert(Arguments.begin(), "render");
		Arguments.insert(Arguments.end(), {"--size", "64x48", "--json", At("a.json")});
		const FProgramRun Run = RunCleanly(Arguments);
		Json = ReadJson(At("a.json"));
		return Run.Out;
	};
	EXPECT_THAT(
	    Render({"furnace", "--set", "r.RT.AO=0", "--set", "r.RT.GI=0", "--set", "r.RT.Reflections=0", "--set", "r.RT.Lights.Emissive=0"}),
	    HasSubstr("frames: 1, settled"));
	EXPECT_EQ(Json["frames"], 1) << "nothing accumulates";
	const std::string Noisy = Render({"courtyard"});
	const uint32_t Frames = Json["frames"];
	EXPECT_GT(Frames, 8u) << "rays are few, and their noise takes frames to average";
	EXPECT_LT(Frames, 64u);
	EXPECT_EQ(Json["settled"], true);
	EXPECT_THAT(Noisy, HasSubstr("frames: " + std::to_string(Frames) + ", settled"));
	EXPECT_THAT(Render({"planes", "--sky", "1,1,1", "--frames", "1", "--set", "r.RT.GI=0", "--set", "r.RT.Reflections=0"}),
	    HasSubstr("frames: 1\n"));
	EXPECT_EQ(Json["frames"], 1);
	EXPECT_TRUE(Json["settled"].is_null());
}

TEST_F(FOutputTest, PassesThatTheSceneDoesNotNeedAreAbsent)
{
	EXPECT_THAT(RenderPasses({"planes"}), Contains("DiffuseGI")) << "on by default";
	EXPECT_THAT(RenderPasses({"planes", "--set", "r.RT.GI=0", "--set", "r.RT.Reflections=0"}), Contains("SunShadow"));
	EXPECT_THAT(Json["rtpso"]["hit_groups"], 0) << "ray queries need no pipeline";
	EXPECT_THAT(RenderPasses({"furnace"}), Contains("ShadowLights")) << "its walls emit";
	EXPECT_GT(Json["rays"].get<uint64_t>(), 0u);
	const std::vector<std::string> Sunless =
	    RenderPasses({"furnace", "--set", "r.RT.GI=0", "--set", "r.RT.Reflections=0", "--set", "r.RT.Lights.Emissive=0"});
	EXPECT_THAT(Sunless, Not(Contains("ShadowLights")));
	EXPECT_THAT(Sunless, Not(Contains("SunShadow")));
	EXPECT_THAT(Sunless, Not(Contains("Skinning")));
	EXPECT_THAT(Sunless, Not(Contains("ShaderTable")));
	EXPECT_EQ(Json["rays"], 0);
	EXPECT_EQ(Json["memory"]["blas"], 0) << "nobody traces rays";
	EXPECT_EQ(Json["memory"]["tlas"], 0);
	EXPECT_THAT(RenderPasses({"planes", "--set", "r.RT.Shadow=0", "--set", "r.RT.GI=0", "--set", "r.RT.Reflections=0"}),
	    Not(Contains("SunShadow")));
	EXPECT_THAT(RenderPasses({"planes", "--set", "r.RT.GI=0", "--set", "r.RT.Reflections=0", "--set", "r.RT.Shadow.Path=1"}),
	    Contains("SunShadow"));
	EXPECT_EQ(Json["rtpso"]["hit_groups"], 1);
	EXPECT_GT(Json["memory"]["sbt"].get<uint64_t>(), 0u);
}

TEST_F(FOutputTest, EverySceneNameOfTheListRenders)
{
	const FProgramRun List = RunProgram({"render", "--list"});
	EXPECT_EQ(List.Status, 0);
	EXPECT_EQ(List.Err, "");
	std::istringstream Lines(List.Out);
	uint32_t Scenes = 0;
	for (std::string Line; std::getline(Lines, Line); ++Scenes)
	{
		const std::string Name = Line.substr(0, Line.find(' '));
		RunCleanly({"render", Name, "--size", "16x16", "--frames", "3", "--validate"});
	}
	EXPECT_GE(Scenes, 10u);
}

TEST_F(FOutputTest, PictureIsTheSameWhateverItsFileAndLastFrameCounts)
{
	if (!CheckImageOutput(At("a.exr"))) { GTEST_SKIP() << "a build without OpenImageIO"; }
	for (const char* Name : {"a.pfm", "a.exr"})
	{
		RunCleanly({"render", "furnace:0.5", "--set", "r.RT.GI=0", "--set", "r.RT.Reflections=0", "--set", "r.RT.Lights.Emissive=0",
		    "--size", "16x12", "--validate", "-o", At(Name)});
	}
	FImage A, B;
	ASSERT_TRUE(LoadImageFile(At("a.pfm"), A));
	ASSERT_TRUE(LoadImageFile(At("a.exr"), B));
	EXPECT_EQ(A.Width, 16u);
	EXPECT_EQ(A.Height, 12u);
	EXPECT_EQ(A.Pixels, B.Pixels);
	RunCleanly({"render", "furnace:0.5", "--set", "r.RT.GI=0", "--set", "r.RT.Reflections=0", "--set", "r.RT.Lights.Emissive=0", "--size",
	    "16x12", "--frames", "3", "-o", At("b.pfm")});
	ASSERT_TRUE(LoadImageFile(At("b.pfm"), B));
	EXPECT_EQ(A.Pixels, B.Pixels) << "nothing moves and nothing is random here";
}

TEST_F(FOutputTest, FileOfBeforeIsReplacedWhole)
{
	Folder.Write("a.pfm", std::string(100'000, 'x'));
	RunCleanly({"render", "furnace", "--size", "4x4", "--set", "r.RT.GI=0", "--set", "r.RT.Reflections=0", "--set",
	    "r.RT.Lights.Emissive=0", "-o", At("a.pfm")});
	EXPECT_LT(ReadFile(At("a.pfm")).size(), 400u);
	EXPECT_EQ(ListFolder(Folder.GetPath()), std::vector<std::string>{"a.pfm"});
}

// In a furnace all light is the same, and cells know it.
TEST_F(FOutputTest, AuditSaysThatCellsOfAFurnaceAreRight)
{
	const auto Audit = [&](const char* Route) {
		return RunProgram({"render", "furnace:0.5", "--size", "32x32", "--frames", "48", "--set", Route, "--set", "r.RT.GI.Residual=1",
		    "--set", "r.RT.GI.Cells.UpdatesPerSecond=300000", "--validate", "--json", At("audit.json")});
	};
	const FProgramRun Run = Audit("r.RT.GI=3");
	EXPECT_EQ(Run.Status, 0) << Run.Err;
	EXPECT_THAT(Run.Err, Not(HasSubstr("warning")));
	EXPECT_THAT(Run.Out, HasSubstr("followed paths have"));
	const nlohmann::json Found = ReadJson(At("audit.json"))["radiance_audit"];
	EXPECT_GT(Found["all"]["paths"].get<double>(), 5000.0);
	EXPECT_NEAR(Found["all"]["ratio"].get<double>(), 1.0, 0.03) << "of the second half of the frames";
	EXPECT_GT(Found["cells"]["paths"].get<double>(), 0.99 * Found["all"]["paths"].get<double>()) << "a few coarse ones stand in";
	EXPECT_TRUE(Found["leaves"]["ratio"].is_null());
	const FProgramRun Other = Audit("r.RT.GI=1");
	EXPECT_EQ(Other.Status, 0) << Other.Err;
	EXPECT_THAT(Other.Err, HasSubstr("no path of r.RT.GI 3"));
	EXPECT_FALSE(ReadJson(At("audit.json")).contains("radiance_audit"));
}

// In a furnace all light is the same: that of the radiance cell which the end of a path takes is that of the pixel.
TEST_F(FOutputTest, ExplainedPixelHasTheLightOfItsRadianceCell)
{
	const FProgramRun Run = RunCleanly({"render", "furnace:0.5", "--size", "32x32", "--frames", "48", "--set", "r.RT.GI=3", "--set",
	    "r.RT.GI.Cells.UpdatesPerSecond=300000", "--validate", "--explain", "16,16", "--json", At("explained.json")});
	EXPECT_THAT(Run.Out, HasSubstr("pixel 16,16"));
	const nlohmann::json Explained = ReadJson(At("explained.json"))["explanation"];
	ASSERT_TRUE(Explained["explained"].get<bool>());
	ASSERT_TRUE(Explained["surface"].get<bool>());
	ASSERT_EQ(Explained["radiance_cells"].size(), 4u);
	// A cell knows the light of the emissive walls as well, which pixels have apart.
	const nlohmann::json& Signals = Explained["signals"];
	const double Light = Signals["diffuse_gi"][1].get<double>() + Signals["local_diffuse"][1].get<double>();
	EXPECT_GT(Light, 0.0);
	int Used = 0;
	for (const nlohmann::json& Link : Explained["radiance_cells"])
	{
		if (!Link["used"].get<bool>()) { continue; }
		++Used;
		EXPECT_GT(Link["cell"]["updates"].get<int>(), 0);
		EXPECT_NEAR(Link["cell"]["light"][1].get<double>(), Light, 0.1 * Light) << "a mean of several paths";
	}
	EXPECT_EQ(Used, 1);
}

TEST_F(FOutputTest, InfoTellsWhatRunsAndWhyNot)
{
	const FProgramRun Run = RunCleanly({"info", "--json", At("info.json")});
	EXPECT_THAT(Run.Out, HasSubstr("rung"));
	const nlohmann::json Devices = ReadJson(At("info.json"))["devices"];
	ASSERT_GE(Devices.size(), 1u);
	for (const nlohmann::json& Device : Devices)
	{
		EXPECT_THAT(GetKeys(Device), IsSupersetOf({"index", "device", "driver", "rung", "features", "missing", "usable"}));
		ASSERT_GE(Device["features"].size(), 3u);
		for (const nlohmann::json& Feature : Device["features"])
		{
			EXPECT_TRUE(Feature["runs"].get<bool>() || Feature["why"] != "") << Feature.dump();
		}
	}
	const FProgramRun Chosen = RunProgram({"render", "furnace", "--size", "8x8", "--set", "r.RT.GI=0", "--set", "r.RT.Reflections=0",
	    "--set", "r.RT.Lights.Emissive=0", "--device", "0"});
	EXPECT_THAT(Chosen.Err, HasSubstr(Devices[0]["device"].get<std::string>()));
}

TEST_F(FOutputTest, FrameBenchmarkTimesEachPassOnTheDevice)
{
	const FProgramRun Run = RunProgram(
	    {"bench", "frame", "--quick", "--objects", "1000", "--skinned", "2", "--rounds", "1", "--validate", "--json", At("frame.json")});
	if (Run.Status == 3) { GTEST_SKIP() << "no ray-tracing pipelines"; }
	ASSERT_EQ(Run.Status, 0) << Run.Err;
	EXPECT_THAT(Run.Out, HasSubstr("GPU ms"));
	for (const nlohmann::json& Stage : ReadJson(At("frame.json"))["stages"])
	{
		EXPECT_THAT(GetKeys(Stage["gpu_ms"]), IsSupersetOf({"  SceneUpdate", "  SunShadow"})) << Stage["name"];
	}
}

TEST_F(FOutputTest, CompareWritesTheFigures)
{
	for (const auto& [Name, Sky] : {std::pair("a.pfm", "1,1,1"), std::pair("b.pfm", "0.5,0.5,0.5")})
	{
		RunCleanly(
		    {"render", "planes", "--sky", Sky, "--size", "32x32", "--set", "r.RT.GI=0", "--set", "r.RT.Reflections=0", "-o", At(Name)});
	}
	const std::string HeatMap = At(CheckImageOutput(At("h.png")) ? "h.png" : "h.pfm");
	const FProgramRun Run = RunCleanly({"compare", At("a.pfm"), At("b.pfm"), "--json", At("c.json"), "--heatmap", HeatMap});
	EXPECT_THAT(Run.Out, HasSubstr("flip"));
	EXPECT_EQ(Run.Err, "");
	const nlohmann::json C = ReadJson(At("c.json"));
	EXPECT_THAT(
	    GetKeys(C), IsSupersetOf({"mse", "rmse", "relmse", "psnr", "flip", "mean_ratio", "block16_median", "block16_p95", "nonfinite"}));
	EXPECT_EQ(C["mean_ratio"].size(), 3u);
	EXPECT_GT(C["mse"].get<double>(), 0.0);
	EXPECT_EQ(C["nonfinite"].size(), 2u);
	EXPECT_GT(std::filesystem::file_size(HeatMap), 0u);
	RunCleanly({"compare", At("a.pfm"), At("a.pfm"), "--json", At("same.json")});
	EXPECT_EQ(ReadJson(At("same.json"))["mse"], 0.0);
	EXPECT_TRUE(ReadJson(At("same.json"))["psnr"].is_null()) << "infinite";
	const FProgramRun Sizes = RunProgram({"render", "furnace", "--size", "8x8", "--set", "r.RT.GI=0", "--set", "r.RT.Reflections=0",
	    "--set", "r.RT.Lights.Emissive=0", "-o", At("small.pfm")});
	EXPECT_EQ(RunProgram({"compare", At("a.pfm"), At("small.pfm")}).Status, 4);
}

TEST_F(FOutputTest, ExtremeButValidViewsRender)
{
	for (const std::vector<std::string>& View : {std::vector<std::string>{"--size", "1x1"}, {"--size", "257x3"},
	         {"--camera", "1e15,0,0,0,0,0,60"}, {"--camera", "0,0,5,0,0,4.999999,179.9"}, {"--camera", "0,5,0,0,0,0,1e-3"},
	         {"--sun", "0,0,-1,0,0"}, {"--sun", "1e15,0,-1,0,180"}, {"--sky", "0,0,0"}, {"--time=-1"}, {"--time", "1e15"},
	         {"--seed", "4294967295"}, {"--no-scene-lights"}})
	{
		std::vector<std::string> Arguments = {"render", "planes", "--validate"};
		Arguments.insert(Arguments.end(), View.begin(), View.end());
		if (View[0] != "--size") { Arguments.insert(Arguments.end(), {"--size", "16x16"}); }
		const FProgramRun Run = RunProgram(Arguments);
		EXPECT_EQ(Run.Status, 0) << View[0] << ": " << Run.Err;
	}
}

} // namespace
} // namespace Lantern
