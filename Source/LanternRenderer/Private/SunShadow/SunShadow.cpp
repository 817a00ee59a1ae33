// Ray-traced sun shadows: for every pixel, the fraction of the sun's disk that it sees.
#include "SunShadow/SunShadow.h"

#include "Denoise/Denoise.h"
#include "LanternCore/FrameGraph/History.h"
#include "SignalPasses.h"
#include "SunShadowTypes.h"
#include "Tiles/Tiles.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarShadow("r.RT.Shadow", true, "Traces sun shadows. If off, the sun is unshadowed unless the host shadows it.");
TRTConsoleVariable<int32_t> CVarSamples(
    "r.RT.Shadow.Samples", 1, "Number of sun shadow rays per pixel. Hard shadows need only one.", {1, 64});
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

FShaderSource MakeResolveSource(const FSceneFacts& Facts)
{
	return MakeComputeSource(MakeShaderPath(ESignal::SunShadow, ".comp"), MakeHostShadowDefines(Facts));
}

FSunRays MakeSunRays(const FRTScene& Scene, const FRayDispatch& Dispatch)
{
	FSunRays Rays;
	Rays.bSoft = IsSoft(Scene);
	Rays.SamplesPerPixel = 1;
	// Of the shader that runs, which may be the one before the setting changed.
	if (Rays.bSoft && !Dispatch.Has("ONE_SAMPLE")) { Rays.SamplesPerPixel = static_cast<uint32_t>(CVarSamples.GetOnRenderThread()); }
	Rays.MaxDistance = CVarMaxDistance.GetOnRenderThread();
	Rays.RayFlags = CVarCullFront.GetOnRenderThread() ? RayFlagCullTowardsSun : 0u;
	Rays.InstanceMask = static_cast<uint32_t>(CVarMask.GetOnRenderThread());
	return Rays;
}

struct FResolveInputs
{
	FGBuffer GBuffer;
	FRayQueue Queue;
	FGraphBuffer Tiles;
	uint32_t SamplesPerPixel = 1;
	FGraphTexture Penumbra; ///< the penumbra's width in pixels is written here as well; may be invalid
	FHostShadowMap Map;     ///< it shadows where rays do not take its place
	FHistoryTexture Kept;   ///< visibility, for pixels whose rays have no room; Current is invalid if all have
};

/// Makes visibility of the answers.
FGraphTexture AddResolvePass(FFrameContext& Context, IRTPipeline* Pipeline, const FResolveInputs& Inputs)
{
	const FGraphTexture Visibility = Context.Graph.CreateTexture(
	    {Context.Width, Context.Height, ERTFormat::R16_FLOAT, ERTTextureUsage::CopySource}, "SunShadowVisibility"); // engines copy it
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass("SunShadow", [&](FPassBuilder& Builder) -> FPassExecute {
		const FRayQueue& Queue = Inputs.Queue;
		Builder.Read(Inputs.GBuffer.Depth, ERTAccess::ShaderRead);
		Builder.Read(Inputs.GBuffer.Normals, ERTAccess::ShaderRead);
		for (const FGraphBuffer Buffer : {Inputs.Tiles, Queue.Answers}) { Builder.Read(Buffer, ERTAccess::ShaderRead); }
		if (Queue.SunWidths.IsValid()) { Builder.Read(Queue.SunWidths, ERTAccess::ShaderRead); }
		Inputs.Map.Read(Builder);
		Builder.Write(Visibility, ERTAccess::StorageWrite);
		if (Inputs.Kept.Previous.IsValid()) { Builder.Read(Inputs.Kept.Previous, ERTAccess::ShaderRead); }
		if (Inputs.Kept.Current.IsValid())
		{
			Builder.Write(Inputs.Kept.Current, ERTAccess::StorageWrite);
			Builder.Keep(Inputs.Kept.Current);
		}
		if (Inputs.Penumbra.IsValid()) { Builder.WriteIfRead(Inputs.Penumbra, ERTAccess::StorageWrite); }
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			FSunShadowConstants C{};
			C.Pass = Frame->Pass;
			C.Tiles = Pass.GetBuffer(Inputs.Tiles)->GetDeviceAddress();
			C.Answers = Pass.GetBuffer(Inputs.Queue.Answers)->GetDeviceAddress();
			C.Widths = Inputs.Queue.SunWidths.IsValid() ? Pass.GetBuffer(Inputs.Queue.SunWidths)->GetDeviceAddress() : 0;
			C.Depth = GetSampledIndex(Pass, Inputs.GBuffer.Depth);
			C.Normals = GetSampledIndex(Pass, Inputs.GBuffer.Normals);
			C.Output = GetStorageIndex(Pass, Visibility);
			C.SamplesPerPixel = Inputs.SamplesPerPixel;
			C.OutPenumbra = GetStorageIndex(Pass, Inputs.Penumbra);
			C.Kept = GetSampledIndex(Pass, Inputs.Kept.Previous);
			C.OutKept = GetStorageIndex(Pass, Inputs.Kept.Current);
			C.HostShadow = Inputs.Map.Push(Pass, *Frame);
			Dispatch2D(Pass, Pipeline, C, Frame->Width, Frame->Height, TILE_SIZE);
		};
	});
	return Visibility;
}

/// Sun rays come first in the queue.
bool MayLackSunRays(const FFrameContext& Context, const FRayQueue& Queue)
{
	return Queue.bMayOverflow && Queue.Capacity < uint64_t(Context.Width) * Context.Height;
}

/// Finds the visibility of the frame before for a queue that may overflow. False: an error, which the context has.
bool FindKept(FFrameContext& Context, FHistoryTexture& Out)
{
	const FRTStatus Status = Context.History->GetTexture("SunShadowKept", {Context.Width, Context.Height, ERTFormat::R16_FLOAT}, Out);
	if (!Status)
	{
		Context.Fail(Status);
		return false;
	}
	if (!Out.Previous.IsValid()) { return true; }
	const FGraphTextureDesc& Before = Context.Graph.GetDesc(Out.Previous);
	if (Before.Width != Context.Width || Before.Height != Context.Height) { Out.Previous = {}; }
	return true;
}

/// Invalid: there are no rays, or shaders are being compiled.
FGraphTexture AddVisibility(FFrameContext& Context, const FGBuffer& GBuffer, FGraphTexture& OutPenumbra)
{
	const FShadowRays* const Rays = RequireShadowRays(Context, GBuffer);
	if (!Rays || Rays->Sun.SamplesPerPixel == 0) { return {}; }
	IRTPipeline* const Resolve = RequireCompute(Context, MakeResolveSource(Context.Facts));
	if (!Resolve) { return {}; }
	FResolveInputs Inputs{GBuffer, Rays->Queue, Rays->Tiles, Rays->Sun.SamplesPerPixel};
	Inputs.Map = Rays->Map;
	if (MayLackSunRays(Context, Inputs.Queue) && !FindKept(Context, Inputs.Kept)) { return {}; }
	if (Inputs.Queue.SunWidths.IsValid())
	{
		OutPenumbra = Context.Graph.CreateTexture({Context.Width, Context.Height, ERTFormat::R16_FLOAT}, "SunShadowPenumbra");
		Inputs.Penumbra = OutPenumbra;
	}
	return AddResolvePass(Context, Resolve, Inputs);
}
} // namespace

FPassRays ChooseSunShadowRays(const FPassQuery& Query)
{
	FPassRays Rays;
	if (!Query.Facts.bSun || !IsRayTracingEnabled() || !CVarShadow.GetOnRenderThread()) { return Rays; }
	Rays.Path = ChooseQueuePath(Query, "sun shadows are");
	Rays.Defines.emplace_back("SUN_RAYS", "1");
	AddReceiverDefines(Query.Facts, Rays.Defines);
	// Without a loop nothing but the pixel lives across the trace.
	if (CVarSamples.GetOnRenderThread() == 1 || !CVarSoft.GetOnRenderThread()) { Rays.Defines.emplace_back("ONE_SAMPLE", "1"); }
	if (MeasuresPenumbra()) { Rays.Defines.emplace_back("WITH_PENUMBRA", "1"); }
	Rays.bBlockers = MeasuresPenumbra();
	Rays.Shaders = ShadowQueueShaders;
	Rays.Compute = {MakeTilesSource(Query.Facts), MakeResolveSource(Query.Facts)};
	if (Query.Facts.bHostShadow) { Rays.Compute.push_back(MakePyramidSource()); }
	if (MayQueuesOverflow(1)) { Rays.Compute.push_back(MakeShareSource()); }
	return Rays;
}

bool AskSunShadowRays(FFrameContext& Context, const FRayDispatch& Dispatch, FShadowRayWishes& InOut)
{
	if (!Dispatch.Has("SUN_RAYS") || !RequireCompute(Context, MakeResolveSource(Context.Facts))) { return false; }
	InOut.Sun = MakeSunRays(Context.Scene, Dispatch);
	InOut.bSunWidths = MeasuresPenumbra() && Dispatch.Has("WITH_PENUMBRA"); // a variant without it may still serve, and writes none
	return true;
}

bool IsSunShadowFiltered(const FRTScene& Scene) { return Denoise.IsEnabled() && IsSoft(Scene); }

void ListSunShadowFilters(const FRTScene& Scene, std::vector<FShaderSource>& Out)
{
	if (IsSunShadowFiltered(Scene)) { ListDenoiseShaders(false, MeasuresPenumbra(), Denoise.Get(), Out); }
}

FGraphTexture AddSunShadowPass(FFrameContext& Context, const FGBuffer& GBuffer)
{
	if (ChooseSignalRays(Context, ESignal::SunShadow).Path == ERayPath::None) { return {}; }
	FGraphTexture Penumbra;
	const FGraphTexture Visibility = AddVisibility(Context, GBuffer, Penumbra);
	if (!Visibility.IsValid()) { return {}; }
	if (!IsSunShadowFiltered(Context.Scene)) { return Visibility; }
	FDenoiseInputs Inputs;
	Inputs.Name = "SunShadow";
	Inputs.Signal = Visibility;
	Inputs.RaysPerPixel = static_cast<uint32_t>(CVarSamples.GetOnRenderThread());
	Inputs.Extent = Penumbra;
	return AddDenoise(Context, GBuffer, Inputs, Denoise);
}

} // namespace Lantern
