// Ray-traced sun shadows: for every pixel, the fraction of the sun's disk that it sees.
#include "SunShadow/SunShadow.h"

#include "Denoise/Denoise.h"
#include "LanternCore/FrameGraph/History.h"
#include "SignalPasses.h"
#include "SunShadowTypes.h"
#include "Tiles/Contact.h"
#include "Tiles/MoreRays.h"
#include "Tiles/MovedCasters.h"
#include "Tiles/TileView.h"
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
TRTConsoleVariable<float> CVarSourceScale("r.RT.Shadow.SourceScale", 1.0f,
    "Scales the diameter of the sun's disk for shadows. Narrower penumbrae need fewer rays to look smooth. 0: shadows are hard.", {0, 16});
TRTConsoleVariable<int32_t> CVarMask(
    "r.RT.Shadow.InstanceMask", MaskSunCasters, "Only objects that share a bit with this mask cast sun shadows.", {0, 255});
const FDenoiseVariables Denoise("r.RT.Shadow", FDenoiseDefaults{.SigmaValue = 2.0f, .Passes = 2, .bExtent = true});

constexpr const char* FilterName = "SunShadow";

/// Radians; 0: hard shadows.
float GetDiameter(const FRTScene& Scene)
{
	return CVarSoft.GetOnRenderThread() ? Scene.GetSun().AngularDiameter * CVarSourceScale.GetOnRenderThread() : 0.0f;
}
bool IsSoft(const FRTScene& Scene) { return GetDiameter(Scene) > 0.0f; }
// Whatever the sun's size: the shaders stay as they are while it changes.
bool MeasuresPenumbra() { return CVarSoft.GetOnRenderThread() && Denoise.IsEnabled(); }

FShaderDefines JoinDefines(FShaderDefines Defines, const FShaderDefines& Others)
{
	Defines.insert(Defines.end(), Others.begin(), Others.end());
	return Defines;
}

FShaderSource MakeResolveSource(const FSceneFacts& Facts, const FSunRates& Rates)
{
	FShaderDefines Rest = JoinDefines(MakeContactDefines(), MakeHostShadowDefines(Facts));
	AddBackPixelsDefine(Facts.bBackPixels, Rest);
	return MakeComputeSource(MakeShaderPath(ESignal::SunShadow, ".comp"), JoinDefines(MakeSettledDefines(Rates), Rest));
}

FSunRays MakeSunRays(const FRTScene& Scene, const FRayDispatch& Dispatch)
{
	FSunRays Rays;
	Rays.Diameter = GetDiameter(Scene);
	Rays.SamplesPerPixel = 1;
	// Of the shader that runs, which may be the one before the setting changed.
	if (Rays.Diameter > 0.0f && !Dispatch.Has("ONE_SAMPLE"))
	{
		Rays.SamplesPerPixel = static_cast<uint32_t>(CVarSamples.GetOnRenderThread());
	}
	Rays.MaxDistance = CVarMaxDistance.GetOnRenderThread();
	Rays.InstanceMask = static_cast<uint32_t>(CVarMask.GetOnRenderThread());
	Rays.RayFlags = GetCasterRayFlags();
	return Rays;
}

struct FResolveInputs
{
	FGBuffer GBuffer;
	FRayQueue Queue;
	FGraphBuffer Tiles;
	FSunRays Rays;
	FSettledTiles Settled;
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
		DeclareContact(Builder, Inputs.GBuffer);
		if (Inputs.Settled.Known.Current.IsValid())
		{
			Builder.Read(Inputs.Settled.Known.Current, ERTAccess::StorageRead);
			Builder.Write(Inputs.Settled.Known.Current, ERTAccess::StorageWrite);
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
			C.SamplesPerPixel = Inputs.Rays.SamplesPerPixel;
			C.OutPenumbra = GetStorageIndex(Pass, Inputs.Penumbra);
			C.Kept = GetSampledIndex(Pass, Inputs.Kept.Previous);
			C.OutKept = GetStorageIndex(Pass, Inputs.Kept.Current);
			C.Settled = GetStorageIndex(Pass, Inputs.Settled.Known.Current);
			C.Contact = MakeContactConstants(Pass, *Frame, Inputs.GBuffer);
			C.SunOneMinusCos = GetSunOneMinusCos(Inputs.Rays);
			C.HostShadow = Inputs.Map.Push(Pass, *Frame);
			Dispatch2D(Pass, Pipeline, C, Frame->Width, Frame->Height, TILE_SIZE);
		};
	});
	return Visibility;
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
FGraphTexture AddVisibility(FFrameContext& Context, const FGBuffer& GBuffer, FGraphTexture& OutPenumbra, FShadowChanges& OutChanges)
{
	const FShadowRays* const Rays = RequireShadowRays(Context, GBuffer);
	if (!Rays || Rays->Sun.SamplesPerPixel == 0) { return {}; }
	IRTPipeline* const Resolve = RequireCompute(Context, MakeResolveSource(Context.Facts, Rays->Settled.Rates));
	if (!Resolve) { return {}; }
	OutChanges = Rays->Changes;
	FResolveInputs Inputs{GBuffer, Rays->Queue, Rays->Tiles, Rays->Sun, Rays->Settled};
	Inputs.Map = Rays->Map;
	if (MayLackSunRays(Context, Inputs.Queue) && !FindKept(Context, Inputs.Kept)) { return {}; }
	if (Inputs.Queue.SunWidths.IsValid())
	{
		OutPenumbra = Context.Graph.CreateTexture(
		    {Context.Width, Context.Height, GetMoreRays() > 0 ? ERTFormat::RG16_FLOAT : ERTFormat::R16_FLOAT}, "SunShadowPenumbra");
		Inputs.Penumbra = OutPenumbra;
	}
	AddTileView(Context, Inputs.Tiles);
	return AddResolvePass(Context, Resolve, Inputs);
}
} // namespace

FPassRays ChooseSunShadowRays(const FPassQuery& Query)
{
	FPassRays Rays;
	if (!Query.Facts.bSun || !IsRayTracingEnabled() || !CVarShadow.GetOnRenderThread()) { return Rays; }
	Rays.Path = ChooseQueuePath(Query, "sun shadows are");
	Rays.Defines.emplace_back("SUN_RAYS", "1");
	AddShadowRayDefines(Query.Facts, Rays.Defines);
	// Without a loop nothing but the pixel lives across the trace.
	if (CVarSamples.GetOnRenderThread() == 1 || !CVarSoft.GetOnRenderThread()) { Rays.Defines.emplace_back("ONE_SAMPLE", "1"); }
	if (MeasuresPenumbra()) { Rays.Defines.emplace_back("WITH_PENUMBRA", "1"); }
	Rays.bBlockers = MeasuresPenumbra();
	Rays.Shaders = ShadowQueueShaders;
	const FSunRates Rates = GetSunRates(Query.Facts, MeasuresPenumbra());
	Rays.Compute = {MakeResolveSource(Query.Facts, Rates)};
	ListTilesShaders(Query.Facts, Rates, Rays.Compute);
	if (Rates.bAdaptive) { ListSettledShaders(Rays.Compute); }
	if (MeasuresPenumbra() && GetMoreRays() > 0) { ListMoreRaysShaders(Rays.Compute); }
	ListTileViewShaders(Rays.Compute);
	if (Query.Facts.bHostShadow) { Rays.Compute.push_back(MakePyramidSource()); }
	if (MayQueuesOverflow(1)) { Rays.Compute.push_back(MakeShareSource()); }
	return Rays;
}

bool AskSunShadowRays(FFrameContext& Context, const FRayDispatch& Dispatch, FShadowRayWishes& InOut)
{
	const FSunRates Rates = GetSunRates(Context.Facts, MeasuresPenumbra());
	if (!Dispatch.Has("SUN_RAYS") || !RequireCompute(Context, MakeResolveSource(Context.Facts, Rates))) { return false; }
	InOut.Sun = MakeSunRays(Context.Scene, Dispatch);
	InOut.SunRates = Rates;
	InOut.bSunFiltered = IsSunShadowFiltered(Context.Scene);
	InOut.SunFilterName = FilterName;
	InOut.MoreSunRays = InOut.bSunFiltered ? GetMoreRays() : 0;
	InOut.bSunWidths = MeasuresPenumbra() && Dispatch.Has("WITH_PENUMBRA"); // a variant without it may still serve, and writes none
	return true;
}

bool FollowsSunShadowMotion(const FRTScene& Scene) { return IsSunShadowFiltered(Scene) || !MakeContactDefines().empty(); }

bool IsSunShadowFiltered(const FRTScene& Scene) { return Denoise.IsEnabled() && IsSoft(Scene); }

void ListSunShadowFilters(const FRTScene& Scene, const FPassQuery&, std::vector<FShaderSource>& Out)
{
	if (IsSunShadowFiltered(Scene)) { ListDenoiseShaders({.bExtent = MeasuresPenumbra()}, Denoise.Get(), Out); }
}

FGraphTexture AddSunShadowPass(FFrameContext& Context, const FGBuffer& GBuffer)
{
	if (ChooseSignalRays(Context, ESignal::SunShadow).Path == ERayPath::None) { return {}; }
	FGraphTexture Penumbra;
	FDenoiseInputs Inputs;
	const FGraphTexture Visibility = AddVisibility(Context, GBuffer, Penumbra, Inputs.Changes);
	if (!Visibility.IsValid()) { return {}; }
	if (!IsSunShadowFiltered(Context.Scene)) { return Visibility; }
	Inputs.Name = FilterName;
	Inputs.Signal = Visibility;
	Inputs.RaysPerPixel = static_cast<uint32_t>(CVarSamples.GetOnRenderThread());
	Inputs.Extent = Penumbra;
	Inputs.History = RequireShadowRays(Context, GBuffer)->SunHistory;
	return AddDenoise(Context, GBuffer, Inputs, Denoise);
}

} // namespace Lantern
