// Ray-traced sun shadows: for every pixel, the fraction of the sun's disk that it sees.
#include "SunShadow/SunShadow.h"

#include "Denoise/Denoise.h"
#include "SignalPasses.h"
#include "SunShadowTypes.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarShadow("r.RT.Shadow", true, "Traces sun shadows. If off, the sun is unshadowed unless the host shadows it.");
TRTConsoleVariable<int32_t> CVarSamples(
    "r.RT.Shadow.Samples", 1, "Number of sun shadow rays per pixel. Hard shadows need only one.", {1, 64});
TRTConsoleVariable<int32_t> CVarPath(
    "r.RT.Shadow.Path", 0, "How sun shadows are traced. 0: as the device does best. 1: ray-tracing pipeline. 2: ray query.", {0, 2});
TRTConsoleVariable<float> CVarMaxDistance("r.RT.Shadow.MaxDistance", 100000.0f, "Length of sun shadow rays, in metres.", {0.01, 1e9});
TRTConsoleVariable<bool> CVarSoft(
    "r.RT.Shadow.Soft", true, "Traces penumbrae of the sun's disk. If off, shadows are hard, from the disk's centre.");
TRTConsoleVariable<bool> CVarCullFront("r.RT.Shadow.CullFrontFaces", false,
    "Sun shadow rays ignore faces turned towards the sun, as shadow maps drawn with front-face culling do. An object casts all the "
    "same if all of its materials are double-sided.");
TRTConsoleVariable<int32_t> CVarMask(
    "r.RT.Shadow.InstanceMask", MaskSunCasters, "Only objects that share a bit with this mask cast sun shadows.", {0, 255});
const FDenoiseVariables Denoise("r.RT.Shadow", FDenoiseDefaults{.SigmaValue = 2.0f, .bExtent = true});

// A ray towards the sun sees the backs of faces that are turned towards it. gl_RayFlagsCullBackFacingTrianglesEXT
constexpr uint32_t RayFlagCullTowardsSun = 0x10;

bool IsSoft(const FRTScene& Scene) { return CVarSoft.GetOnRenderThread() && Scene.GetSun().AngularDiameter > 0.0f; }
// Whatever the sun's size: the shaders stay as they are while it changes.
bool MeasuresPenumbra() { return CVarSoft.GetOnRenderThread() && Denoise.IsEnabled(); }

FSunShadowConstants MakeConstants(const FFrameContext& Context, bool bSoft)
{
	FSunShadowConstants C{};
	C.Pass = Context.Pass;
	C.SamplesPerPixel = bSoft ? static_cast<uint32_t>(CVarSamples.GetOnRenderThread()) : 1u;
	C.MaxDistance = CVarMaxDistance.GetOnRenderThread();
	C.RayFlags = CVarCullFront.GetOnRenderThread() ? RayFlagCullTowardsSun : 0u;
	C.InstanceMask = static_cast<uint32_t>(CVarMask.GetOnRenderThread());
	C.bSoft = bSoft ? 1u : 0u;
	return C;
}

/// Penumbra: its width in pixels is written here as well; may be invalid.
FGraphTexture AddTracePass(FFrameContext& Context, const FGBuffer& GBuffer, const FRayDispatch& Dispatch, FGraphTexture Penumbra)
{
	const FGraphTexture Visibility = Context.Graph.CreateTexture(
	    {Context.Width, Context.Height, ERTFormat::R16_FLOAT, ERTTextureUsage::CopySource}, "SunShadowVisibility"); // engines copy it
	const bool bSoft = IsSoft(Context.Scene);
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass("SunShadow", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Read(GBuffer.Depth, ERTAccess::ShaderRead);
		Builder.Read(GBuffer.Normals, ERTAccess::ShaderRead);
		Builder.Write(Visibility, ERTAccess::StorageWrite);
		Builder.AllowAsync();
		if (Penumbra.IsValid()) { Builder.WriteIfRead(Penumbra, ERTAccess::StorageWrite); }
		return [=](FPassContext& Pass) {
			FSunShadowConstants Constants = MakeConstants(*Frame, bSoft);
			Constants.Depth = GetSampledIndex(Pass, GBuffer.Depth);
			Constants.Normals = GetSampledIndex(Pass, GBuffer.Normals);
			Constants.Output = GetStorageIndex(Pass, Visibility);
			Constants.OutPenumbra = GetStorageIndex(Pass, Penumbra);
			Pass.CountRays(uint64_t(Frame->Width) * Frame->Height * Constants.SamplesPerPixel);
			DispatchRays(Pass, *Frame, Dispatch, Constants);
		};
	});
	return Visibility;
}
} // namespace

FPassRays ChooseSunShadowRays(const FPassQuery& Query)
{
	FPassRays Rays;
	if (!Query.Facts.bSun || !IsRayTracingEnabled() || !CVarShadow.GetOnRenderThread()) { return Rays; }
	Rays.Path = ChooseRayPath(Query, CVarPath, "sun shadows are");
	// Without a loop nothing but the pixel lives across the trace.
	if (CVarSamples.GetOnRenderThread() == 1 || !CVarSoft.GetOnRenderThread()) { Rays.Defines.emplace_back("ONE_SAMPLE", "1"); }
	if (MeasuresPenumbra()) { Rays.Defines.emplace_back("WITH_PENUMBRA", "1"); }
	Rays.bBlockers = MeasuresPenumbra();
	return Rays;
}

bool IsSunShadowFiltered(const FRTScene& Scene) { return Denoise.IsEnabled() && IsSoft(Scene); }

void ListSunShadowFilters(const FRTScene& Scene, std::vector<FShaderSource>& Out)
{
	if (IsSunShadowFiltered(Scene)) { ListDenoiseShaders(false, MeasuresPenumbra(), Denoise.Get(), Out); }
}

FGraphTexture AddSunShadowPass(FFrameContext& Context, const FGBuffer& GBuffer)
{
	const std::optional<FRayDispatch> Dispatch =
	    RequireRayDispatch(Context, ESignal::SunShadow, ChooseSignalRays(Context, ESignal::SunShadow));
	if (!Dispatch) { return {}; }
	FGraphTexture Penumbra;
	if (MeasuresPenumbra() && Dispatch->Has("WITH_PENUMBRA")) // a variant without it may still serve, and writes none
	{
		Penumbra = Context.Graph.CreateTexture({Context.Width, Context.Height, ERTFormat::R16_FLOAT}, "SunShadowPenumbra");
	}
	const FGraphTexture Visibility = AddTracePass(Context, GBuffer, *Dispatch, Penumbra);
	if (!IsSunShadowFiltered(Context.Scene)) { return Visibility; }
	FDenoiseInputs Inputs;
	Inputs.Name = "SunShadow";
	Inputs.Signal = Visibility;
	Inputs.RaysPerPixel = static_cast<uint32_t>(CVarSamples.GetOnRenderThread());
	Inputs.Extent = Penumbra;
	return AddDenoise(Context, GBuffer, Inputs, Denoise);
}

} // namespace Lantern
