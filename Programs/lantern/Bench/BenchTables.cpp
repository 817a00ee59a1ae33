#include "Bench/BenchTables.h"

#include <cstdio>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "Bench/BenchTableCase.h"
#include "LanternCore/Tasks/Tasks.h"
#include "LanternCore/Text/Log.h"
#include "LanternImage/AtomicFile.h"
#include "LanternRHIMock/MockDevice.h"
#include "Progress.h"
#include "Session.h"

namespace Lantern
{

namespace
{
nlohmann::json MakeTimes(const FTableTimes& Times)
{
	return {
	    {"median", Times.GetMedian()}, {"min", Times.GetMin()}, {"max", Times.GetMax()}, {"processor_median", Times.GetProcessorMedian()}};
}

nlohmann::json MakeJson(const FTableCaseResult& Case)
{
	return {{"objects", Case.Objects}, {"records", Case.Records}, {"full_rewrite_us", Case.Full.GetMedian()},
	    {"static_us", Case.Static.GetMedian()}, {"dynamic_1pct_us", Case.Dynamic.GetMedian()},
	    {"dynamic_1pct_sections_us", Case.DynamicSections.GetMedian()}, {"swap_us", Case.Swap.GetMedian()}, {"bytes_full", Case.BytesFull},
	    {"bytes_static", Case.BytesStatic}, {"bytes_dynamic", Case.BytesDynamic}, {"bytes_swap", Case.BytesSwap},
	    {"times", {{"full_rewrite", MakeTimes(Case.Full)}, {"static", MakeTimes(Case.Static)}, {"dynamic_1pct", MakeTimes(Case.Dynamic)},
	                  {"dynamic_1pct_sections", MakeTimes(Case.DynamicSections)}, {"swap", MakeTimes(Case.Swap)}}}};
}

void PrintHeader()
{
	fmt::print("{:>8} {:>8} {:>8}  {:>22} {:>10} {:>22} {:>12} {:>22}  {:>11} {:>11} {:>11}\n", "objects", "sets", "records",
	    "full us [min, max]", "static us", "1 % us [min, max]", "+ sections", "swap us [min, max]", "full B", "1 % B", "swap B");
}

void PrintCase(const FTableCaseResult& Case, bool bShared)
{
	const auto Times = [](const FTableTimes& T) { return fmt::format("{:.1f} [{:.0f}, {:.0f}]", T.GetMedian(), T.GetMin(), T.GetMax()); };
	fmt::print("{:>8} {:>8} {:>8}  {:>22} {:>10.4f} {:>22} {:>12.1f} {:>22}  {:>11} {:>11} {:>11}\n", Case.Objects,
	    bShared ? "shared" : "own", Case.Records, Times(Case.Full), Case.Static.GetMedian(), Times(Case.Dynamic),
	    Case.DynamicSections.GetMedian(), Times(Case.Swap), Case.BytesFull, Case.BytesDynamic, Case.BytesSwap);
	fmt::print("{:>26}  full / static {:.0f}, full / 1 % {:.1f}, full / swap {:.2f}; by processor time 1 % {:.1f}, "
	           "swap {:.2f}\n",
	    "", Case.Full.GetMedian() / Case.Static.GetMedian(), Case.Full.GetMedian() / Case.Dynamic.GetMedian(),
	    Case.Full.GetMedian() / Case.Swap.GetMedian(), Case.Full.GetProcessorMedian() / Case.Dynamic.GetProcessorMedian(),
	    Case.Full.GetProcessorMedian() / Case.Swap.GetProcessorMedian());
	std::fflush(stdout);
}

FRTStatus OpenMock(const FBenchTablesOptions& Options, TRTRef<IRTDevice>& Out)
{
	if (LoadSettings(FindPluginFolders().Config, Options.Device) != ExitDone)
	{
		return FRTStatus::Error(ERTResult::InvalidArgument, "settings could not be read");
	}
	if (FRTStatus S = CreateMockDevice({}, Out.ReleaseAndGetAddress()); !S) { return S; }
	GetMock(Out.Get()).SetCallRecording(false);
	return FRTStatus::Success();
}

int MeasureAll(IRTDevice& Device, const FBenchTablesOptions& Options, nlohmann::json& Json)
{
	FShaderCompiler Compiler{FShaderCompilerDesc{}};
	FTablePrograms Programs;
	if (FRTStatus S = Programs.Create(Device, Compiler); !S) { return ReportStatus(S, "bench sbt"); }
	int Exit = ExitDone;
	PrintHeader();
	for (const bool bShared : {false, true})
	{
		nlohmann::json& Cases = Json[bShared ? "shared_sizes" : "sizes"] = nlohmann::json::array();
		for (const uint32_t Objects : Options.Objects)
		{
			FTableCaseResult Result;
			if (FRTStatus S = FTableCase(Device, Programs, Objects, bShared).Measure(Options.Repetitions, Result); !S)
			{
				return ReportStatus(S, "bench sbt");
			}
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
} // namespace

void FBenchTablesOptions::AddTo(CLI::App& App)
{
	Device.AddTo(App);
	App.add_flag("--mock", bMock, "On the mock device instead of a driver");
	App.add_option("--objects", Objects, "Numbers of objects")->check(CLI::Range(100, 4'000'000));
	App.add_option("--repetitions", Repetitions, "Measured frames of each kind")->check(CLI::Range(1, 100'000));
	App.add_option("--json", Json, "Write the figures to this file");
}

int RunBenchTables(const FBenchTablesOptions& Options)
{
	if (!Options.Json.empty())
	{
		if (FRTStatus S = CheckOutputPath(Options.Json); !S) { return ReportStatus(S, "--json"), ExitBadInput; }
	}
	FSession Session;
	TRTRef<IRTDevice> Mock;
	if (Options.bMock)
	{
		if (FRTStatus S = OpenMock(Options, Mock); !S) { return ReportStatus(S, "--mock"); }
	}
	else if (const int Status = Session.OpenDevice(Options.Device); Status != ExitDone) { return Session.Close(Status); }
	IRTDevice& Device = Options.bMock ? *Mock : Session.GetDevice();
	const FRTCapabilities& Capabilities = Device.GetCapabilities();
	if (!Capabilities.bRayTracingPipeline)
	{
		LogError("bench sbt: {} has no ray-tracing pipelines, so no shader tables", Capabilities.DeviceName);
		return Session.Close(ExitNoDevice);
	}
	nlohmann::json Json = {{"device", Capabilities.DeviceName}, {"driver", Capabilities.DriverName}, {"workers", GetWorkerCount()},
	    {"ray_types", FTablePrograms::RayTypes}};
	int Exit = MeasureAll(Device, Options, Json);
	if (!Options.Json.empty() && (Exit == ExitDone || Exit == ExitCheckFailed))
	{
		if (FRTStatus S = WriteFileAtomically(Options.Json, Json.dump(2) + "\n"); !S) { Exit = (ReportStatus(S, "--json"), ExitBadInput); }
	}
	return Session.Close(Exit);
}

} // namespace Lantern
