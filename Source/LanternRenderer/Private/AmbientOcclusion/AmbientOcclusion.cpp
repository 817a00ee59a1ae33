// Ambient occlusion by rays: how much of the hemisphere about a surface's normal nothing nearby hides. A ray's random length
// stands for the falloff (Shaders/AmbientOcclusion/OcclusionFalloff.glsl). So shadow rays serve, and no hit groups are added.
#include "AmbientOcclusion/AmbientOcclusion.h"

#include "AmbientOcclusionTypes.h"
#include "Denoise/Denoise.h"
#include "Lighting/DirectLighting.h"
#include "SignalPasses.h"
#include "Toon/Toon.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarEnable("r.RT.AO", true,
    "Traces ambient occlusion of the sky's ambient light. It costs nothing without a sky (r.RT.SkyAmbient), or if diffuse global "
    "illumination takes its place.");
TRTConsoleVariable<int32_t> CVarSamples("r.RT.AO.Samples", 1, "Number of ambient occlusion rays per pixel.", {1, 16});
// Docs/Performance.md, "The sky's ambient light", has the measurements behind the default.
TRTConsoleVariable<float> CVarRadius("r.RT.AO.Radius", 20.0f,
    "Distance in metres beyond which nothing occludes. What is nearer occludes by 1 - (distance / radius)^2. The default shades the "
    "sky's ambient light, which would otherwise light every interior. Contact shadows alone need 1 to 3.",
    {0.001, 1e6});
TRTConsoleVariable<int32_t> CVarPath(
    "r.RT.AO.Path", 0, "How ambient occlusion is traced. 0: as the device does best. 1: ray-tracing pipeline. 2: ray query.", {0, 2});
TRTConsoleVariable<int32_t> CVarMask(
    "r.RT.AO.InstanceMask", MaskCasters, "Only objects that share a bit with this mask occlude.", {0, 255});
const FDenoiseVariables Denoise("r.RT.AO", FDenoiseDefaults{.SigmaValue = 1.2f});

FAmbientOcclusionConstants MakeConstants(const FFrameContext& Context)
{
	FAmbientOcclusionConstants C{};
	C.Pass = Context.Pass;
	C.SamplesPerPixel = static_cast<uint32_t>(CVarSamples.GetOnRenderThread());
	C.Radius = CVarRadius.GetOnRenderThread();
	C.InstanceMask = static_cast<uint32_t>(CVarMask.GetOnRenderThread());
	return C;
}

FGraphTexture AddTracePass(FFrameContext& Context, const FGBuffer& GBuffer, const FRayDispatch& Dispatch)
{
	const FGraphTexture Output = Context.Graph.CreateTexture({Context.Width, Context.Height, ERTFormat::R16_FLOAT}, "AmbientOcclusion");
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass("AmbientOcclusion", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Read(GBuffer.Depth, ERTAccess::ShaderRead);
		Builder.Read(GBuffer.Normals, ERTAccess::ShaderRead);
		Builder.Write(Output, ERTAccess::StorageWrite);
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			FAmbientOcclusionConstants Constants = MakeConstants(*Frame);
			Constants.Depth = GetSampledIndex(Pass, GBuffer.Depth);
			Constants.Normals = GetSampledIndex(Pass, GBuffer.Normals);
			Constants.Output = GetStorageIndex(Pass, Output);
			Pass.CountRays(uint64_t(Frame->Width) * Frame->Height * Constants.SamplesPerPixel);
			DispatchRays(Pass, *Frame, Dispatch, Constants);
		};
	});
	return Output;
}
} // namespace

void SetAmbientOcclusionReference(FReferenceConstants& Constants)
{
	Constants.OcclusionRadius = CVarRadius.GetOnRenderThread();
	Constants.OcclusionMask = static_cast<uint32_t>(CVarMask.GetOnRenderThread());
}

FPassRays ChooseAmbientOcclusionRays(const FPassQuery& Query)
{
	FPassRays Rays;
	if (!IsRayTracingEnabled() || !CVarEnable.GetOnRenderThread()) { return Rays; }
	const bool bUsed = Query.Facts.Objects > 0 && HasSkyAmbient(Query.Facts) && !Query.bReplaced;
	const bool bLayer = Query.Facts.Objects > 0 && Query.Facts.bToonLayer && AreToonStylesOn();
	if (!bUsed && !bLayer && !Query.Requests.Wanted.Has(ESignal::AmbientOcclusion)) { return Rays; }
	Rays.Path = ChooseRayPath(Query, CVarPath, "ambient occlusion is");
	// Without a loop nothing but the pixel lives across the trace.
	if (CVarSamples.GetOnRenderThread() == 1) { Rays.Defines.emplace_back("ONE_SAMPLE", "1"); }
	return Rays;
}

bool IsAmbientOcclusionFiltered(const FRTScene&) { return Denoise.IsEnabled(); }

void ListAmbientOcclusionFilters(const FRTScene&, const FPassQuery&, std::vector<FShaderSource>& Out)
{
	if (Denoise.IsEnabled()) { ListDenoiseShaders({}, Denoise.Get(), Out); }
}

FGraphTexture AddAmbientOcclusionPass(FFrameContext& Context, const FGBuffer& GBuffer)
{
	const std::optional<FRayDispatch> Dispatch =
	    RequireRayDispatch(Context, ESignal::AmbientOcclusion, ChooseSignalRays(Context, ESignal::AmbientOcclusion));
	if (!Dispatch) { return {}; }
	const FGraphTexture Visibility = AddTracePass(Context, GBuffer, *Dispatch);
	if (!Denoise.IsEnabled()) { return Visibility; }
	FDenoiseInputs Inputs;
	Inputs.Name = "AmbientOcclusion";
	Inputs.Signal = Visibility;
	Inputs.RaysPerPixel = static_cast<uint32_t>(CVarSamples.GetOnRenderThread());
	return AddDenoise(Context, GBuffer, Inputs, Denoise);
}

} // namespace Lantern
