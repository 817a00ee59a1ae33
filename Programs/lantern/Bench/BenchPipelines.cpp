// The tables and the JSON of lantern bench rtpso.
#include "Bench/BenchPipelines.h"

#include <algorithm>
#include <numeric>
#include <thread>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "Bench/BenchPipelineFrames.h"
#include "Bench/BenchPipelineRuns.h"
#include "Bench/BenchRun.h"
#include "LanternCore/Text/Log.h"
#include "LanternRHIMock/MockDevice.h"

namespace Lantern
{

namespace
{
FRTStatus OpenDevice(const FBenchPipelinesOptions& Options, TRTRef<IRTDevice>& Out)
{
	if (Options.bMock)
	{
		if (FRTStatus S = CreateBenchMock(Out); !S) { return S; }
		GetMock(Out.Get()).SlowCompile("Bench", Options.MockCompileMs);
		return FRTStatus::Success();
	}
	return OpenUncachedDevice(Options.Device, Out);
}

/// Groups that one thread compiles: see GetPipelineRunWork.
double GetIncrementalWork(const FBenchPipelinesOptions& Options)
{
	return Options.Added + double(Options.Groups) / std::max(1u, std::thread::hardware_concurrency());
}

/// All groups twice: while frames go on, and in one frame that waits.
double GetFramesWork(const FBenchPipelinesOptions& Options)
{
	return 2.0 * double(Options.Groups) / std::max(1u, std::thread::hardware_concurrency());
}

FRTStatus MeasureRuns(
    IRTDevice& Device, FShaderCompiler& Compiler, const FBenchPipelinesOptions& Options, FBenchProgress& Progress, nlohmann::json& Json)
{
	fmt::print("{:>8} {:>14} {:>13} {:>9} {:>7} {:>11} {:>11}\n", "threads", "monolithic ms", "libraries ms", "link ms", "ratio",
	    "glslang ms", "text-RTPSO");
	for (const uint32_t Threads : Options.Threads)
	{
		FPipelineRun Run;
		Run.Threads = Threads;
		if (FRTStatus S = MeasurePipelineRun(Device, Compiler, Options.Groups, Options.Repetitions, Progress, Run); !S) { return S; }
		Progress.Clear();
		fmt::print("{:>8} {:>14.1f} {:>13.1f} {:>9.2f} {:>7.2f} {:>11.1f} {:>11.1f}\n", Threads, Run.MonolithicMs.GetMedian(),
		    Run.LibrariesMs.GetMedian(), Run.LinkMs.GetMedian(), Run.GetRatio(), Run.GlslangMs, Run.FinishMs);
		std::fflush(stdout);
		Json["runs"].push_back({{"threads", Threads}, {"monolithic_ms", Run.MonolithicMs.GetMedian()},
		    {"libraries_ms", Run.LibrariesMs.GetMedian()}, {"link_ms", Run.LinkMs.GetMedian()}, {"ratio", Run.GetRatio()},
		    {"glslang_ms", Run.GlslangMs}, {"text_to_rtpso_ms", Run.FinishMs},
		    {"times",
		        {{"monolithic", Run.MonolithicMs.ToJson()}, {"libraries", Run.LibrariesMs.ToJson()}, {"link", Run.LinkMs.ToJson()}}}});
	}
	Progress.Begin(fmt::format("{} materials one by one", Options.Added), GetIncrementalWork(Options));
	FIncrementalRun Incremental;
	if (FRTStatus S = MeasureIncremental(Device, Compiler, Options.Groups, Options.Added, Incremental); !S) { return S; }
	Progress.Clear();
	fmt::print("one more material: ready after {:.2f} ms, link {:.2f} ms (medians of {})\n", Incremental.ReadyMs.GetMedian(),
	    Incremental.LinkMs.GetMedian(), Options.Added);
	Json["incremental"] = {{"added", Options.Added}, {"ready_ms", Incremental.ReadyMs.GetMedian()},
	    {"link_ms", Incremental.LinkMs.GetMedian()},
	    {"times", {{"ready", Incremental.ReadyMs.ToJson()}, {"link", Incremental.LinkMs.ToJson()}}}};
	return FRTStatus::Success();
}

struct FFrameFigures
{
	explicit FFrameFigures(const std::vector<FFrameTime>& Frames)
	{
		FBenchTimes All;
		for (size_t Index = 0; Index < Frames.size(); ++Index)
		{
			All.Add(Frames[Index].Ms);
			WorstProcessor = std::max(WorstProcessor, Frames[Index].ProcessorMs);
		}
		Median = All.GetMedian();
		Worst = All.GetMax();
		std::vector<size_t> Order(Frames.size());
		std::iota(Order.begin(), Order.end(), size_t(0));
		std::sort(Order.begin(), Order.end(), [&](size_t A, size_t B) { return Frames[A].Ms > Frames[B].Ms; });
		constexpr size_t Shown = 10;
		Order.resize(std::min(Order.size(), Shown));
		for (const size_t Index : Order)
		{
			Longest.push_back({{"frame", Index}, {"ms", Frames[Index].Ms}, {"processor_ms", Frames[Index].ProcessorMs}});
		}
	}
	double Median = 0.0, Worst = 0.0, WorstProcessor = 0.0;
	nlohmann::json Longest;
};

FRTStatus MeasureFrames(
    IRTDevice& Device, const std::string& Shaders, const FBenchPipelinesOptions& Options, FBenchProgress& Progress, nlohmann::json& Json)
{
	Progress.Begin(fmt::format("frames while {} materials compile", Options.Groups), GetFramesWork(Options));
	FHitchRun Run;
	const FRendererDesc Desc{{Shaders}, {}};
	// The mock draws nothing: its frames are given the length of real ones. Its compiles sleep, so that more of them than
	// there are cores can run at once.
	constexpr uint32_t MockThreads = 8;
	constexpr double MockFrameMs = 4.0;
	if (FRTStatus S = MeasureHitches(Device, Desc, Options.Groups, Options.bMock ? MockThreads : 0, Options.bMock ? MockFrameMs : 0.0, Run);
	    !S)
	{
		return S;
	}
	Progress.Clear();
	const FFrameFigures Idle(Run.Idle), Compiling(Run.Compiling);
	fmt::print("frames while {} materials compile: median {:.3f} ms, worst {:.3f} ms, of {} (before: median {:.3f} ms, "
	           "worst {:.3f} ms)\n",
	    Options.Groups, Compiling.Median, Compiling.Worst, Run.Compiling.size(), Idle.Median, Idle.Worst);
	fmt::print("processor time of the render thread in these: worst {:.3f} ms (before: {:.3f} ms)\n", Compiling.WorstProcessor,
	    Idle.WorstProcessor);
	Run.Worst.Print();
	fmt::print("all in use after {:.2f} s and {} swaps; in a frame that waits for them: {:.2f} s (ratio {:.2f})\n", Run.ArrivedSeconds,
	    Run.Swaps, Run.OnceSeconds, Run.ArrivedSeconds / Run.OnceSeconds);
	Json["arrival"] = {{"seconds", Run.ArrivedSeconds}, {"swaps", Run.Swaps}, {"once_seconds", Run.OnceSeconds}};
	Json["hitch"] = {{"median_frame_ms", Compiling.Median}, {"worst_frame_ms", Compiling.Worst}, {"frames", Run.Compiling.size()},
	    {"worst_frame_processor_ms", Compiling.WorstProcessor}, {"idle_median_frame_ms", Idle.Median}, {"idle_worst_frame_ms", Idle.Worst},
	    {"idle_worst_frame_processor_ms", Idle.WorstProcessor}, {"idle_frames", Run.Idle.size()}, {"longest_frames", Compiling.Longest},
	    {"worst_calls", Run.Worst.ToJson()}};
	return FRTStatus::Success();
}

/// Figures stay null after an error.
int Measure(const FBenchPipelinesOptions& Options, nlohmann::json& Figures)
{
	const FPluginFolders Folders = FindPluginFolders();
	if (const int Status = LoadSettings(Folders.Config, Options.Device); Status != ExitDone) { return Status; }
	TRTRef<IRTDevice> Device;
	if (FRTStatus S = OpenDevice(Options, Device); !S) { return ReportStatus(S, "bench rtpso"); }
	const FRTCapabilities& Capabilities = Device->GetCapabilities();
	LogInfo("{} ({})", Capabilities.DeviceName, Capabilities.DriverName);
	if (!Capabilities.bRayTracingPipeline || !Capabilities.bPipelineLibraries)
	{
		LogError("bench rtpso: {} has no ray-tracing pipelines with libraries", Capabilities.DeviceName);
		return ExitNoDevice;
	}
	nlohmann::json Json = DescribeBenchDevice(Capabilities);
	Json["cores"] = std::thread::hardware_concurrency();
	Json["hit_groups"] = Options.Groups;
	if (Capabilities.bIsCpu)
	{
		Json["note"] = "a CPU driver: it may compile machine code only at the first dispatch, which is in none of these times";
	}
	FShaderCompiler Compiler{FShaderCompilerDesc{.SearchFolders = {Folders.Shaders}}};
	const bool bRuns = !Options.bMock && !Options.bHitchOnly;
	double Work = GetFramesWork(Options);
	for (const uint32_t Threads : bRuns ? Options.Threads : std::vector<uint32_t>())
	{
		Work += GetPipelineRunWork(Threads, Options.Groups, Options.Repetitions);
	}
	FBenchProgress Progress("rtpso", Work + (bRuns ? GetIncrementalWork(Options) : 0.0));
	FRTStatus Status = bRuns ? MeasureRuns(*Device, Compiler, Options, Progress, Json) : FRTStatus::Success();
	if (Status) { Status = MeasureFrames(*Device, Folders.Shaders, Options, Progress, Json); }
	if (!Status) { return ReportStatus(Status, "bench rtpso"); }
	Figures = std::move(Json);
	return ExitDone;
}
} // namespace

void FBenchPipelinesOptions::AddTo(CLI::App& App)
{
	Device.AddTo(App);
	AddBenchQuick(App, [this] {
		Groups = 8;
		Threads = {1, 2};
		Repetitions = 1;
		Added = 2;
		MockCompileMs = 20;
	});
	App.add_flag("--mock", bMock, "On the mock device, whose compiles take half a second each: only the frames are measured");
	App.add_flag("--hitch-only", bHitchOnly, "Only the frames");
	App.add_option("--groups", Groups, "Hit groups, each with a material program of its own")->check(CLI::Range(1, 65536));
	App.add_option("--threads", Threads, "Numbers of threads")->check(CLI::Range(1, 256));
	App.add_option("--repetitions", Repetitions, "Pipelines made each way")->check(CLI::Range(1, 1000));
	App.add_option("--added", Added, "Materials added one after another")->check(CLI::Range(1, 10'000));
	App.add_option("--mock-compile-ms", MockCompileMs, "How long the mock takes for each material")->check(CLI::Range(0, 60'000));
	AddBenchJson(App, Json);
}

int RunBenchPipelines(const FBenchPipelinesOptions& Options)
{
	return RunBench(Options.Json, [&](nlohmann::json& Figures) { return Measure(Options, Figures); });
}

} // namespace Lantern
