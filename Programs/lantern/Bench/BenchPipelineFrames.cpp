// Frames of a wall of quads, each with a material of its own, while all materials are compiled.
#include "Bench/BenchPipelineFrames.h"

#include <chrono>
#include <cmath>
#include <ctime>
#include <thread>

#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternMeasure/GeneratedMaterials.h"

namespace Lantern
{

namespace
{
using FClock = std::chrono::steady_clock;
double MsSince(FClock::time_point Start) { return std::chrono::duration<double, std::milli>(FClock::now() - Start).count(); }

double GetProcessorMs()
{
	timespec Time{};
	clock_gettime(CLOCK_THREAD_CPUTIME_ID, &Time);
	return double(Time.tv_sec) * 1e3 + double(Time.tv_nsec) * 1e-6;
}

struct FTracePush
{
	FPassConstants Pass;
	uint32_t Output;
};

/// A wall of quads, each with a material of its own.
FSceneDescription MakeWall(uint32_t Materials)
{
	FSceneDescription Scene;
	Scene.Name = "Wall";
	FHostMesh Quad;
	Quad.Name = "Quad";
	Quad.Positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
	Quad.Attributes.resize(4);
	Quad.Indices = {0, 1, 2, 0, 2, 3};
	Quad.Sections = {{0, 6, 0}};
	Quad.BoundsMin = {-1, -1, 0};
	Quad.BoundsMax = {1, 1, 0};
	Scene.Meshes.push_back(std::move(Quad));
	const uint32_t Columns = static_cast<uint32_t>(std::ceil(std::sqrt(double(Materials))));
	for (uint32_t Index = 0; Index < Materials; ++Index)
	{
		Scene.Materials.emplace_back();
		FHostNode& Node = Scene.Nodes.emplace_back();
		Node.Mesh = 0;
		Node.Materials = {static_cast<int32_t>(Index)};
		Node.Translation = {2.1 * (Index % Columns) - double(Columns), 2.1 * (Index / Columns) - double(Columns), 0.0};
	}
	return Scene;
}

class FHitchBench
{
public:
	FHitchBench(IRTDevice& InDevice, const FRendererDesc& Desc) : Device(InDevice), Engine(InDevice, Desc) {}
	FRTStatus Load(uint32_t Materials);
	FRTStatus Frame(FFrameTime& Out, bool bWait = false);
	/// Each material gets a program that no driver has seen.
	std::vector<FHitProgram> RenewPrograms(uint32_t Materials);
	FRTPSOCompiler& GetCompiler() { return Engine.GetRenderer().GetRayCompiler(); }
	FRTScene& GetScene() { return Engine.GetScene().GetScene(); }
	FMaterialPrograms& GetPrograms() { return Engine.GetRenderer().GetPrograms(); }
	FRTStatus Finish() { return Engine.GetRenderer().WaitForAll(); }
	double PaceMs = 0.0;

private:
	IRTDevice& Device;
	FSampleEngine Engine;
	FView View;
	TRTRef<IRTTexture> Output;
};

FRTStatus FHitchBench::Load(uint32_t Materials)
{
	if (FRTStatus S = Engine.Load(MakeWall(Materials)); !S) { return S; }
	const bool bIsCpu = Device.GetCapabilities().bIsCpu;
	const double Size = 1.2 * std::ceil(std::sqrt(double(Materials)));
	View = LookAt({0.0, 0.0, 2.0 * Size}, {0.0, 0.0, 0.0}, 1.0f, bIsCpu ? 64 : 1280, bIsCpu ? 36 : 720);
	FRTTextureDesc Desc;
	Desc.Width = View.Width;
	Desc.Height = View.Height;
	Desc.Format = ERTFormat::RGBA16_FLOAT;
	Desc.Usage = ERTTextureUsage::Storage;
	Desc.Name = "BenchOutput";
	return Device.CreateTexture(Desc, Output.ReleaseAndGetAddress());
}

/// The plugin's whole frame, with one dispatch of camera rays that run the materials' closest-hit shaders.
FRTStatus FHitchBench::Frame(FFrameTime& Out, bool bWait)
{
	FRenderer& Renderer = Engine.GetRenderer();
	const auto Start = FClock::now();
	const double StartProcessor = GetProcessorMs();
	FFrameFeatures Features;
	Features.bWaitForPipelines = bWait;
	Features.bRays = true;
	Features.RayGens = {MakeBenchRayGen()};
	View.FrameIndex = Engine.GetFrameIndex();
	Engine.SetFrameIndex(View.FrameIndex + 1);
	if (FRTStatus S = Renderer.BeginFrame(GetScene(), View, Features); !S) { return S; }
	FFrameContext& Context = Renderer.GetContext();
	const FGraphTexture Target = Context.Graph.ImportTexture(Output.Get(), ERTAccess::None, ERTAccess::StorageWrite, "BenchOutput");
	const uint32_t RayGen = Context.RayPipeline ? Context.RayPipeline->FindRayGen(Features.RayGens[0]) : NoRayGen;
	if (RayGen != NoRayGen)
	{
		FFrameContext* const OfFrame = &Context;
		Context.Graph.AddPass("Trace", [&](FPassBuilder& Builder) -> FPassExecute {
			Builder.NeverCull();
			Builder.Write(Target, ERTAccess::StorageWrite);
			return [=](FPassContext& Pass) {
				const FTracePush Push{OfFrame->Pass, Pass.GetTexture(Target)->GetStorageIndex()};
				Pass.Commands().SetPipeline(OfFrame->RayPipeline->GetPipeline());
				Pass.Commands().PushConstants(&Push, sizeof(Push));
				Pass.Commands().TraceRays(OfFrame->RayTable->GetTable(), RayGen, OfFrame->Width, OfFrame->Height, 1);
			};
		});
	}
	const FRTStatus Status = Renderer.EndFrame(nullptr);
	Out = {MsSince(Start), GetProcessorMs() - StartProcessor};
	if (Out.Ms < PaceMs) { std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(PaceMs - Out.Ms)); }
	return Status;
}

std::vector<FHitProgram> FHitchBench::RenewPrograms(uint32_t Materials)
{
	const uint64_t Salt = MakeSalt();
	std::vector<FHitProgram> Programs;
	for (uint32_t Index = 0; Index < Materials; ++Index)
	{
		Programs.push_back({GetPrograms().Add(MakeBenchProgram(Index, Salt)), ERTHitClass::Opaque});
		GetScene().SetMaterialProgram(Index, Programs.back().Program);
	}
	return Programs;
}

FRTStatus MeasureOnce(IRTDevice& Device, const FRendererDesc& Desc, uint32_t Materials, double& OutSeconds)
{
	FHitchBench Bench(Device, Desc);
	FFrameTime Time;
	if (FRTStatus S = Bench.Load(Materials); !S) { return S; }
	FRTStatus Status = Bench.Frame(Time, true);
	Status = Status ? Bench.Finish() : Status;
	if (!Status) { return Status; }
	Bench.RenewPrograms(Materials);
	const auto Start = FClock::now();
	Status = Bench.Frame(Time, true);
	Status = Status ? Bench.Finish() : Status;
	OutSeconds = 1e-3 * MsSince(Start);
	return Status;
}
} // namespace

FRTStatus MeasureHitches(IRTDevice& Device, const FRendererDesc& Desc, uint32_t Materials, uint32_t Threads, double PaceMs, FHitchRun& Out)
{
	FConsoleVariables::Get().Set("r.RT.Pipeline.Threads", std::to_string(Threads), ERTSetBy::Console, "bench rtpso");
	FHitchBench Bench(Device, Desc);
	Bench.PaceMs = PaceMs;
	if (FRTStatus S = Bench.Load(Materials); !S) { return S; }
	constexpr uint32_t WarmUp = 60, Idle = 300;
	FFrameTime Time;
	for (uint32_t Index = 0; Index < WarmUp || Bench.GetCompiler().GetStats().bBusy; ++Index)
	{
		if (FRTStatus S = Bench.Frame(Time); !S) { return S; }
	}
	for (uint32_t Index = 0; Index < Idle; ++Index)
	{
		if (FRTStatus S = Bench.Frame(Time); !S) { return S; }
		Out.Idle.push_back(Time);
	}
	const std::vector<FHitProgram> Programs = Bench.RenewPrograms(Materials);
	const uint64_t Before = Bench.GetCompiler().GetStats().Links;
	const auto Start = FClock::now();
	while (Out.Ready < Materials)
	{
		if (FRTStatus S = Bench.Frame(Time); !S) { return S; }
		Out.Compiling.push_back(Time);
		const auto Current = Bench.GetCompiler().GetCurrent();
		const FRTPSOCompilerStats Stats = Bench.GetCompiler().GetStats();
		if (Stats.Failures > 0 || (!Stats.bBusy && Stats.Ready < Stats.Wanted))
		{
			return FRTStatus::Error(ERTResult::CompileFailed, "a material of the benchmark does not compile");
		}
		Out.Ready = 0;
		for (const FHitProgram Program : Programs) { Out.Ready += Current && Current->GetState(Program) == ERTHitState::Ready ? 1 : 0; }
	}
	if (FRTStatus S = Bench.Finish(); !S) { return S; }
	Out.ArrivedSeconds = 1e-3 * MsSince(Start);
	Out.Swaps = Bench.GetCompiler().GetStats().Links - Before;
	return MeasureOnce(Device, Desc, Materials, Out.OnceSeconds);
}

} // namespace Lantern
