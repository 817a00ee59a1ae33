// lantern bench first: renderers one after another, each from its first frame to complete ones.
#include "Bench/BenchFirstFrame.h"

#include <algorithm>
#include <cstdio>
#include <thread>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "Bench/BenchGrid.h"
#include "Bench/BenchModuleEngine.h"
#include "Bench/BenchRun.h"
#include "Bench/BenchTimes.h"

namespace Lantern
{

namespace
{
constexpr uint32_t QuickRounds = 3;
constexpr uint32_t Triangles = 512;
constexpr int MostFrames = 200'000;
constexpr int LaterFrames = 100;

/// Milliseconds of the render thread.
struct FTimes
{
	double First = 0.0;
	double Worst = 0.0; ///< of the others until all shaders are there
	double Later = 0.0; ///< median after that
};

struct FRound
{
	FTimes Wall, Processor;
};

FRTStatus AddScene(IRTModuleRenderer& Renderer, uint32_t Objects)
{
	const FBenchGrid Grid(Triangles);
	ERTMaterialHandle Material = ERTMaterialHandle::None;
	FRTStatus Status = Renderer.AddMaterial({}, &Material);
	for (uint32_t Number = 0; Number < Objects && Status; ++Number) { Status = AddBenchGrid(Renderer, Grid, Material, Number); }
	FRTModuleSun Sun;
	Sun.Irradiance = 1.0f;
	Sun.AngularDiameter = 0.01f; // soft shadows are filtered
	const float Sky[] = {0.4f, 0.6f, 1.0f};
	Status = Status ? Renderer.SetSun(Sun) : Status;
	return Status ? Renderer.SetSky(Sky) : Status;
}

FRTStatus RenderRound(FBenchModuleEngine& Engine, uint32_t Objects, FRound& Out)
{
	FRTStatus Status = AddScene(Engine.GetRenderer(), Objects);
	FBenchModuleEngine::FFrameTime Time;
	Status = Status ? Engine.Frame(Time) : Status;
	Out.Wall.First = Time.Milliseconds;
	Out.Processor.First = Time.ProcessorMilliseconds;
	for (int Frame = 0; Frame < MostFrames && Status && !Time.bComplete; ++Frame)
	{
		std::this_thread::yield();
		Status = Engine.Frame(Time);
		Out.Wall.Worst = std::max(Out.Wall.Worst, Time.Milliseconds);
		Out.Processor.Worst = std::max(Out.Processor.Worst, Time.ProcessorMilliseconds);
	}
	FBenchTimes Wall, Processor;
	for (int Frame = 0; Frame < LaterFrames && Status; ++Frame)
	{
		Status = Engine.Frame(Time);
		Wall.Add(Time.Milliseconds);
		Processor.Add(Time.ProcessorMilliseconds);
	}
	Out.Wall.Later = Wall.GetMedian();
	Out.Processor.Later = Processor.GetMedian();
	return Status;
}

void Print(uint32_t Round, const FRound& Figures)
{
	fmt::print("{:>6} {:>9.3f} {:>9.3f} {:>9.3f} {:>12.3f} {:>9.3f} {:>9.3f}\n", Round + 1, Figures.Wall.First, Figures.Wall.Worst,
	    Figures.Wall.Later, Figures.Processor.First, Figures.Processor.Worst, Figures.Processor.Later);
	std::fflush(stdout);
}

nlohmann::json ToJson(const FTimes& Times) { return {{"first_ms", Times.First}, {"worst_ms", Times.Worst}, {"later_ms", Times.Later}}; }

FRTStatus MeasureRound(const FBenchFirstFrameOptions& Options, uint32_t Round, nlohmann::json& Figures)
{
	TRTRef<IRTDevice> Mock;
	if (FRTStatus Status = Options.bMock ? CreateBenchMock(Mock) : FRTStatus::Success(); !Status) { return Status; }
	FBenchModuleEngine Engine;
	FBenchModuleEngine::FOptions Open;
	Open.Mock = Mock.Get();
	Open.bCache = !Options.bCold;
	Open.Settings = Options.Settings;
	for (const FSignalInfo& Info : SignalInfos) { Open.Wanted.Add(Info.Signal); }
	FRound Times;
	FRTStatus Status = Engine.Open(Open);
	if (!Status) { return Status; }
	const auto Render = [&] { Status = RenderRound(Engine, Options.Objects, Times); };
	if (Options.bOtherThread) { std::thread(Render).join(); }
	else { Render(); }
	if (!Status) { return Status; }
	if (Figures.empty())
	{
		Figures = DescribeBenchDevice(Engine.GetDevice().GetCapabilities());
		Figures.update({{"objects", Options.Objects}, {"cold", Options.bCold}, {"rounds", nlohmann::json::array()}});
	}
	Figures["rounds"].push_back({{"wall", ToJson(Times.Wall)}, {"processor", ToJson(Times.Processor)}});
	Print(Round, Times);
	return Status;
}
} // namespace

void FBenchFirstFrameOptions::AddTo(CLI::App& App)
{
	AddBenchQuick(App, [this] { Rounds = QuickRounds; });
	App.add_option("--objects", Objects, "Objects that are there before the first frame")->check(CLI::Range(1, 100'000));
	App.add_option("--rounds", Rounds, "Renderers, one after another")->check(CLI::Range(1, 1'000));
	App.add_flag("--mock", bMock, "Uses the mock device, for the CPU's part alone");
	App.add_flag("--cold", bCold, "Compiles all shaders from their text");
	App.add_flag("--other-thread", bOtherThread, "Renders on another thread than that which creates the renderer");
	App.add_option("--set", Settings, "Console variable, NAME=VALUE");
	AddBenchJson(App, Json);
}

int RunBenchFirstFrame(const FBenchFirstFrameOptions& Options)
{
	return RunBench(Options.Json, [&](nlohmann::json& Figures) {
		fmt::print("{} objects; the render thread's time in ms, by the clock and of the processor\n", Options.Objects);
		fmt::print("{:>6} {:>9} {:>9} {:>9} {:>12} {:>9} {:>9}\n", "round", "first", "worst", "later", "first", "worst", "later");
		for (uint32_t Round = 0; Round < Options.Rounds; ++Round)
		{
			if (const FRTStatus Status = MeasureRound(Options, Round, Figures); !Status) { return ReportStatus(Status, "bench first"); }
		}
		return int(ExitDone);
	});
}

} // namespace Lantern
