// Frames of a wall of quads, each with a material of its own, while all materials are compiled.
#include "Bench/BenchPipelineFrames.h"

#include <chrono>
#include <cmath>
#include <thread>

#include "Bench/BenchTimes.h"
#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternMeasure/GeneratedMaterials.h"
#include "LanternMeasure/MaterialWall.h"

namespace Lantern
{

namespace
{
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
	const double Columns = std::ceil(std::sqrt(double(Materials)));
	const FMaterialWall Wall{Materials, static_cast<uint32_t>(Columns), 2.0, 2.1, {-Columns - 1.0, -Columns - 1.0, 0.0}};
	if (FRTStatus S = Engine.Load(MakeMaterialWall(Wall)); !S) { return S; }
	const bool bIsCpu = Device.GetCapabilities().bIsCpu;
	const double Size = 1.2 * Columns;
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
	const auto Start = FBenchClock::now();
	const double StartProcessor = GetThreadMs();
	FConsoleVariables::Get().BeginFrame();
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
	if (RayGen != NoRayGen) { AddMaterialTrace(Context, RayGen, Target); }
	const FRTStatus Status = Renderer.EndFrame(nullptr);
	Out = {GetMsSince(Start), GetThreadMs() - StartProcessor};
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
	const auto Start = FBenchClock::now();
	Status = Bench.Frame(Time, true);
	Status = Status ? Bench.Finish() : Status;
	OutSeconds = 1e-3 * GetMsSince(Start);
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
	const auto Start = FBenchClock::now();
	while (Out.Ready < Materials)
	{
		Out.Worst.Begin();
		if (FRTStatus S = Bench.Frame(Time); !S) { return S; }
		Out.Worst.End(Out.Compiling.size(), Time.Ms);
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
	Out.Worst.AddOthers();
	Out.ArrivedSeconds = 1e-3 * GetMsSince(Start);
	Out.Swaps = Bench.GetCompiler().GetStats().Links - Before;
	return MeasureOnce(Device, Desc, Materials, Out.OnceSeconds);
}

} // namespace Lantern
