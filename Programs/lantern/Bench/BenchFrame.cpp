// lantern bench frame: renders the open world stage by stage and times the render thread.
#include "Bench/BenchFrame.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "Bench/BenchRun.h"
#include "Bench/BenchTimes.h"
#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternCore/Tasks/Tasks.h"
#include "LanternCore/Text/Log.h"
#include "LanternRHIMock/MockDevice.h"

namespace Lantern
{

namespace
{
struct FStage
{
	const char* Name;
	std::vector<std::pair<const char*, const char*>> Adds; ///< console variables, on top of those of the stage before
};

const std::vector<FStage>& GetStages()
{
	static const std::vector<FStage> Stages = {
	    {"baseline", {{"r.RT.Culling", "0"}, {"r.RT.Scene.Gather", "0"}, {"r.RT.SBT.Mode", "0"}, {"r.RT.Scene.Hoist", "0"},
	                     {"r.RT.SBT.Prebind", "0"}, {"r.RT.FrameGraph.Tasks", "0"}}},
	    {"cull_and_global_table", {{"r.RT.Culling", "1"}, {"r.RT.SBT.Mode", "1"}}},
	    {"hoisted_gather_and_prebuild", {{"r.RT.Scene.Gather", "1"}, {"r.RT.Scene.Hoist", "1"}}},
	    {"prebound_sbt", {{"r.RT.SBT.Prebind", "1"}}}, {"recorded_on_tasks", {{"r.RT.FrameGraph.Tasks", "1"}}}};
	return Stages;
}

void SetStage(size_t Stage)
{
	for (size_t I = 0; I <= Stage; ++I)
	{
		for (const auto& [Name, Value] : GetStages()[I].Adds)
		{
			FConsoleVariables::Get().Set(Name, Value, ERTSetBy::Console, "bench frame");
		}
	}
}

/// Milliseconds of the frames of one stage, by part.
class FStageTimes
{
public:
	void Add(const std::string& Part, double Ms)
	{
		if (!Parts.count(Part)) { Order.push_back(Part); }
		Parts[Part].Add(Ms);
	}
	/// Has no values if there is no such part.
	FBenchTimes Get(const std::string& Part) const
	{
		const auto Found = Parts.find(Part);
		return Found != Parts.end() ? Found->second : FBenchTimes();
	}
	const std::vector<std::string>& GetParts() const { return Order; }
	/// Of the device. Has no parts where the device has no clock.
	std::map<std::string, FBenchTimes> Gpu;

private:
	std::vector<std::string> Order;
	std::map<std::string, FBenchTimes> Parts;
};

constexpr double FirstRoundWork = 4.0; // it builds everything; in rounds
const std::string Critical = "critical path";
const std::string Busy = "  processor time";

/// Processor time of the calling thread. Time taken by other programs is no part of it, nor is time spent waiting.
class FFrameBench
{
public:
	FFrameBench(FRenderer& InRenderer, const FBenchFrameOptions& InOptions)
	    : Renderer(InRenderer),
	      Options(InOptions),
	      GBufferPass(InRenderer)
	{}
	FRTStatus Load();
	FRTStatus Measure();
	nlohmann::json ToJson() const;
	void Print() const;

private:
	struct FChanges
	{
		std::vector<glm::dmat4> Movers;
		std::vector<std::vector<glm::mat4>> Joints;
		std::vector<std::pair<FRTObjectId, std::vector<uint32_t>>> Materials;
	};
	FView MakeView() const;
	FChanges MakeChanges() const;
	FRTStatus RenderFrame(FStageTimes* Times);
	FRTStatus WaitForDevice();

	FRenderer& Renderer;
	const FBenchFrameOptions& Options;
	FGBufferPass GBufferPass;
	FBenchWorld World; // its description is the host scene's
	std::vector<FHostNode> MoverNodes;
	std::unique_ptr<FHostScene> Host;
	uint32_t Width = 0, Height = 0;
	uint32_t Frame = 0;
	std::map<size_t, FStageTimes> Times; // by stage
	std::map<size_t, uint32_t> Instances;
};

FRTStatus FFrameBench::Load()
{
	FPictureOptions Picture;
	const bool bIsCpu = Options.bMock || Renderer.GetDevice().GetCapabilities().bIsCpu;
	ParseSize(!Options.Size.empty() ? Options.Size : bIsCpu ? "64x36" : "1280x720", Picture);
	Width = Picture.Width;
	Height = Picture.Height;
	World = MakeBenchWorld(Options.World);
	for (const uint32_t Mover : World.Movers) { MoverNodes.push_back(World.Scene.Nodes[Mover]); }
	if (FRTStatus S = FHostScene::Create(Renderer, std::move(World.Scene), {}, Host); !S) { return S; }
	FSunLight Sun;
	Sun.Direction = {0.3, -1, 0.4};
	Sun.Irradiance = 4.0f;
	Sun.AngularDiameter = 0.0093f;
	Host->SetSun(Sun);
	// Whatever the size of the picture, the raster draws what a screen of 1080 lines would show.
	GBufferPass.SetMinPixels(float(Height) / 1080.0f);
	Host->GetScene().SetSky(glm::vec3(0.4f, 0.6f, 1.0f));
	if (Options.bMock)
	{
		GetMock(&Renderer.GetDevice()).SetManualFences(true); // Submit hands over, as with a GPU, and does not execute
	}
	FConsoleVariables::Get().Set("r.RT.Shadow.Path", "1", ERTSetBy::Console, "bench frame");
	return FRTStatus::Success();
}

FView FFrameBench::MakeView() const
{
	// 15 m/s at 60 frames a second, looking about.
	const double Time = Frame / 60.0, Angle = 0.3 * Time;
	const glm::dvec3 Position(15.0 * Time - 200.0, 1.8, 0);
	FView View = LookAt(Position, Position + glm::dvec3(std::cos(Angle), 0, std::sin(Angle)), 1.1f, Width, Height);
	View.FrameIndex = Frame;
	return View;
}

/// What the game thread hands over: no part of the measured time.
FFrameBench::FChanges FFrameBench::MakeChanges() const
{
	FChanges Changes;
	for (uint32_t I = 0; I < World.Movers.size(); ++I) { Changes.Movers.push_back(MoveObject(MoverNodes[I], I, Frame)); }
	for (uint32_t I = 0; I < World.Characters.size(); ++I) { Changes.Joints.push_back(BendCharacter(I, Frame)); }
	const size_t Rigid = Host->GetInstanceCount() - World.Characters.size() - 1;
	for (uint32_t I = 0; I < Options.World.Repainted; ++I)
	{
		const size_t Instance = 1 + (size_t(Frame) * 7919 + I * 131) % Rigid;
		const FHostNode& Node = Host->GetDescription().Nodes[Instance];
		Changes.Materials.emplace_back(Host->GetDraws()[Instance].Object, Repaint(Node.Materials, Frame));
	}
	return Changes;
}

FRTStatus FFrameBench::WaitForDevice()
{
	if (Options.bMock)
	{
		FRTMock& Mock = GetMock(&Renderer.GetDevice());
		Mock.CompleteUpTo(Mock.GetLastFence());
	}
	return Renderer.WaitForAll();
}

FRTStatus FFrameBench::RenderFrame(FStageTimes* OutTimes)
{
	const FView View = MakeView();
	FChanges Changes = MakeChanges();
	++Frame;
	// A CPU driver's threads would take the cores that the frame's tasks are to have.
	if (FRTStatus S = WaitForDevice(); !S) { return S; }
	Renderer.GetDevice().CollectGarbage();
	using FClock = std::chrono::steady_clock;
	const double StartBusy = GetThreadMs();
	const auto Start = FClock::now();
	FConsoleVariables::Get().BeginFrame();
	FFrameFeatures Features;
	Features.bWaitForPipelines = Frame == 1;
	for (size_t I = 0; I < World.Movers.size(); ++I) { Host->SetTransform(World.Movers[I], Changes.Movers[I]); }
	for (auto& [Object, Materials] : Changes.Materials) { Host->GetScene().SetMaterials(Object, std::move(Materials)); }
	Features.Skinning.reserve(World.Characters.size());
	for (size_t I = 0; I < World.Characters.size(); ++I)
	{
		Features.Skinning.push_back(Host->MakeSkinning(World.Characters[I], std::move(Changes.Joints[I])));
	}
	const auto Applied = FClock::now();
	if (FRTStatus S = Renderer.BeginFrame(Host->GetScene(), View, Features); !S) { return S; }
	const auto Begun = FClock::now();
	FFrameContext& Context = Renderer.GetContext();
	const FFrameOutputs Outputs = AddFramePasses(Context, GBufferPass.Add(Context, *Host));
	Context.Graph.AddPass("Present", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.NeverCull();
		Builder.Read(Outputs.Display, ERTAccess::CopyRead);
		return {};
	});
	const auto Added = FClock::now();
	if (FRTStatus S = Renderer.EndFrame(nullptr); !S) { return S; }
	const auto Ended = FClock::now();
	const double EndBusy = GetThreadMs();
	if (!OutTimes) { return FRTStatus::Success(); }
	const auto Ms = [](auto From, auto To) { return std::chrono::duration<double, std::milli>(To - From).count(); };
	OutTimes->Add(Critical, Ms(Start, Ended));
	OutTimes->Add(Busy, EndBusy - StartBusy);
	OutTimes->Add("apply changes", Ms(Start, Applied));
	OutTimes->Add("begin frame", Ms(Applied, Begun));
	OutTimes->Add("add passes", Ms(Begun, Added));
	OutTimes->Add("record and submit", Ms(Added, Ended));
	if (FRTStatus S = WaitForDevice(); !S) { return S; }
	for (const FPassTiming& Pass : Renderer.GetGraphResources().GetTimings())
	{
		OutTimes->Add("  " + Pass.Name, Pass.CpuMs);
		if (Pass.GpuMs >= 0.0 && !Options.bMock) { OutTimes->Gpu["  " + Pass.Name].Add(Pass.GpuMs); }
	}
	return FRTStatus::Success();
}

FRTStatus FFrameBench::Measure()
{
	FBenchProgress Progress("frame", FirstRoundWork + Options.Rounds);
	const size_t StageCount = GetStages().size();
	for (uint32_t Round = 0; Round <= Options.Rounds; ++Round)
	{
		Progress.Begin(
		    Round == 0 ? "first frames" : fmt::format("round {} of {}", Round, Options.Rounds), Round == 0 ? FirstRoundWork : 1.0);
		for (size_t Stage = 0; Stage < StageCount; ++Stage)
		{
			SetStage(Stage);
			// The first round builds everything; the first frame of a stage pays for the change from the one before.
			for (int I = 0; I < (Round == 0 ? 2 : 3); ++I)
			{
				const bool bTimed = Round > 0 && I > 0;
				if (FRTStatus S = RenderFrame(bTimed ? &Times[Stage] : nullptr); !S) { return S; }
				Instances[Stage] = Host->GetScene().GetStats().InstancesWritten;
			}
		}
	}
	return WaitForDevice();
}

nlohmann::json FFrameBench::ToJson() const
{
	nlohmann::json Json = DescribeBenchDevice(Renderer.GetDevice().GetCapabilities());
	Json.update({{"objects", Options.World.Objects}, {"skinned", Options.World.Characters}, {"moved", Options.World.Movers},
	    {"repainted", Options.World.Repainted}, {"section_ranges", Host->GetScene().GetSections().GetRangeCount()},
	    {"sections", Host->GetScene().GetSections().GetCapacity()}, {"threads", GetWorkerCount()}, {"width", Width}, {"height", Height},
	    {"stages", nlohmann::json::array()}});
	for (const auto& [Stage, Of] : Times)
	{
		nlohmann::json Parts = nlohmann::json::object(), Gpu = nlohmann::json::object();
		for (const std::string& Part : Of.GetParts()) { Parts[Part] = Of.Get(Part).GetMedian(); }
		for (const auto& [Part, Ms] : Of.Gpu) { Gpu[Part] = Ms.GetMedian(); }
		Json["stages"].push_back({{"name", GetStages()[Stage].Name}, {"cpu_critical_ms", Of.Get(Critical).GetMedian()},
		    {"processor_ms", Of.Get(Busy).GetMedian()}, {"min_ms", Of.Get(Critical).GetMin()}, {"max_ms", Of.Get(Critical).GetMax()},
		    {"instances", Instances.at(Stage)}, {"breakdown_ms", Parts}, {"gpu_ms", Gpu}});
	}
	Json["ratio_processor_time"] = Times.at(0).Get(Busy).GetMedian() / Times.rbegin()->second.Get(Busy).GetMedian();
	Json["ratio"] = Times.at(0).Get(Critical).GetMedian() / Times.rbegin()->second.Get(Critical).GetMedian();
	return Json;
}

void FFrameBench::Print() const
{
	fmt::print("{:<20}", "render thread, ms");
	for (const FStage& Stage : GetStages()) { fmt::print(" {:>28}", Stage.Name); }
	const std::map<std::string, FBenchTimes>& Gpu = Times.rbegin()->second.Gpu;
	if (!Gpu.empty()) { fmt::print(" {:>10}", "GPU ms"); } // of the last stage
	std::vector<std::string> Rows = {Critical};
	for (const auto& [Stage, Of] : Times)
	{
		for (const std::string& Part : Of.GetParts())
		{
			if (std::find(Rows.begin(), Rows.end(), Part) == Rows.end()) { Rows.push_back(Part); }
		}
	}
	for (const std::string& Row : Rows)
	{
		fmt::print("\n{:<20}", Row);
		for (const auto& [Stage, Of] : Times)
		{
			const std::string Range =
			    Row == Critical || Row == Busy ? fmt::format(" [{:.2f}, {:.2f}]", Of.Get(Row).GetMin(), Of.Get(Row).GetMax()) : "";
			fmt::print(" {:>28}", fmt::format("{:.3f}{}", Of.Get(Row).GetMedian(), Range));
		}
		if (const auto Found = Gpu.find(Row); Found != Gpu.end()) { fmt::print(" {:>10.3f}", Found->second.GetMedian()); }
	}
	fmt::print("\n{:<20}", "instances");
	for (const auto& [Stage, Count] : Instances) { fmt::print(" {:>28}", Count); }
	const auto Ratio = [&](const std::string& Part) {
		return Times.at(0).Get(Part).GetMedian() / Times.rbegin()->second.Get(Part).GetMedian();
	};
	fmt::print("\nbaseline / last stage: {:.2f} (processor time: {:.2f})\n", Ratio(Critical), Ratio(Busy));
}

int RunOn(FRenderer& Renderer, const FBenchFrameOptions& Options, nlohmann::json& Figures)
{
	FFrameBench Bench(Renderer, Options);
	if (FRTStatus S = Bench.Load(); !S) { return ReportStatus(S, "bench frame"); }
	if (FRTStatus S = Bench.Measure(); !S) { return ReportStatus(S, "bench frame"); }
	Bench.Print();
	Figures = Bench.ToJson();
	return ExitDone;
}

int RunInSession(FSession& Session, const FBenchFrameOptions& Options, nlohmann::json& Figures)
{
	if (Session.GetDevice().GetCapabilities().bRayTracingPipeline) { return RunOn(Session.GetEngine().GetRenderer(), Options, Figures); }
	LogError("bench frame: the device has no ray-tracing pipelines");
	return ExitNoDevice;
}
} // namespace

void FBenchFrameOptions::AddTo(CLI::App& App)
{
	Device.AddTo(App);
	AddBenchQuick(App, [this] {
		World.Objects = 5000;
		World.Characters = 25;
		World.Movers = 50;
		World.Repainted = 10;
		Rounds = 2;
	});
	App.add_option("--objects", World.Objects, "Objects of the world")->check(CLI::Range(1'000, 4'000'000));
	App.add_option("--skinned", World.Characters, "Characters among them that deform each frame")->check(CLI::Range(0, 900));
	App.add_option("--moved", World.Movers, "Objects among them that move each frame")->check(CLI::Range(0, 4'000'000));
	App.add_option("--repainted", World.Repainted, "Objects among them that get other materials each frame")
	    ->check(CLI::Range(0, 4'000'000));
	App.add_option("--rounds", Rounds, "Rounds of all stages in turn; two measured frames of each stage in each")
	    ->check(CLI::Range(1, 10'000));
	AddBenchSize(App, Size, "1280x720; on a CPU device 64x36");
	App.add_flag("--mock", bMock, "On a pretended device without a driver: the plugin's own work alone");
	AddBenchJson(App, Json);
}

int RunBenchFrame(const FBenchFrameOptions& Options)
{
	return RunBench(Options.Json, [&](nlohmann::json& Figures) {
		if (!Options.bMock)
		{
			return RunInBenchSession(Options.Device, [&](FSession& Session) { return RunInSession(Session, Options, Figures); });
		}
		return RunOnBenchMock(Options.Device, [&](IRTDevice& Device) {
			FRenderer Renderer(Device, FindPluginFolders().DescribeRenderer());
			return RunOn(Renderer, Options, Figures);
		});
	});
}

} // namespace Lantern
