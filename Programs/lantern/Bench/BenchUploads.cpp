// lantern bench uploads: the stream of meshes, and the figures.
#include "Bench/BenchUploads.h"

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <thread>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "Bench/BenchGrid.h"
#include "Bench/BenchModuleEngine.h"
#include "Bench/BenchRun.h"
#include "Bench/BenchTimes.h"
#include "LanternRHIMock/MockDevice.h"

namespace Lantern
{

namespace
{
constexpr uint32_t QuickMeshes = 1'000;
constexpr int IdleFrames = 300;
constexpr int MostFrames = 200'000;

struct FTimes
{
	std::vector<double> Wall, Processor;
	void Add(const FBenchModuleEngine::FFrameTime& Time)
	{
		Wall.push_back(Time.Milliseconds);
		Processor.push_back(Time.ProcessorMilliseconds);
	}
};

double FindPercentile(std::vector<double> Values, double Share)
{
	if (Values.empty()) { return 0.0; }
	std::sort(Values.begin(), Values.end());
	return Values[std::min(Values.size() - 1, static_cast<size_t>(Share * double(Values.size())))];
}

nlohmann::json MakeJson(const std::vector<double>& Idle, const std::vector<double>& Busy)
{
	const double Base = FindPercentile(Idle, 0.5);
	return {{"idle_ms", Base}, {"idle_p99_ms", FindPercentile(Idle, 0.99)}, {"idle_worst_ms", FindPercentile(Idle, 1.0)},
	    {"added_ms", FindPercentile(Busy, 0.5) - Base}, {"added_p99_ms", FindPercentile(Busy, 0.99) - Base},
	    {"added_worst_ms", FindPercentile(Busy, 1.0) - Base}};
}

void Print(const char* Clock, const nlohmann::json& Json)
{
	const auto Get = [&](const char* Name) { return Json[Name].get<double>(); };
	fmt::print("{:>10} {:>9.3f} {:>9.3f} {:>9.3f} {:>12.3f} {:>9.3f} {:>9.3f}\n", Clock, Get("idle_ms"), Get("idle_p99_ms"),
	    Get("idle_worst_ms"), Get("added_ms"), Get("added_p99_ms"), Get("added_worst_ms"));
	std::fflush(stdout);
}

/// Frames until all that was added is there.
FRTStatus Settle(FBenchModuleEngine& Engine, FTimes* Out)
{
	FRTStatus Status;
	for (int Frame = 0; Frame < MostFrames && Status; ++Frame)
	{
		FBenchModuleEngine::FFrameTime Time;
		Status = Engine.Frame(Time);
		if (Out != nullptr) { Out->Add(Time); }
		if (Time.bComplete) { break; }
		std::this_thread::yield();
	}
	return Status;
}

FRTStatus Stream(
    FBenchModuleEngine& Engine, const FBenchGrid& Grid, uint32_t Meshes, ERTMaterialHandle Material, FTimes& Out, double& OutMs)
{
	std::atomic<bool> bRunning = true;
	FRTStatus StreamStatus;
	const auto Start = FBenchClock::now();
	std::thread Streaming([&] {
		for (uint32_t Mesh = 1; Mesh <= Meshes && StreamStatus; ++Mesh)
		{
			StreamStatus = AddBenchGrid(Engine.GetRenderer(), Grid, Material, Mesh);
		}
		OutMs = GetMsSince(Start);
		bRunning = false;
	});
	FRTStatus Status;
	while (bRunning && Status)
	{
		FBenchModuleEngine::FFrameTime Time;
		Status = Engine.Frame(Time);
		Out.Add(Time);
	}
	Streaming.join();
	if (Status) { Status = Settle(Engine, &Out); }
	return Status ? StreamStatus : Status;
}

FRTStatus Measure(FBenchModuleEngine& Engine, const FBenchUploadsOptions& Options, uint32_t Meshes, nlohmann::json& Json)
{
	const FBenchGrid Grid(Options.Triangles);
	ERTMaterialHandle Material = ERTMaterialHandle::None;
	FRTStatus Status = Engine.GetRenderer().AddMaterial({}, &Material);
	Status = Status ? AddBenchGrid(Engine.GetRenderer(), Grid, Material, 0) : Status;
	FRTModuleSun Sun;
	Sun.Irradiance = 1.0f;
	Status = Status ? Engine.GetRenderer().SetSun(Sun) : Status;
	FTimes First, Idle, Busy;
	Status = Status ? Settle(Engine, &First) : Status;
	for (int Frame = 0; Frame < IdleFrames && Status; ++Frame)
	{
		FBenchModuleEngine::FFrameTime Time;
		Status = Engine.Frame(Time);
		Idle.Add(Time);
	}
	double StreamMs = 0.0;
	Status = Status ? Stream(Engine, Grid, Meshes, Material, Busy, StreamMs) : Status;
	if (!Status) { return Status; }
	const FRTCapabilities& Capabilities = Engine.GetDevice().GetCapabilities();
	Json = DescribeBenchDevice(Capabilities);
	Json.update({{"meshes", Meshes}, {"triangles", Grid.GetIndexCount() / 3}, {"transfer_queue", Capabilities.bTransferQueue},
	    {"frames", Busy.Wall.size()}, {"add_us", 1e3 * StreamMs / Meshes}, {"first_frame_ms", First.Wall.front()},
	    {"wall", MakeJson(Idle.Wall, Busy.Wall)}, {"processor", MakeJson(Idle.Processor, Busy.Processor)}});
	fmt::print("{} meshes of {} triangles, {}; {:.1f} us for each on the thread that adds them; {} frames until all are there\n", Meshes,
	    Grid.GetIndexCount() / 3, Capabilities.bTransferQueue ? "queue for copies" : "copies within frames", Json["add_us"].get<double>(),
	    Busy.Wall.size());
	fmt::print("the first frame took {:.1f} ms. Render thread, ms:\n", First.Wall.front());
	fmt::print("{:>10} {:>9} {:>9} {:>9} {:>12} {:>9} {:>9}\n", "", "idle", "99 %", "worst", "added: half", "99 %", "worst");
	Print("clock", Json["wall"]);
	Print("processor", Json["processor"]);
	return Status;
}
} // namespace

void FBenchUploadsOptions::AddTo(CLI::App& App)
{
	App.add_option("--meshes", Meshes, "Meshes that come")->check(CLI::Range(1, 1'000'000));
	App.add_option("--triangles", Triangles, "Triangles of each, about")->check(CLI::Range(2, 10'000'000));
	App.add_flag("--mock", bMock, "Uses the mock device, for the CPU's part alone");
	App.add_flag("--validate", bValidate, "Vulkan validation layers on");
	App.add_flag("--quick", bQuick, "A tenth of the meshes");
	App.add_option("--set", Settings, "Console variable, NAME=VALUE");
	AddBenchJson(App, Json);
}

int RunBenchUploads(const FBenchUploadsOptions& Options)
{
	return RunBench(Options.Json, [&](nlohmann::json& Figures) {
		TRTRef<IRTDevice> Mock;
		FRTStatus Status = Options.bMock ? CreateBenchMock(Mock) : FRTStatus::Success();
		FBenchModuleEngine Engine;
		Status = Status ? Engine.Open({.Mock = Mock.Get(), .bValidate = Options.bValidate, .Settings = Options.Settings}) : Status;
		const uint32_t Meshes = Options.bQuick ? std::min(Options.Meshes, QuickMeshes) : Options.Meshes;
		Status = Status ? Measure(Engine, Options, Meshes, Figures) : Status;
		if (!Status) { return ReportStatus(Status, "bench uploads"); }
		return Options.bValidate && Engine.GetDevice().GetValidationMessageCount() > 0 ? ExitCheckFailed : ExitDone;
	});
}

} // namespace Lantern
