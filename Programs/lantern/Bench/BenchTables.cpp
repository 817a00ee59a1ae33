// lantern bench sbt: options and the table of figures.
#include "Bench/BenchTables.h"

#include <cstdio>
#include <numeric>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "Bench/BenchRun.h"
#include "Bench/BenchTableCase.h"
#include "LanternCore/Tasks/Tasks.h"
#include "LanternCore/Text/Log.h"

namespace Lantern
{

namespace
{
nlohmann::json MakeTimes(const FTableTimes& Times)
{
	nlohmann::json Json = Times.Wall.ToJson();
	Json["processor_median"] = Times.Processor.GetMedian();
	return Json;
}

nlohmann::json MakeJson(const FTableCaseResult& Case)
{
	return {{"objects", Case.Objects}, {"records", Case.Records}, {"full_rewrite_us", Case.Full.Wall.GetMedian()},
	    {"static_us", Case.Static.Wall.GetMedian()}, {"dynamic_1pct_us", Case.Dynamic.Wall.GetMedian()},
	    {"dynamic_1pct_sections_us", Case.DynamicSections.Wall.GetMedian()}, {"swap_us", Case.Swap.Wall.GetMedian()},
	    {"bytes_full", Case.BytesFull}, {"bytes_static", Case.BytesStatic}, {"bytes_dynamic", Case.BytesDynamic},
	    {"bytes_swap", Case.BytesSwap},
	    {"times", {{"full_rewrite", MakeTimes(Case.Full)}, {"static", MakeTimes(Case.Static)}, {"dynamic_1pct", MakeTimes(Case.Dynamic)},
	                  {"dynamic_1pct_sections", MakeTimes(Case.DynamicSections)}, {"swap", MakeTimes(Case.Swap)}}}};
}

void PrintTableHeader()
{
	fmt::print("{:>8} {:>8} {:>8}  {:>22} {:>10} {:>22} {:>12} {:>22}  {:>11} {:>11} {:>11}\n", "objects", "sets", "records",
	    "full us [min, max]", "static us", "1 % us [min, max]", "+ sections", "swap us [min, max]", "full B", "1 % B", "swap B");
}

void PrintCase(const FTableCaseResult& Case, bool bShared)
{
	const auto Times = [](const FTableTimes& T) {
		return fmt::format("{:.1f} [{:.0f}, {:.0f}]", T.Wall.GetMedian(), T.Wall.GetMin(), T.Wall.GetMax());
	};
	fmt::print("{:>8} {:>8} {:>8}  {:>22} {:>10.4f} {:>22} {:>12.1f} {:>22}  {:>11} {:>11} {:>11}\n", Case.Objects,
	    bShared ? "shared" : "own", Case.Records, Times(Case.Full), Case.Static.Wall.GetMedian(), Times(Case.Dynamic),
	    Case.DynamicSections.Wall.GetMedian(), Times(Case.Swap), Case.BytesFull, Case.BytesDynamic, Case.BytesSwap);
	fmt::print("{:>26}  full / static {:.0f}, full / 1 % {:.1f}, full / swap {:.2f}; by processor time 1 % {:.1f}, "
	           "swap {:.2f}\n",
	    "", Case.Full.Wall.GetMedian() / Case.Static.Wall.GetMedian(), Case.Full.Wall.GetMedian() / Case.Dynamic.Wall.GetMedian(),
	    Case.Full.Wall.GetMedian() / Case.Swap.Wall.GetMedian(), Case.Full.Processor.GetMedian() / Case.Dynamic.Processor.GetMedian(),
	    Case.Full.Processor.GetMedian() / Case.Swap.Processor.GetMedian());
	std::fflush(stdout);
}

int MeasureAll(IRTDevice& Device, const FBenchTablesOptions& Options, nlohmann::json& Json)
{
	FShaderCompiler Compiler{FShaderCompilerDesc{}};
	FTablePrograms Programs;
	if (FRTStatus S = Programs.Create(Device, Compiler); !S) { return ReportStatus(S, "bench sbt"); }
	int Exit = ExitDone;
	PrintTableHeader();
	FBenchProgress Progress("sbt", 2.0 * std::accumulate(Options.Objects.begin(), Options.Objects.end(), 0.0));
	for (const bool bShared : {false, true})
	{
		nlohmann::json& Cases = Json[bShared ? "shared_sizes" : "sizes"] = nlohmann::json::array();
		for (const uint32_t Objects : Options.Objects)
		{
			Progress.Begin(fmt::format("{} objects, {} sets", Objects, bShared ? "shared" : "own"), Objects);
			FTableCaseResult Result;
			if (FRTStatus S = FTableCase(Device, Programs, Objects, bShared).Measure(Options.Repetitions, Result); !S)
			{
				return ReportStatus(S, "bench sbt");
			}
			Progress.Clear();
			PrintCase(Result, bShared);
			Cases.push_back(MakeJson(Result));
			if (Result.BytesStatic > 0)
			{
				LogError("{} objects: a frame in which nothing changed copied {} bytes", Objects, Result.BytesStatic);
				Exit = ExitCheckFailed;
			}
		}
	}
	return Exit;
}

int MeasureOn(IRTDevice& Device, const FBenchTablesOptions& Options, nlohmann::json& Json)
{
	const FRTCapabilities& Capabilities = Device.GetCapabilities();
	if (!Capabilities.bRayTracingPipeline)
	{
		LogError("bench sbt: {} has no ray-tracing pipelines, so no shader tables", Capabilities.DeviceName);
		return ExitNoDevice;
	}
	Json = DescribeBenchDevice(Capabilities);
	Json["workers"] = GetWorkerCount();
	Json["ray_types"] = FTablePrograms::RayTypes;
	return MeasureAll(Device, Options, Json);
}
} // namespace

void FBenchTablesOptions::AddTo(CLI::App& App)
{
	Device.AddTo(App);
	AddBenchQuick(App, [this] {
		Objects = {1000, 10'000};
		Repetitions = 5;
	});
	App.add_flag("--mock", bMock, "On the mock device instead of a driver");
	App.add_option("--objects", Objects, "Numbers of objects")->check(CLI::Range(100, 4'000'000));
	App.add_option("--repetitions", Repetitions, "Measured frames of each kind")->check(CLI::Range(1, 100'000));
	AddBenchJson(App, Json);
}

int RunBenchTables(const FBenchTablesOptions& Options)
{
	return RunBench(Options.Json, [&](nlohmann::json& Figures) {
		const auto Measure = [&](IRTDevice& Device) { return MeasureOn(Device, Options, Figures); };
		if (Options.bMock) { return RunOnBenchMock(Options.Device, Measure); }
		return RunInBenchSession(Options.Device, [&](FSession& Session) { return Measure(Session.GetDevice()); });
	});
}

} // namespace Lantern
