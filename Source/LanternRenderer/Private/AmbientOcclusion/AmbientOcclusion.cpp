// Ambient occlusion by rays: how much of the sky about a surface's normal nothing nearby hides. A ray's random length stands
// for the falloff (Shaders/Library/AmbientOcclusion.glsl), so that shadow rays serve: no closest-hit shader, no hit groups
// of its own, and both paths cast the same rays.
#include "AmbientOcclusion/AmbientOcclusion.h"

#include "AmbientOcclusionTypes.h"
#include "Denoise/Denoise.h"
#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternCore/Text/Log.h"
#include "LanternRenderer/AnyHitCounter.h"
#include "LanternRenderer/Frame.h"
#include "Lighting/DirectLighting.h"
#include "PassTools.h"
#include "RayPrograms.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarEnable("r.RT.AO", true,
    "Ray-traced ambient occlusion of the sky's ambient light. Costs nothing without a sky (r.RT.SkyAmbient), "
    "and where diffuse global illumination takes its place.");
TRTConsoleVariable<int32_t> CVarSamples("r.RT.AO.Samples", 1, "Ambient occlusion rays per pixel.", {1, 16});
TRTConsoleVariable<float> CVarRadius("r.RT.AO.Radius", 2.0f,
    "What is farther away than so many metres does not occlude; what is nearer does by 1 - (distance / radius)^2.", {0.001, 1e6});
TRTConsoleVariable<int32_t> CVarPath("r.RT.AO.Path", 0, "0: what the device does best. 1: ray-tracing pipeline. 2: ray query.", {0, 2});
TRTConsoleVariable<int32_t> CVarMask(
    "r.RT.AO.InstanceMask", MaskCastsShadow, "Only objects that share a bit with this mask occlude.", {0, 255});
TRTConsoleVariable<bool> CVarDenoise("r.RT.AO.Denoise", true, "Ambient occlusion is accumulated over frames and smoothed along surfaces.");
TRTConsoleVariable<float> CVarHistory(
    "r.RT.AO.HistorySeconds", 0.5f, "Time constant of what r.RT.AO.Denoise accumulates. 0: nothing is.", {0.0, 60.0});
TRTConsoleVariable<int32_t> CVarPasses(
    "r.RT.AO.FilterPasses", 4, "Passes of the filter of r.RT.AO.Denoise; n of them reach 2^n - 1 pixels.", {0, 5});
TRTConsoleVariable<float> CVarSigma(
    "r.RT.AO.FilterSigma", 1.2f, "Which differences the filter takes for noise, in standard deviations.", {0.0, 100.0});
TRTConsoleVariable<float> CVarClamp("r.RT.AO.ClampSigma", 7.0f,
    "Accumulated occlusion stays within what the neighbourhood says now, give or take this many standard deviations. 0: any.",
    {0.0, 100.0});
TRTConsoleVariable<float> CVarChange("r.RT.AO.ChangeSigma", 2.0f,
    "Accumulation starts anew where occlusion has changed by more than this many standard errors. 0: never.", {0.0, 100.0});
TRTConsoleVariable<float> CVarResampling("r.RT.AO.Resampling", 0.5f,
    "How much of the difference between neighbours counts as error where accumulated occlusion is resampled between them.", {0.0, 100.0});

/// Whether the frame does anything with it.
bool IsWanted(const FSceneFacts& Facts, const FSignalRequests& Requests, bool bDiffuseGI)
{
	if (!IsRayTracingEnabled() || !CVarEnable.GetOnRenderThread()) { return false; }
	if (Requests.bAmbientOcclusion) { return true; }
	return Facts.Objects > 0 && HasSkyAmbient(Facts) && !bDiffuseGI;
}

std::vector<std::pair<std::string, std::string>> MakeDefines()
{
	return CVarSamples.GetOnRenderThread() == 1 ? std::vector<std::pair<std::string, std::string>>{{"ONE_SAMPLE", "1"}}
	                                            : std::vector<std::pair<std::string, std::string>>{};
}

IRTPipeline* RequireQueryPipeline(const FFrameContext& Context)
{
	std::vector<std::pair<std::string, std::string>> Defines = MakeDefines();
	if (Context.Facts.bMasked)
	{
		Defines.emplace_back("HAS_MASKED", "1");
		for (auto& Define : FAnyHitCounter::GetDefines()) { Defines.push_back(std::move(Define)); }
	}
	return RequireCompute(Context, "AmbientOcclusion/AmbientOcclusion.comp", std::move(Defines));
}

FAmbientOcclusionConstants MakeConstants(const FFrameContext& Context)
{
	FAmbientOcclusionConstants C{};
	C.Pass = Context.Pass;
	C.SamplesPerPixel = static_cast<uint32_t>(CVarSamples.GetOnRenderThread());
	C.Radius = GetAmbientOcclusionSettings().Radius;
	C.InstanceMask = GetAmbientOcclusionSettings().InstanceMask;
	return C;
}

/// Compute: null for the pipeline's path.
FGraphTexture AddTracePass(FFrameContext& Context, const FGBuffer& GBuffer, IRTPipeline* Compute)
{
	const FGraphTexture Output = Context.Graph.CreateTexture({Context.Width, Context.Height, ERTFormat::R16_FLOAT}, "AmbientOcclusion");
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass("AmbientOcclusion", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Read(GBuffer.Depth, ERTAccess::ShaderRead);
		Builder.Read(GBuffer.Normals, ERTAccess::ShaderRead);
		Builder.Write(Output, ERTAccess::StorageWrite);
		return [=](FPassContext& Pass) {
			FAmbientOcclusionConstants Constants = MakeConstants(*Frame);
			Constants.Depth = Pass.GetTexture(GBuffer.Depth)->GetSampledIndex();
			Constants.Normals = Pass.GetTexture(GBuffer.Normals)->GetSampledIndex();
			Constants.Output = Pass.GetTexture(Output)->GetStorageIndex();
			Pass.CountRays(uint64_t(Frame->Width) * Frame->Height * Constants.SamplesPerPixel);
			if (Compute)
			{
				Dispatch2D(Pass, Compute, Constants, Frame->Width, Frame->Height, AMBIENT_OCCLUSION_GROUP_SIZE);
				return;
			}
			Pass.Commands().SetPipeline(Frame->RayPipeline->GetPipeline());
			Pass.Commands().PushConstants(&Constants, sizeof(Constants));
			Pass.Commands().TraceRays(
			    Frame->RayBindings->GetTable(), Frame->GetRayGen(EFrameRayGen::AmbientOcclusion), Frame->Width, Frame->Height, 1);
		};
	});
	return Output;
}
} // namespace

FAmbientOcclusionSettings GetAmbientOcclusionSettings()
{
	return {CVarRadius.GetOnRenderThread(), static_cast<uint32_t>(CVarMask.GetOnRenderThread())};
}

ERayPath ChooseAmbientOcclusionPath(
    const FRTCapabilities& Capabilities, const FSceneFacts& Facts, const FSignalRequests& Requests, bool bDiffuseGI)
{
	if (!IsWanted(Facts, Requests, bDiffuseGI)) { return ERayPath::None; }
	const int32_t Wanted = CVarPath.GetOnRenderThread();
	if (Wanted == 1 && Capabilities.bRayTracingPipeline) { return ERayPath::Pipeline; }
	if (Wanted == 2 && Capabilities.bRayQuery) { return ERayPath::Query; }
	if (Wanted == 1) { LogOnce(ERTLogLevel::Warning, "r.RT.AO.Path=1: this device has no ray-tracing pipelines; ray queries are used"); }
	if (Wanted == 2) { LogOnce(ERTLogLevel::Warning, "r.RT.AO.Path=2: this device has no ray queries; the ray-tracing pipeline is used"); }
	// Inline rays know the standard program alone.
	if (Facts.bOwnShapes && Capabilities.bRayTracingPipeline) { return ERayPath::Pipeline; }
	if (Capabilities.bRayQuery) { return ERayPath::Query; }
	if (Capabilities.bRayTracingPipeline) { return ERayPath::Pipeline; }
	LogOnce(ERTLogLevel::Warning, "ambient occlusion is off: this device has neither ray queries nor ray-tracing pipelines");
	return ERayPath::None;
}

std::optional<FPassRays> ChooseAmbientOcclusionRays(
    const FRTCapabilities& Capabilities, const FSceneFacts& Facts, const FSignalRequests& Requests, bool bDiffuseGI)
{
	if (ChooseAmbientOcclusionPath(Capabilities, Facts, Requests, bDiffuseGI) != ERayPath::Pipeline) { return std::nullopt; }
	return MakePassRays("AmbientOcclusion/AmbientOcclusion.rgen", MakeDefines(), false);
}

namespace
{
ERayPath ChoosePath(const FFrameContext& Context)
{
	const bool bDiffuseGI = Context.GetRayGen(EFrameRayGen::DiffuseGI) != NoRayGen;
	return ChooseAmbientOcclusionPath(Context.Device.GetCapabilities(), Context.Facts, Context.Signals, bDiffuseGI);
}
} // namespace

bool IsAmbientOcclusionFiltered(const FFrameContext& Context)
{
	return CVarDenoise.GetOnRenderThread() && ChoosePath(Context) != ERayPath::None;
}

FAmbientOcclusionOutputs AddAmbientOcclusionPass(FFrameContext& Context, const FGBuffer& GBuffer)
{
	const ERayPath Path = ChoosePath(Context);
	if (Path == ERayPath::None) { return {}; }
	if (Path == ERayPath::Pipeline && Context.GetRayGen(EFrameRayGen::AmbientOcclusion) == NoRayGen) { return {}; } // still being compiled
	IRTPipeline* const Compute = Path == ERayPath::Query ? RequireQueryPipeline(Context) : nullptr;
	if (Path == ERayPath::Query && !Compute) { return {}; }
	Context.RequireRays();
	FAmbientOcclusionOutputs Out;
	Out.Visibility = AddTracePass(Context, GBuffer, Compute);
	if (IsAmbientOcclusionFiltered(Context))
	{
		FDenoiseInputs Denoise;
		Denoise.Name = "AmbientOcclusion";
		Denoise.Signal = Out.Visibility;
		Denoise.Depth = GBuffer.Depth;
		Denoise.Normals = GBuffer.Normals;
		Denoise.Motion = GBuffer.Motion;
		Denoise.RaysPerPixel = static_cast<uint32_t>(CVarSamples.GetOnRenderThread());
		Denoise.Settings.HistorySeconds = CVarHistory.GetOnRenderThread();
		Denoise.Settings.ClampSigma = CVarClamp.GetOnRenderThread();
		Denoise.Settings.ChangeSigma = CVarChange.GetOnRenderThread();
		Denoise.Settings.Resampling = CVarResampling.GetOnRenderThread();
		Denoise.Settings.Passes = static_cast<uint32_t>(CVarPasses.GetOnRenderThread());
		Denoise.Settings.SigmaValue = CVarSigma.GetOnRenderThread();
		Out.Visibility = AddDenoisePasses(Context, Denoise);
	}
	return Out;
}

} // namespace Lantern
