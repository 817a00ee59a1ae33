// What benchmarks share: the file of figures, the mock device, and options that are refused before any work. No figure is judged.
#include "ProgramTools.h"

namespace Lantern
{
namespace
{

using ::testing::HasSubstr;

struct BenchProgram : public ::testing::Test
{
	std::string At(const std::string& Name) const { return Folder.GetPath() + "/" + Name; }
	FTemporaryFolder Folder;
};

TEST_F(BenchProgram, FiguresNameTheDeviceAndTheTimes)
{
	const FProgramRun Run = RunProgram({"bench", "sbt", "--mock", "--objects", "200", "--repetitions", "2", "--json", At("sbt.json")});
	ASSERT_EQ(Run.Status, 0) << Run.Err;
	const nlohmann::json Json = ReadJson(At("sbt.json"));
	EXPECT_TRUE(Json["device"].is_string() && Json["driver"].is_string());
	ASSERT_EQ(Json["sizes"].size(), 1u);
	EXPECT_EQ(Json["sizes"][0]["objects"], 200);
	for (const char* Kind : {"full_rewrite", "static", "dynamic_1pct", "dynamic_1pct_sections", "swap"})
	{
		const nlohmann::json& Times = Json["sizes"][0]["times"][Kind];
		const double Min = Times["min"], Max = Times["max"];
		EXPECT_LE(Min, Max) << Kind;
		EXPECT_EQ(Times["median"], 0.5 * (Min + Max)) << Kind << ": of two repetitions";
	}
}

TEST_F(BenchProgram, LongestFramesOfRtpsoShowWhatTheirThreadsDid)
{
	const FProgramRun Run = RunProgram({"bench", "rtpso", "--mock", "--groups", "4", "--mock-compile-ms", "5", "--trace-calls", "--set",
	    "r.RT.Trace.File=" + At("trace.json"), "--json", At("rtpso.json")});
	ASSERT_EQ(Run.Status, 0) << Run.Err;
	EXPECT_THAT(Run.Out, HasSubstr("ms  BeginFrame"));
	const nlohmann::json Frames = ReadJson(At("rtpso.json"))["hitch"]["worst_calls"];
	ASSERT_FALSE(Frames.empty());
	for (const nlohmann::json& Frame : Frames)
	{
		EXPECT_GT(Frame["ms"].get<double>(), 0.0);
		ASSERT_FALSE(Frame["events"].empty());
	}
	EXPECT_FALSE(ReadJson(At("trace.json"))["traceEvents"].empty());
}

TEST_F(BenchProgram, FileThatCannotBeWrittenEndsItBeforeAnyWork)
{
	const std::vector<std::vector<std::string>> Benches = {
	    {"rays"}, {"anyhit"}, {"sbt", "--mock"}, {"frame", "--mock"}, {"gather"}, {"shaders"}, {"uploads", "--mock"}};
	for (const std::vector<std::string>& Bench : Benches)
	{
		std::vector<std::string> Arguments = {"bench"};
		Arguments.insert(Arguments.end(), Bench.begin(), Bench.end());
		Arguments.insert(Arguments.end(), {"--json", At("missing/figures.json")});
		const FProgramRun Run = RunProgram(Arguments);
		EXPECT_EQ(Run.Status, 4) << Bench[0];
		EXPECT_EQ(Run.Out, "") << Bench[0];
		EXPECT_THAT(Run.Err, HasSubstr("--json")) << Bench[0];
	}
}

TEST_F(BenchProgram, BenchmarkThatFailsLeavesNoFile)
{
	const FProgramRun Run = RunProgram({"bench", "sbt", "--mock", "--config", At("missing.ini"), "--json", At("sbt.json")});
	EXPECT_EQ(Run.Status, 4);
	EXPECT_THAT(Run.Err, HasSubstr("missing.ini"));
	EXPECT_EQ(ListFolder(Folder.GetPath()), std::vector<std::string>());
}

TEST_F(BenchProgram, WrongSizeIsWrongUsage)
{
	for (const char* Bench : {"rays", "anyhit", "frame"})
	{
		const FProgramRun Run = RunProgram({"bench", Bench, "--size", "64by36"});
		EXPECT_EQ(Run.Status, 2) << Bench;
		EXPECT_THAT(Run.Err, HasSubstr("WIDTHxHEIGHT")) << Bench;
	}
}

} // namespace
} // namespace Lantern
