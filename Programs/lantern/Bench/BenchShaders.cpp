// lantern bench shaders: compiles every pipeline that frames may need, and times the driver.
#include "Bench/BenchShaders.h"

#include <algorithm>
#include <chrono>
#include <functional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "Bench/BenchPipelineWhole.h"
#include "Bench/BenchProgress.h"
#include "Bench/BenchRun.h"
#include "Bench/BenchShaderList.h"
#include "LanternCore/Text/Log.h"
#include "LanternHost/SceneLoader.h"
#include "LanternMeasure/Methods.h"

namespace Lantern
{

namespace
{
using FClock = std::chrono::steady_clock;
double SecondsSince(FClock::time_point Start) { return std::chrono::duration<double>(FClock::now() - Start).count(); }

struct FShaderCosts
{
	size_t TextBytes = 0, SpirvBytes = 0;
	double GlslangSeconds = 0.0;
	double CreateSeconds = 0.0;   ///< until the driver has made the pipeline
	double FirstUseSeconds = 0.0; ///< of a dispatch of nothing
	double GetDriverSeconds() const { return CreateSeconds + FirstUseSeconds; }
};

FRTStatus Load(FSampleEngine& Engine, const std::string& Scene)
{
	FLoadResult Loaded = LoadScene(Scene);
	return Loaded.Scene ? Engine.Load(std::move(*Loaded.Scene)) : FRTStatus::Error(ERTResult::IoError, "%s", Loaded.Error.c_str());
}

/// Pipelines are made, and used once without any work: what that takes is compiling.
class FShaderBench
{
public:
	FShaderBench(IRTDevice& InDevice, const std::string& InShaderFolder)
	    : Device(InDevice),
	      ShaderFolder(InShaderFolder),
	      Compiler(FShaderCompilerDesc{{InShaderFolder}, {}})
	{}

	FRTStatus Measure(const FPipelineShaders& Pipeline, FShaderCosts& Out)
	{
		auto Start = FClock::now();
		std::vector<FShaderBinary> Binaries(Pipeline.Shaders.size());
		for (size_t Index = 0; Index < Binaries.size(); ++Index)
		{
			Out.TextBytes += Compiler.GetTextBytes(Pipeline.Shaders[Index]);
			if (FRTStatus S = Compiler.Compile(Pipeline.Shaders[Index], Binaries[Index]); !S) { return S; }
			Out.SpirvBytes += Binaries[Index].Words.size() * sizeof(uint32_t);
		}
		Out.GlslangSeconds = SecondsSince(Start);
		if (Pipeline.IsRays()) { return MeasureRays(Pipeline, Out); }
		return Pipeline.IsRaster() ? MeasureRaster(Pipeline.RasterScene, Out) : MeasureCompute(Binaries.front(), Out);
	}

private:
	FRTStatus MeasureCompute(const FShaderBinary& Binary, FShaderCosts& Out)
	{
		FRTComputePipelineDesc Desc;
		Desc.Shader = Binary.GetCode();
		TRTRef<IRTPipeline> Pipeline;
		const auto Start = FClock::now();
		if (FRTStatus S = Device.CreateComputePipeline(Desc, Pipeline.ReleaseAndGetAddress()); !S) { return S; }
		Out.CreateSeconds = SecondsSince(Start);
		return Use(
		    [&](IRTCommandList& List) {
			List.SetPipeline(Pipeline.Get());
			List.Dispatch(0, 1, 1);
		    },
		    Out);
	}

	FRTStatus MeasureRays(const FPipelineShaders& Pipeline, FShaderCosts& Out)
	{
		FRTPSO Rtpso;
		double DriverMs = 0.0;
		if (FRTStatus S = MakeWholeRTPSO(Device, Compiler, Pipeline.Programs, Pipeline.Rays, Rtpso, &DriverMs); !S) { return S; }
		Out.CreateSeconds = 1e-3 * DriverMs;
		FRTShaderTableDesc TableDesc;
		TableDesc.Pipeline = Rtpso.GetPipeline();
		TableDesc.RayGenCount = TableDesc.MissCount = TableDesc.HitCount = 1;
		TRTRef<IRTShaderTable> Table;
		if (FRTStatus S = Device.CreateShaderTable(TableDesc, Table.ReleaseAndGetAddress()); !S) { return S; }
		Table->SetRecord(ERTRecordKind::RayGen, 0, Rtpso.RayGenGroup(0), nullptr, 0);
		return Use(
		    [&](IRTCommandList& List) {
			List.UpdateShaderTable(Table.Get());
			List.SetPipeline(Rtpso.GetPipeline());
			List.TraceRays(Table.Get(), 0, 0, 1, 1);
		    },
		    Out);
	}

	/// Drivers may compile a raster pipeline at the first draw that has vertices and a target, so that a frame is rendered.
	/// The difference between its first and its second time is what compiling took.
	FRTStatus MeasureRaster(const std::string& Scene, FShaderCosts& Out)
	{
		FMethodScope RasterOnly;
		RasterOnly.Apply({{"r.RT.Enable", "0", "bench shaders"}});
		FSampleEngine Engine(Device, FRendererDesc{{ShaderFolder}, {}});
		if (FRTStatus S = Load(Engine, Scene); !S) { return S; }
		double Ms[2] = {};
		for (double& OfFrame : Ms)
		{
			FFrameCapture Capture;
			Capture.bLighting = true;
			FCapturedFrame Unused;
			if (FRTStatus S = Engine.RenderFrame(Engine.GetScene().MakeDefaultView(32, 32), 0.0, Capture, &Unused); !S) { return S; }
			for (const FPassTiming& Pass : Engine.GetRenderer().GetGraphResources().GetTimings())
			{
				OfFrame += Pass.Name == "GBuffer" ? Pass.GpuMs : 0.0;
			}
		}
		Out.FirstUseSeconds = std::max(1e-3 * (Ms[0] - Ms[1]), 0.0);
		return FRTStatus::Success();
	}

	FRTStatus Use(const std::function<void(IRTCommandList&)>& Record, FShaderCosts& Out)
	{
		TRTRef<IRTCommandList> List;
		if (FRTStatus S = Device.CreateCommandList("Bench", List.ReleaseAndGetAddress()); !S) { return S; }
		if (FRTStatus S = List->Begin(); !S) { return S; }
		Record(*List);
		if (FRTStatus S = List->End(); !S) { return S; }
		const auto Start = FClock::now();
		IRTCommandList* const Lists[] = {List.Get()};
		FRTFence Fence = 0;
		FRTStatus Status = Device.Submit(Lists, 1, &Fence);
		Status = Status ? Device.WaitIdle() : Status;
		Out.FirstUseSeconds = SecondsSince(Start);
		return Status;
	}

	IRTDevice& Device;
	const std::string ShaderFolder;
	FShaderCompiler Compiler;
};

FRTStatus ListAll(const FBenchShadersOptions& Options, const FPluginFolders& Folders, std::vector<FPipelineShaders>& Out)
{
	TRTRef<IRTDevice> Mock;
	if (FRTStatus S = CreateBenchMock(Mock); !S) { return S; }
	FSampleEngine Engine(*Mock, Folders.DescribeRenderer());
	for (const std::string& Scene : Options.Scenes)
	{
		if (FRTStatus S = Load(Engine, Scene); !S) { return S; }
		if (FRTStatus S = ListPipelines(Engine, Scene, Folders.Config + "/Methods.ini", Out); !S) { return S; }
	}
	std::erase_if(Out, [&](const FPipelineShaders& Pipeline) { return Pipeline.Name.find(Options.Match) == std::string::npos; });
	return FRTStatus::Success();
}

using FMeasured = std::pair<const FPipelineShaders*, FShaderCosts>;

void PrintShaderHeader()
{
	fmt::print("{:>9} {:>10} {:>9} {:>12} {:>9} {:>9}  {}\n", "text KB", "SPIR-V KB", "glslang s", "pipeline s", "1st use s", "driver s",
	    "pipeline");
}

void PrintRow(const FPipelineShaders& Pipeline, const FShaderCosts& Costs)
{
	fmt::print("{:>9.1f} {:>10.1f} {:>9.3f} {:>12.3f} {:>9.3f} {:>9.3f}  {}\n", 1e-3 * double(Costs.TextBytes),
	    1e-3 * double(Costs.SpirvBytes), Costs.GlslangSeconds, Costs.CreateSeconds, Costs.FirstUseSeconds, Costs.GetDriverSeconds(),
	    Pipeline.Name);
	std::fflush(stdout);
}

/// All: dearest first.
void PrintSummary(const std::vector<FMeasured>& All)
{
	constexpr size_t Shown = 5;
	fmt::print("dearest:\n");
	for (size_t I = 0; I < std::min(Shown, All.size()); ++I) { PrintRow(*All[I].first, All[I].second); }
	double Sum = 0.0;
	for (const auto& [Pipeline, Costs] : All) { Sum += Costs.GetDriverSeconds(); }
	fmt::print("{} pipelines, {:.1f} s of the driver\n", All.size(), Sum);
}

nlohmann::json MakeJson(const std::vector<FMeasured>& All)
{
	nlohmann::json Json = nlohmann::json::array();
	for (const auto& [Pipeline, Costs] : All)
	{
		Json.push_back({{"name", Pipeline->Name}, {"text_bytes", Costs.TextBytes}, {"spirv_bytes", Costs.SpirvBytes},
		    {"glslang_seconds", Costs.GlslangSeconds}, {"create_seconds", Costs.CreateSeconds},
		    {"first_use_seconds", Costs.FirstUseSeconds}, {"driver_seconds", Costs.GetDriverSeconds()}});
	}
	return Json;
}

int MeasureAll(const FBenchShadersOptions& Options, nlohmann::json& Figures)
{
	const FPluginFolders Folders = FindPluginFolders();
	if (const int Status = LoadSettings(Folders.Config, Options.Device); Status != ExitDone) { return Status; }
	std::vector<FPipelineShaders> Pipelines;
	if (FRTStatus S = ListAll(Options, Folders, Pipelines); !S) { return ReportStatus(S, "bench shaders"); }
	TRTRef<IRTDevice> Device;
	if (FRTStatus S = OpenUncachedDevice(Options.Device, Device); !S)
	{
		LogError("{}", S.Message);
		return ExitNoDevice;
	}
	const FRTCapabilities& Capabilities = Device->GetCapabilities();
	FShaderBench Bench(*Device, Folders.Shaders);
	std::vector<FMeasured> All;
	FBenchProgress Progress("shaders", double(Pipelines.size()));
	PrintShaderHeader();
	for (const FPipelineShaders& Pipeline : Pipelines)
	{
		Progress.Begin(Pipeline.Name, 1.0);
		if (Pipeline.IsRays() && !Capabilities.bRayTracingPipeline) { continue; }
		FShaderCosts Costs;
		if (FRTStatus S = Bench.Measure(Pipeline, Costs); !S) { return ReportStatus(S, Pipeline.Name.c_str()); }
		All.emplace_back(&Pipeline, Costs);
		Progress.Clear();
		PrintRow(Pipeline, Costs);
	}
	std::stable_sort(All.begin(), All.end(),
	    [](const FMeasured& A, const FMeasured& B) { return A.second.GetDriverSeconds() > B.second.GetDriverSeconds(); });
	PrintSummary(All);
	Figures = DescribeBenchDevice(Capabilities);
	Figures["pipelines"] = MakeJson(All);
	if (const uint32_t Messages = Device->GetValidationMessageCount(); Messages > 0)
	{
		LogError("validation: {} messages", Messages);
		return ExitCheckFailed;
	}
	const bool bOver = Options.MaxSeconds > 0.0 && !All.empty() && All.front().second.GetDriverSeconds() > Options.MaxSeconds;
	return bOver ? ExitCheckFailed : ExitDone;
}
} // namespace

void FBenchShadersOptions::AddTo(CLI::App& App)
{
	Device.AddTo(App);
	AddBenchQuick(App, [this] { Scenes = {"planes"}; });
	App.add_option("SCENE", Scenes, "Scenes whose shaders are measured (the built-in courtyard)");
	App.add_option("--match", Match, "Only pipelines with this in their name");
	App.add_option("--max-seconds", MaxSeconds, "Exit 1 where the driver takes longer for one pipeline (0: no limit)")
	    ->check(CLI::Range(0.0, 1e6));
	AddBenchJson(App, Json);
}

int RunBenchShaders(const FBenchShadersOptions& Options)
{
	return RunBench(Options.Json, [&](nlohmann::json& Figures) { return MeasureAll(Options, Figures); });
}

} // namespace Lantern
