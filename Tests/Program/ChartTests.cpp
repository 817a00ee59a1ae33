// lantern chart on a tiny scene: its data, shards, merging, going on after a kill, and what it says of bad input.
#include <filesystem>

#include "ProgramTools.h"

namespace Lantern
{
namespace
{

using testing::AnyOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class Chart : public testing::Test
{
protected:
	std::vector<std::string> MakeArguments(const std::string& Output, std::vector<std::string> More = {}) const
	{
		std::vector<std::string> Arguments = {"chart", "stability-lid", "-o", Output, "--size", "48x27", "--spp", "4", "--frames", "5",
		    "--warm-up", "2", "--budget", "0", "--methods-file", Methods};
		Arguments.insert(Arguments.end(), More.begin(), More.end());
		return Arguments;
	}
	FProgramRun RunChart(const std::string& Output, std::vector<std::string> More = {}) const
	{
		return RunProgram(MakeArguments(Output, std::move(More)));
	}
	/// Kills a run that has three parts. The parts that it leaves, by name.
	std::map<std::string, std::string> KillWithThreeParts(const std::string& Output) const
	{
		const std::string Folder = At(Output + ".parts/");
		std::vector<std::string> Names;
		FProgramProcess Process(MakeArguments(At(Output + ".html")));
		const auto HasParts = [&] {
			std::error_code Error;
			if (std::filesystem::is_directory(Folder, Error)) { Names = ListFolder(Folder); }
			return Names.size() >= 3 || !Process.IsRunning();
		};
		WaitUntil("three parts of a chart", HasParts, {}, [&] { return std::to_string(Names.size()) + " so far"; });
		Process.Kill();
		EXPECT_GE(Names.size(), 3u) << "it ended by itself";
		std::map<std::string, std::string> Parts;
		for (const std::string& Name : Names.empty() ? Names : ListFolder(Folder))
		{
			if (Name.ends_with(".json")) { Parts[Name] = ReadFile(Folder + Name); }
		}
		return Parts;
	}
	std::string At(const std::string& Name) const { return Files.GetPath() + '/' + Name; }

	FTemporaryFolder Files;
	const std::string Methods = Files.Write("methods.ini", "[MethodDefaults]\n"
	                                                       "+CVars=r.RT.Shadow=0 r.RT.AO=0\n"
	                                                       "[Method.Shadow]\nTitle=shadow\nSignal=sun_shadow\n"
	                                                       "+CVars=r.RT.Shadow=1 r.RT.Shadow.Denoise=0\n"
	                                                       "+Presets=hard: r.RT.Shadow.Soft=0\n"
	                                                       "+Presets=4 rays: r.RT.Shadow.Soft=1 r.RT.Shadow.Samples=4\n"
	                                                       "[Method.Occlusion]\nTitle=occlusion\nSignal=ambient_occlusion\n"
	                                                       "+CVars=r.RT.AO=1 r.RT.AO.Denoise=0\n"
	                                                       "+Presets=1 ray: r.RT.AO.Samples=1\n"
	                                                       "[Method.Frame]\nTitle=frame\nSignal=frame\n"
	                                                       "+CVars=r.RT.Shadow=1\n"
	                                                       "+Presets=direct: r.RT.Shadow.Samples=1\n");
};

void ExpectPoint(const nlohmann::json& Point)
{
	for (const char* Name : {"gpu_ms", "frame_gpu_ms", "relmse", "flip", "sigma", "t90_frames", "ghost", "leak"})
	{
		ASSERT_TRUE(Point.contains(Name)) << Name;
		EXPECT_TRUE(Point[Name].is_number() || Point[Name].is_null()) << Name << " is " << Point[Name];
	}
	for (const char* Name : {"rays_per_pixel", "memory", "frames"}) { EXPECT_TRUE(Point.at(Name).is_number()) << Name; }
	for (const char* Name : {"signal", "method", "preset", "path", "picture", "heatmap"})
	{
		EXPECT_TRUE(Point.at(Name).is_string()) << Name;
	}
	for (const char* Name : {"gpu_ms", "frame_gpu_ms", "relmse", "flip"}) { EXPECT_TRUE(Point[Name].is_number()) << Name; }
	const bool bStill = Point["path"] == "still", bMoves = Point["path"] == "fast" || Point["path"] == "cut";
	EXPECT_EQ(Point["sigma"].is_number(), bStill);
	EXPECT_TRUE(bMoves || Point["ghost"].is_null());
	EXPECT_TRUE(bStill || Point["t90_frames"].is_null());
	if (Point["signal"] == "ambient_occlusion") { EXPECT_TRUE(Point["t90_frames"].is_null()); }
	EXPECT_GT(Point["gpu_ms"].get<double>(), 0.0);
	EXPECT_GE(Point["frame_gpu_ms"].get<double>(), Point["gpu_ms"].get<double>());
}

TEST_F(Chart, DataIsWhatTheContractSays)
{
	const FProgramRun Run = RunChart(At("a.html"), {"--validate"});
	ASSERT_EQ(Run.Status, 0) << Run.Err;
	const nlohmann::json Data = ReadJson(At("a.json"));
	EXPECT_EQ(Data["version"], 1);
	EXPECT_EQ(Data["settings"]["size"], "48x27");
	EXPECT_FALSE(Data.contains("images"));
	ASSERT_EQ(Data["signals"].size(), 3u);
	EXPECT_EQ(Data["signals"][0]["name"], "sun_shadow");
	ASSERT_EQ(Data["scenes"].size(), 1u);
	const nlohmann::json& Scene = Data["scenes"][0];
	EXPECT_EQ(Scene["name"], "stability-lid");
	EXPECT_EQ(Scene["width"], 48);
	EXPECT_EQ(Scene["height"], 27);
	EXPECT_TRUE(Scene.contains("view") && Scene["view"].is_null()) << "a built-in scene has none";
	EXPECT_THAT(Scene["skipped"], IsEmpty());
	ASSERT_EQ(Scene["points"].size(), 16u); // 4 presets on 4 paths
	for (const nlohmann::json& Point : Scene["points"]) { ExpectPoint(Point); }
	// Four rays see more of a penumbra than one that is hard, and cost four times as many.
	EXPECT_EQ(Scene["points"][0]["preset"], "hard");
	EXPECT_EQ(Scene["points"][0]["rays_per_pixel"], 1.0);
	EXPECT_EQ(Scene["points"][1]["rays_per_pixel"], 4.0);
	// A shadow without memory follows the light at once.
	EXPECT_EQ(Scene["points"][0]["t90_frames"], 1.0);
	const std::string Page = ReadFile(At("a.html"));
	EXPECT_THAT(Page, HasSubstr("data:image/jpeg;base64,"));
	EXPECT_THAT(Page, HasSubstr("stability-lid"));
}

TEST_F(Chart, ShardsMakeTheSamePage)
{
	ASSERT_EQ(RunChart(At("one.html"), {"--shard", "1/2"}).Status, 0);
	ASSERT_EQ(RunChart(At("two.html"), {"--shard", "2/2"}).Status, 0);
	const size_t One = ReadJson(At("one.json"))["scenes"][0]["points"].size(), Two = ReadJson(At("two.json"))["scenes"][0]["points"].size();
	EXPECT_EQ(One + Two, 16u);
	EXPECT_EQ(One, 8u);
	const FProgramRun Merged = RunProgram({"chart", "--merge", At("one.parts"), At("two.parts"), "-o", At("merged.html")});
	ASSERT_EQ(Merged.Status, 0) << Merged.Err;
	EXPECT_EQ(ReadJson(At("merged.json"))["scenes"][0]["points"].size(), 16u);
	// A run that finds all of these parts measures nothing, and says the same.
	using enum std::filesystem::copy_options;
	for (const char* Shard : {"one.parts", "two.parts"}) { std::filesystem::copy(At(Shard), At("all.parts"), recursive | skip_existing); }
	const auto Before = ListFolder(At("all.parts"));
	EXPECT_EQ(Before.size(), 17u);
	ASSERT_EQ(RunChart(At("all.html")).Status, 0);
	EXPECT_EQ(ListFolder(At("all.parts")), Before);
	EXPECT_TRUE(ReadFile(At("all.html")) == ReadFile(At("merged.html"))); // whole pages: too long to print
	EXPECT_EQ(ReadFile(At("all.json")), ReadFile(At("merged.json")));
	// In the other order too.
	ASSERT_EQ(RunProgram({"chart", "--merge", At("two.parts"), At("one.parts"), "-o", At("again.html")}).Status, 0);
	EXPECT_TRUE(ReadFile(At("again.html")) == ReadFile(At("merged.html")));
}

TEST_F(Chart, GoesOnWhereItWasKilled)
{
	constexpr size_t AllParts = 17;
	std::map<std::string, std::string> Before;
	std::string Cut;
	// Another try where all parts are there before this program, which may have to wait for a core, sees three of them.
	for (int Try = 0; Try < 10 && (Cut.empty() || Before.size() >= AllParts); ++Try)
	{
		Cut = "k" + std::to_string(Try);
		Before = KillWithThreeParts(Cut);
		ASSERT_FALSE(HasFailure());
	}
	ASSERT_LT(Before.size(), AllParts) << "it was always done before it was killed";
	EXPECT_FALSE(std::filesystem::exists(At(Cut + ".html")));
	EXPECT_FALSE(std::filesystem::exists(At(Cut + ".json")));
	ASSERT_EQ(RunChart(At(Cut + ".html")).Status, 0);
	EXPECT_EQ(ReadJson(At(Cut + ".json"))["scenes"][0]["points"].size(), 16u);
	for (const auto& [Name, Text] : Before) { EXPECT_EQ(ReadFile(At(Cut + ".parts/") + Name), Text) << "measured again"; }
}

TEST_F(Chart, ABudgetSaysWhatItLeavesOut)
{
	std::vector<std::string> Arguments = MakeArguments(At("b.html"));
	Arguments[std::find(Arguments.begin(), Arguments.end(), "--budget") - Arguments.begin() + 1] = "0.0001";
	const FProgramRun Run = RunProgram(Arguments);
	ASSERT_EQ(Run.Status, 0) << Run.Err;
	const nlohmann::json Scene = ReadJson(At("b.json"))["scenes"][0];
	EXPECT_EQ(Scene["points"].size() + Scene["skipped"].size(), 16u);
	ASSERT_FALSE(Scene["skipped"].empty());
	EXPECT_THAT(Scene["skipped"][0]["reason"].get<std::string>(), HasSubstr("budget"));
}

TEST_F(Chart, SaysWhatIsWrong)
{
	const auto Expect = [&](std::vector<std::string> Arguments, int Status, const char* Message) {
		Arguments.insert(Arguments.begin(), "chart");
		const FProgramRun Run = RunProgram(Arguments);
		EXPECT_EQ(Run.Status, Status) << Run.Err;
		EXPECT_THAT(Run.Err, HasSubstr(Message));
		EXPECT_THAT(ListFolder(Files.GetPath()), ElementsAre("bad.ini", "methods.ini"));
	};
	const std::string Bad = Files.Write("bad.ini", "[Method.A]\nSignal=frame\n+Presets=p: r.RT.Nothing=1\n");
	Expect({}, 2, "-o OUT.html is missing");
	Expect({"-o", At("a.png")}, 2, "does not end in .html");
	Expect({"-o", At("no/a.html")}, 4, "no/a.html");
	Expect({"-o", At("a.html"), "--shard", "3/2"}, 2, "--shard");
	Expect({"-o", At("a.html"), "--size", "x"}, 2, "--size");
	Expect({"-o", At("a.html"), "--signals", "moon"}, 2, "'moon' is no signal");
	Expect({"-o", At("a.html"), "--paths", "back"}, 2, "'back' is none of");
	Expect({"-o", At("a.html"), "--methods-file", Methods, "--methods", "Sha"}, 2, "there are Shadow, Occlusion, Frame");
	Expect({"-o", At("a.html"), "--methods-file", Bad}, 4, "bad.ini:3: 'r.RT.Nothing' is no console variable");
	Expect({"-o", At("a.html"), "--methods-file", At("none.ini")}, 4, "none.ini");
	Expect({"-o", At("a.html"), "--merge", At("none.parts")}, 4, "none.parts");
	Expect({"-o", At("a.html"), "--merge", Files.GetPath()}, 4, "no part of a chart is in it");
	Expect({"nothing.gltf", "-o", At("a.html"), "--methods-file", Methods}, 4, "nothing.gltf");
}

} // namespace
} // namespace Lantern
