// Measures the sun shadow pass and the raw dispatch in turn.
#include "Bench/BenchRays.h"

#include <algorithm>
#include <ctime>

#include "Bench/BenchRawShadow.h"
#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternRenderer/HostSurface.h"

namespace Lantern
{

namespace
{
constexpr uint16_t HalfOne = 0x3c00;

void Set(const char* Name, const char* Value) { FConsoleVariables::Get().Set(Name, Value, ERTSetBy::CommandLine, "bench rays"); }

template <class T>
T GetVariable(const char* Name)
{
	return std::get<T>(FConsoleVariables::Get().Find(Name)->GetValue());
}

/// Processor time of all threads of the process: a CPU driver's workers are among them.
double GetProcessorMs() { return double(std::clock()) * (1000.0 / CLOCKS_PER_SEC); }
} // namespace

double FRayCase::GetRawMrays() const { return double(Rays) / Raw.GetMedian() * 1e-3; }
double FRayCase::GetPluginMrays() const { return double(Rays) / Plugin.GetMedian() * 1e-3; }

FRayBench::FRayBench(IRTDevice& InDevice, FSampleEngine& InEngine, FRayBenchSettings InSettings)
    : Device(InDevice),
      Engine(InEngine),
      Settings(std::move(InSettings)),
      Compiler(FShaderCompilerDesc{Settings.ShaderFolders, Settings.CacheFolder})
{}

FRTStatus FRayBench::CreateTargets()
{
	FRTTextureDesc Texture;
	Texture.Width = View.Width;
	Texture.Height = View.Height;
	Texture.Usage = ERTTextureUsage::Sampled | ERTTextureUsage::CopyDest;
	Texture.Format = ERTFormat::D32_FLOAT;
	Texture.Name = "BenchDepth";
	if (FRTStatus S = Device.CreateTexture(Texture, Depth.ReleaseAndGetAddress()); !S) { return S; }
	Texture.Format = ERTFormat::RGBA16_SNORM;
	Texture.Name = "BenchNormals";
	if (FRTStatus S = Device.CreateTexture(Texture, Normals.ReleaseAndGetAddress()); !S) { return S; }
	const uint64_t Pixels = uint64_t(View.Width) * View.Height;
	const ERTBufferUsage Both = ERTBufferUsage::CopySource | ERTBufferUsage::CopyDest;
	if (FRTStatus S = Device.CreateBuffer({Pixels * 4, Both, ERTMemory::Device, "BenchDepth"}, DepthBytes.ReleaseAndGetAddress()); !S)
	{
		return S;
	}
	if (FRTStatus S = Device.CreateBuffer({Pixels * 8, Both, ERTMemory::Device, "BenchNormals"}, NormalBytes.ReleaseAndGetAddress()); !S)
	{
		return S;
	}
	return Device.CreateBuffer(
	    {Pixels * 2, ERTBufferUsage::CopyDest, ERTMemory::Readback, "BenchVisibility"}, Visibility.ReleaseAndGetAddress());
}

void FRayBench::AddCopies(FFrameContext& Context, const FGBuffer& GBuffer)
{
	struct FCopy
	{
		FGraphTexture From, To;
		FGraphBuffer Bytes;
	};
	FFrameGraph& Graph = Context.Graph;
	const FCopy Copies[] = {{GBuffer.Depth, Graph.ImportTexture(Depth.Get(), ERTAccess::None, ERTAccess::ShaderRead, "BenchDepth"),
	                            Graph.ImportBuffer(DepthBytes.Get(), ERTAccess::None, ERTAccess::None, "BenchDepthBytes")},
	    {GBuffer.Normals, Graph.ImportTexture(Normals.Get(), ERTAccess::None, ERTAccess::ShaderRead, "BenchNormals"),
	        Graph.ImportBuffer(NormalBytes.Get(), ERTAccess::None, ERTAccess::None, "BenchNormalBytes")}};
	for (const FCopy& Copy : Copies)
	{
		Graph.AddPass("KeepGBuffer", [&](FPassBuilder& Builder) -> FPassExecute {
			Builder.Read(Copy.From, ERTAccess::CopyRead);
			Builder.Write(Copy.Bytes, ERTAccess::CopyWrite);
			return [=](FPassContext& Pass) {
				Pass.Commands().CopyTextureToBuffer(Pass.GetBuffer(Copy.Bytes), 0, Pass.GetTexture(Copy.From), 0, 0);
			};
		});
		Graph.AddPass("KeepGBuffer", [&](FPassBuilder& Builder) -> FPassExecute {
			Builder.Read(Copy.Bytes, ERTAccess::CopyRead);
			Builder.Write(Copy.To, ERTAccess::CopyWrite);
			return [=](FPassContext& Pass) {
				Pass.Commands().CopyBufferToTexture(Pass.GetTexture(Copy.To), 0, 0, Pass.GetBuffer(Copy.Bytes), 0);
			};
		});
	}
}

FRTStatus FRayBench::CaptureGBuffer(const FView& InView)
{
	View = InView;
	if (FRTStatus S = CreateTargets(); !S) { return S; }
	Engine.ExtraPasses = [this](FFrameContext& Context, const FGBuffer& GBuffer, const FFrameOutputs&) { AddCopies(Context, GBuffer); };
	const FRTStatus Status = Engine.RenderFrame(View, 0.0, {}, nullptr);
	Engine.ExtraPasses = {};
	return Status ? Engine.GetRenderer().WaitForAll() : Status;
}

/// OutSurfaceMs: the G-buffer is read as if it had a far plane and no geometric normals, which this pass took. Null: as it is.
FRTStatus FRayBench::RunPlugin(FPluginMs& Out, double* OutSurfaceMs)
{
	FConsoleVariables::Get().BeginFrame();
	FRenderer& Renderer = Engine.GetRenderer();
	FFrameFeatures Features;
	Features.bHostSurface = OutSurfaceMs != nullptr;
	if (FRTStatus S = Renderer.BeginFrame(Engine.GetScene().GetScene(), View, Features); !S) { return S; }
	FFrameContext& Context = Renderer.GetContext();
	FFrameGraph& Graph = Context.Graph;
	FGBuffer Inputs;
	Inputs.Depth = Graph.ImportTexture(Depth.Get(), ERTAccess::ShaderRead, ERTAccess::ShaderRead, "BenchDepth");
	Inputs.Normals = Graph.ImportTexture(Normals.Get(), ERTAccess::ShaderRead, ERTAccess::ShaderRead, "BenchNormals");
	if (OutSurfaceMs != nullptr)
	{
		constexpr double FarPlane = 1e9; // metres: far enough to change no distance
		FHostSurface Host;
		Host.Depth = Inputs.Depth;
		Host.Normals = Inputs.Normals;
		Host.DepthMeaning = {1.0 / FarPlane, 1.0 / double(View.Near)};
		Host.bGeometricInZw = false;
		Inputs = AddHostSurfacePass(Context, Host);
	}
	const FGraphTexture Shadow = AddSignalPass(Context, ESignal::SunShadow, Inputs);
	if (Shadow.IsValid())
	{
		const FGraphBuffer Bytes = Graph.ImportBuffer(Visibility.Get(), ERTAccess::None, ERTAccess::HostRead, "BenchVisibility");
		Graph.AddPass("Readback", [&](FPassBuilder& Builder) -> FPassExecute {
			Builder.Read(Shadow, ERTAccess::CopyRead);
			Builder.Write(Bytes, ERTAccess::CopyWrite);
			return
			    [=](FPassContext& Pass) { Pass.Commands().CopyTextureToBuffer(Pass.GetBuffer(Bytes), 0, Pass.GetTexture(Shadow), 0, 0); };
		});
	}
	FRTStatus Status = Renderer.EndFrame(nullptr);
	if (Status) { Status = Renderer.WaitForAll(); }
	Out = {};
	for (const FPassTiming& Timing : Renderer.GetGraphResources().GetTimings())
	{
		if (Timing.Name.starts_with("SunShadow") || Timing.Name.starts_with("Shadow")) { Out.All += Timing.GpuMs; }
		if (Timing.Name == "ShadowRays") { Out.Rays = Timing.GpuMs; }
		if (OutSurfaceMs != nullptr && Timing.Name == "HostSurface") { *OutSurfaceMs = Timing.GpuMs; }
	}
	if (Status && Out.Rays <= 0.0)
	{
		return FRTStatus::Error(ERTResult::Unsupported, "no time of the sun's rays: they were not traced, or the device has no timestamps");
	}
	return Status;
}

FRTStatus FRayBench::CreateRaw(bool bPipeline, bool bCountRays, std::unique_ptr<FRawShadow>& Out)
{
	FRawShadowDesc Desc;
	Desc.Device = &Device;
	Desc.Compiler = &Compiler;
	Desc.Scene = &Engine.GetScene();
	Desc.View = View;
	Desc.Depth = Depth.Get();
	Desc.Normals = Normals.Get();
	Desc.MaxDistance = GetVariable<float>("r.RT.Shadow.MaxDistance");
	Desc.InstanceMask = static_cast<uint32_t>(GetVariable<int32_t>("r.RT.Shadow.InstanceMask"));
	Desc.bPipeline = bPipeline;
	Desc.bCountRays = bCountRays;
	return FRawShadow::Create(Desc, Out);
}

FRTStatus FRayBench::RunInTurn(FRawShadow& Raw, FRayCase& Out)
{
	for (uint32_t I = 0; I < Settings.WarmUp + Settings.Repetitions; ++I)
	{
		// Who goes first alternates too: whatever the machine does meanwhile hits both.
		for (const bool bRaw : {I % 2 == 0, I % 2 != 0})
		{
			FPluginMs Ms;
			const double Start = GetProcessorMs();
			if (FRTStatus S = bRaw ? Raw.Run(Ms.All) : RunPlugin(Ms); !S) { return S; }
			if (I < Settings.WarmUp) { continue; }
			(bRaw ? Out.Raw : Out.Plugin).Add(Ms.All);
			(bRaw ? Out.RawProcessor : Out.PluginProcessor).Add(GetProcessorMs() - Start);
			if (!bRaw) { Out.Queue.Add(Ms.Rays); }
		}
	}
	return FRTStatus::Success();
}

FRTStatus FRayBench::RunSurface(FRayCase& Out)
{
	for (uint32_t I = 0; I < Settings.WarmUp + Settings.Repetitions; ++I)
	{
		FPluginMs Shadow;
		double SurfaceMs = 0.0;
		if (FRTStatus S = RunPlugin(Shadow, &SurfaceMs); !S) { return S; }
		if (I < Settings.WarmUp) { continue; }
		Out.Surface.Add(SurfaceMs);
		Out.SurfaceShadow.Add(Shadow.All);
	}
	return FRTStatus::Success();
}

FRTStatus FRayBench::Measure(bool bPipeline, FRayCase& Out)
{
	// What the raw dispatch is written for, whatever the settings say.
	for (const char* Name : {"r.RT.Enable", "r.RT.Shadow", "r.RT.Shadow.Soft", "r.RT.Shadow.Samples"}) { Set(Name, "1"); }
	// Rays to lamps would share the queue, and its time.
	for (const char* Name :
	    {"r.RT.Lights", "r.RT.Shadow.Adaptive", "r.RT.Shadow.RateDistance", "r.RT.Shadow.CasterFaces", "r.RT.Shadow.Denoise"})
	{
		Set(Name, "0");
	}
	Set("r.RT.Shadow.Path", bPipeline ? "1" : "2");
	FPluginMs Ms;
	// The scene's hit records are those of this path only once a frame has taken it.
	FRTStatus Status = RunPlugin(Ms);
	std::unique_ptr<FRawShadow> Raw, Counter;
	Status = Status ? CreateRaw(bPipeline, false, Raw) : Status;
	Status = Status ? CreateRaw(bPipeline, true, Counter) : Status;
	Status = Status ? RunInTurn(*Raw, Out) : Status;
	Status = Status ? Counter->Run(Ms.All) : Status;
	if (!Status) { return Status; }
	Out.Width = View.Width;
	Out.Height = View.Height;
	const uint64_t Pixels = uint64_t(View.Width) * View.Height;
	const auto* const Plugin = static_cast<const uint16_t*>(Visibility->GetMapped());
	Out.Rays = static_cast<uint64_t>(std::count(Counter->GetPicture(), Counter->GetPicture() + Pixels, HalfOne));
	uint64_t Same = 0;
	for (uint64_t I = 0; I < Pixels; ++I) { Same += Plugin[I] == Raw->GetPicture()[I]; }
	Out.Agreement = double(Same) / double(Pixels);
	return RunSurface(Out);
}

} // namespace Lantern
