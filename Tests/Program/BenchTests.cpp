// What benchmarks share: the file of figures, the mock device, and options that are refused before any work. No figure is judged.
#include <algorithm>
#include <cmath>

#include "ProgramTools.h"

namespace Lantern
{
namespace
{

using ::testing::HasSubstr;
using ::testing::Not;

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

TEST_F(BenchProgram, FrameHasNoTimesOfADeviceWithoutAClock)
{
	const FProgramRun Run = RunProgram(
	    {"bench", "frame", "--mock", "--quick", "--objects", "1000", "--skinned", "2", "--rounds", "1", "--json", At("frame.json")});
	ASSERT_EQ(Run.Status, 0) << Run.Err;
	EXPECT_THAT(Run.Out, Not(HasSubstr("GPU ms")));
	const nlohmann::json Last = ReadJson(At("frame.json"))["stages"].back();
	EXPECT_EQ(Last["gpu_ms"], nlohmann::json::object());
	EXPECT_TRUE(Last["breakdown_ms"].contains("  SceneUpdate"));
}

TEST_F(BenchProgram, FileThatCannotBeWrittenEndsItBeforeAnyWork)
{
	const std::vector<std::vector<std::string>> Benches = {
	    {"rays"}, {"anyhit"}, {"sbt", "--mock"}, {"frame", "--mock"}, {"gather"}, {"shaders"}, {"uploads", "--mock"}, {"growth", "--mock"}};
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

TEST_F(BenchProgram, StepsGoToStandardErrorAndRowsToStandardOutput)
{
	const std::vector<std::vector<std::string>> Benches = {{"sbt", "--mock", "--quick", "--objects", "200", "300"},
	    {"gather", "--quick", "--instances", "2000", "--frames", "8"},
	    {"frame", "--mock", "--quick", "--objects", "1000", "--skinned", "2"}, {"growth", "--mock", "--quick", "--line", "materials"}};
	for (const std::vector<std::string>& Bench : Benches)
	{
		std::vector<std::string> Arguments = {"bench"};
		Arguments.insert(Arguments.end(), Bench.begin(), Bench.end());
		const FProgramRun Run = RunProgram(Arguments);
		ASSERT_EQ(Run.Status, 0) << Bench[0] << ": " << Run.Err;
		const std::string Step = "bench " + Bench[0] + ": ";
		size_t Steps = 0;
		for (size_t At = Run.Err.find(Step); At != std::string::npos; At = Run.Err.find(Step, At + 1)) { ++Steps; }
		EXPECT_GE(Steps, 2u) << Bench[0] << ": " << Run.Err;
		EXPECT_THAT(Run.Err, HasSubstr(" left")) << Bench[0];
		EXPECT_THAT(Run.Out, Not(HasSubstr(Step))) << Bench[0];
		EXPECT_GE(std::count(Run.Out.begin(), Run.Out.end(), '\n'), 2) << Bench[0] << ": a head and rows";
	}
}

TEST_F(BenchProgram, QuickLeavesWhatIsNamed)
{
	const FProgramRun Run = RunProgram({"bench", "gather", "--instances", "3000", "--quick", "--frames", "8", "--json", At("gather.json")});
	ASSERT_EQ(Run.Status, 0) << Run.Err;
	const nlohmann::json Sizes = ReadJson(At("gather.json"))["sizes"];
	ASSERT_EQ(Sizes.size(), 1u);
	EXPECT_EQ(Sizes[0]["instances"], 3000);
}

TEST_F(BenchProgram, GrowthHasAnExponentForEachLineAndAPage)
{
	const FProgramRun Run = RunProgram({"bench", "growth", "--mock", "--quick", "--json", At("growth.json"), "-o", At("growth.html")});
	ASSERT_EQ(Run.Status, 0) << Run.Err;
	const nlohmann::json Lines = ReadJson(At("growth.json"))["lines"];
	std::vector<std::string> Names;
	for (const nlohmann::json& Line : Lines)
	{
		Names.push_back(Line["name"]);
		ASSERT_EQ(Line["points"].size(), 2u) << Names.back();
		const double X[] = {Line["points"][0]["value"], Line["points"][1]["value"]};
		const double Y[] = {Line["points"][0]["cpu_ms"], Line["points"][1]["cpu_ms"]};
		EXPECT_NEAR(Line["cpu_exponent"].get<double>(), std::log(Y[1] / Y[0]) / std::log(X[1] / X[0]), 1e-9) << Names.back();
		EXPECT_TRUE(Line["gpu_exponent"].is_null()) << "the mock has no clock";
	}
	EXPECT_EQ(Names, (std::vector<std::string>{"objects", "triangles", "materials", "programs", "pixels"}));
	const std::string Page = ReadFile(At("growth.html"));
	EXPECT_THAT(Page, HasSubstr("\"cpu_exponent\""));
	EXPECT_THAT(Page, HasSubstr("Chart.js"));
	EXPECT_THAT(Page, Not(HasSubstr("{{")));
	const FProgramRun Wrong = RunProgram({"bench", "growth", "--line", "lights"});
	EXPECT_EQ(Wrong.Status, 2);
	EXPECT_THAT(Wrong.Err, HasSubstr("objects, triangles, materials"));
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
