// Shadowed light of local lights, in its two lobes.
#include "LocalLights/LocalLights.h"

#include "Denoise/Denoise.h"
#include "HalfFrame/HalfFrame.h"
#include "Lighting/DirectLighting.h"
#include "Lights/LightCells.h"
#include "Lights/PixelChannels.h"
#include "LocalLightTypes.h"
#include "LocalLights/Emitters.h"
#include "LocalLights/LampChange.h"
#include "LocalLights/LampView.h"
#include "LocalLights/LightMask.h"
#include "LocalLights/LocalRequests.h"
#include "LocalLights/MoreLocalRays.h"
#include "LocalLights/SecondRays.h"
#include "Reflections/Reflections.h"
#include "SignalPasses.h"
#include "Tiles/Tiles.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarLights(
    "r.RT.Lights", true, "Traces shadows of lights other than the sun. If off, these lights shine through everything (r.RT.LocalLights).");
TRTConsoleVariable<int32_t> CVarExact("r.RT.Lights.Exact", 4,
    "Most lights of a tile of 8 x 8 pixels that all get a ray from each pixel. Each pixel of a tile with more chooses some, as many as "
    "r.RT.Lights.Rays says.",
    {1, TILE_LIGHTS});
TRTConsoleVariable<bool> CVarHalf("r.RT.Lights.HalfResolution", false,
    "Finds and filters light of local lights for one pixel of each 2 x 2. The others take it along surfaces. r.RT.Lights.Rate is then of "
    "these pixels. Does not count where an engine reads the light mask.");
TRTConsoleVariable<bool> CVarKnownChanges("r.RT.Lights.KnownChanges", true,
    "The filter looks for changes on surfaces that move, and where a moved caster may shadow a lamp. For 0.13 s after a lamp has changed, "
    "or after the camera has gone elsewhere if it is about highlights, it looks everywhere. Where nothing has changed for long enough, its "
    "history lasts twice as long. If off, or beside emissive triangles, it always looks in the picture, and takes some noise for change.");
TRTConsoleVariable<bool> CVarCasters(
    "r.RT.Debug.Lights.Casters", true, "Planted fault. If off, rays to local lights meet what casts from the sun.");
const FDenoiseVariables Denoise("r.RT.Lights", FDenoiseDefaults{.SigmaValue = 2.0f, .Passes = 2, .bColor = true});
constexpr float QuietHistory = 2.0f; // Docs/Performance.md, "Highlights at rest"

/// The light mask has room for the most lights that can have rays each.
uint32_t GetExact(const FSceneFacts& Facts)
{
	return Facts.bLightMask ? TILE_LIGHTS : static_cast<uint32_t>(CVarExact.GetOnRenderThread());
}

/// A host reads a light mask by tiles of all pixels.
bool IsHalfWanted(const FSceneFacts& Facts) { return CVarHalf.GetOnRenderThread() && !Facts.bLightMask; }

/// Whether pixels choose of lamps: where each has its ray, the filter need not be told of changes.
bool AreLampsChosen(const FSceneFacts& Facts) { return Facts.Lights > GetExact(Facts) && IsGuided(Facts, GetExact(Facts)); }

/// Beside a light mask nobody knows which lights a pixel chose of before.
bool AreChangesFollowed(const FSceneFacts& Facts) { return (AreLampsChosen(Facts) || HasEmitters(Facts)) && !Facts.bLightMask; }

bool IsMoreWanted(const FSceneFacts& Facts) { return Denoise.IsEnabled() && WantsMoreLocalRays(Facts) && HasLocalRays(Facts); }

/// The lobe whose history says which pixels have more rays. Either has one where there are two.
ESignal FindMoreLobe(const FSignalRequests& Requests)
{
	return IsMade(ESignal::LocalDiffuse, Requests) ? ESignal::LocalDiffuse : ESignal::LocalSpecular;
}

FShaderSource MakeShadeSource(const FSceneFacts& Facts, uint32_t Exact)
{
	return MakeComputeSource("LocalLights/Shade.comp", MakeChoiceDefines(Facts, Exact));
}

/// Adds the pass that shades, once a frame for either lobe.
FLobes AddShadePass(FFrameContext& Context, const FGBuffer& GBuffer, const FShadowRays& Rays, IRTPipeline* Pipeline)
{
	const auto Create = [&](const char* Name) {
		return Context.Graph.CreateTexture(
		    {Context.Width, Context.Height, ERTFormat::RGBA16_FLOAT, ERTTextureUsage::CopySource}, Name); // engines copy it
	};
	const FLobes Lobes{Create("LocalDiffuse"), Create("LocalSpecular")};
	const FFrameContext* const Frame = &Context;
	const FShadowRays Inputs = Rays;
	const FGraphTexture Channels = RequirePixelChannels(Context, GBuffer);
	const float Reflected = GetReflectedRoughness({Context.Device.GetCapabilities(), Context.Facts, Context.Signals});
	Context.Graph.AddPass("ShadowLightsShade", [&](FPassBuilder& Builder) -> FPassExecute {
		for (const FGraphTexture Texture : {GBuffer.Depth, GBuffer.Normals, GBuffer.BaseColor, GBuffer.Material})
		{
			Builder.Read(Texture, ERTAccess::ShaderRead);
		}
		for (const FGraphTexture Texture : {Channels, GBuffer.BackAlbedo})
		{
			if (Texture.IsValid()) { Builder.Read(Texture, ERTAccess::ShaderRead); }
		}
		for (const FGraphBuffer Buffer :
		    {Inputs.Queue.Answers, Inputs.Traced.TileLights, Inputs.Traced.Choices, Inputs.Traced.Lit, Inputs.Traced.MoreAnswers})
		{
			if (Buffer.IsValid()) { Builder.Read(Buffer, ERTAccess::ShaderRead); }
		}
		if (Inputs.Traced.Guide.IsValid())
		{
			Builder.Read(Inputs.Traced.Guide, ERTAccess::StorageRead);
			Builder.Write(Inputs.Traced.Guide, ERTAccess::StorageWrite);
		}
		for (const FGraphTexture Texture : {Lobes.Diffuse, Lobes.Specular}) { Builder.WriteIfRead(Texture, ERTAccess::StorageWrite); }
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			FLocalShadeConstants C{};
			C.Pass = Frame->Pass;
			C.TileLights = GetAddress(Pass, Inputs.Traced.TileLights);
			C.Choices = GetAddress(Pass, Inputs.Traced.Choices);
			C.Answers = GetAddress(Pass, Inputs.Queue.Answers);
			C.Depth = GetSampledIndex(Pass, GBuffer.Depth);
			C.Normals = GetSampledIndex(Pass, GBuffer.Normals);
			C.BaseColor = GetSampledIndex(Pass, GBuffer.BaseColor);
			C.Material = GetSampledIndex(Pass, GBuffer.Material);
			C.Channels = GetSampledIndex(Pass, Channels);
			C.BackAlbedo = GetSampledIndex(Pass, GBuffer.BackAlbedo);
			C.Lit = GetAddress(Pass, Inputs.Traced.Lit);
			C.Guide = GetAddress(Pass, Inputs.Traced.Guide) + Inputs.Traced.GuideOffset;
			C.OutDiffuse = GetStorageIndex(Pass, Lobes.Diffuse);
			C.OutSpecular = GetStorageIndex(Pass, Lobes.Specular);
			C.ReflectedRoughness = Reflected;
			C.MoreAnswers = GetAddress(Pass, Inputs.Traced.MoreAnswers);
			Dispatch2D(Pass, Pipeline, C, Frame->Width, Frame->Height, TILE_SIZE);
		};
	});
	return Lobes;
}

/// Null: there are no rays, or shaders are being compiled.
const FLobes* RequireLobes(FFrameContext& Context, const FGBuffer& GBuffer)
{
	const FShadowRays* const Rays = RequireShadowRays(Context, GBuffer);
	if (!Rays || !Rays->Traced.TileLights.IsValid()) { return nullptr; }
	if (!Context.LocalLobes)
	{
		IRTPipeline* const Pipeline = RequireCompute(Context, MakeShadeSource(Context.Facts, GetExact(Context.Facts)));
		if (!Pipeline) { return nullptr; }
		Context.LocalLobes = AddShadePass(Context, GBuffer, *Rays, Pipeline);
	}
	return &*Context.LocalLobes;
}

/// The context has the rays.
FLobes RequireChange(FFrameContext& Context, const FGBuffer& GBuffer)
{
	if (!Context.LocalChange)
	{
		const FShaderDefines Defines = MakeLocalDefines(Context.Facts, GetExact(Context.Facts));
		Context.LocalChange = AddLampChange(Context, GBuffer, AreLampsChosen(Context.Facts), Context.ShadowRays->Traced, Defines);
	}
	return *Context.LocalChange;
}

/// A lobe of the frame that has the rays.
FGraphTexture AddTracedLobe(FFrameContext& Context, const FGBuffer& GBuffer, ESignal Signal)
{
	if (!IsMade(Signal, Context.Signals)) { return {}; }
	const FLobes* const Lobes = RequireLobes(Context, GBuffer);
	if (!Lobes) { return {}; }
	AddLampView(Context, *Context.ShadowRays);
	const FGraphTexture Lobe = Signal == ESignal::LocalDiffuse ? Lobes->Diffuse : Lobes->Specular;
	if (!Denoise.IsEnabled()) { return Lobe; }
	FDenoiseInputs Inputs;
	Inputs.Name = GetSignalInfo(Signal).Pass;
	Inputs.Signal = Lobe;
	if (Signal == FindMoreLobe(Context.Signals)) { Inputs.History = Context.ShadowRays->LocalHistory; }
	const bool bLampsAlone = !HasEmitters(Context.Facts); // nobody counts what becomes of surfaces
	const bool bKnown = bLampsAlone && CVarKnownChanges.GetOnRenderThread() && !Context.Facts.bLightMask;
	if (bKnown && !FindLampChanges(Context, Signal == ESignal::LocalSpecular, Inputs.Changes)) { return {}; }
	if (AreChangesFollowed(Context.Facts))
	{
		const FLobes Change = RequireChange(Context, GBuffer);
		Inputs.Change = Signal == ESignal::LocalDiffuse ? Change.Diffuse : Change.Specular;
	}
	FDenoiseSettings Settings = Denoise.Get();
	const double Enough = double(QuietHistory * Settings.HistorySeconds); // for what a change has left to be gone
	if (Inputs.Changes.bKnown && Inputs.Changes.QuietSeconds >= Enough) { Settings.HistorySeconds *= QuietHistory; }
	return AddDenoise(Context, GBuffer, Inputs, Settings);
}

bool IsPair(const FSignalRequests& Requests) { return IsMade(ESignal::LocalDiffuse, Requests) && IsMade(ESignal::LocalSpecular, Requests); }

FLobes AddHalfLobes(FFrameContext& Context, const FGBuffer& GBuffer)
{
	FHalfFrame* const Half = RequireHalfFrame(Context, GBuffer);
	if (!Half) { return {}; }
	const uint32_t Exact = GetExact(Context.Facts);
	const bool bCells = MayChooseLights(Context.Facts, Exact) && !IsGuided(Context.Facts, Exact);
	if (bCells) { (void)RequireLightCells(Context, GBuffer); }
	FLobes Lobes;
	Lobes.Diffuse = AddTracedLobe(Half->Context, Half->GBuffer, ESignal::LocalDiffuse);
	Lobes.Specular = AddTracedLobe(Half->Context, Half->GBuffer, ESignal::LocalSpecular);
	return AddUpsample(Context, GBuffer, "ShadowLightsUpsample", Lobes);
}

FGraphTexture AddLobe(FFrameContext& Context, const FGBuffer& GBuffer, ESignal Signal)
{
	if (!IsMade(Signal, Context.Signals) || ChooseSignalRays(Context, Signal).Path == ERayPath::None) { return {}; }
	if (!AreLocalLightsHalf(Context)) { return AddTracedLobe(Context, GBuffer, Signal); }
	if (!Context.LocalLobes) { Context.LocalLobes = AddHalfLobes(Context, GBuffer); }
	return Signal == ESignal::LocalDiffuse ? Context.LocalLobes->Diffuse : Context.LocalLobes->Specular;
}
} // namespace

bool AreLocalLightsShadowed() { return CVarLights.GetOnRenderThread(); }

bool AreLocalLightsHalf(const FFrameContext& Context)
{
	std::optional<bool>& bHalf = Context.World->bLampsHalf;
	if (!bHalf) { bHalf = IsHalfWanted(Context.Facts) && AreHalfFrameShadersReady(Context, IsPair(Context.Signals)); }
	return *bHalf;
}

ERayPath ChooseLocalLightPath(const FPassQuery& Query)
{
	const bool bAny = Query.Facts.Lights > 0 || HasEmitters(Query.Facts);
	if (!bAny || !IsRayTracingEnabled() || !AreLocalLightsShadowed()) { return ERayPath::None; }
	if (!Query.Requests.bNothingElse && !HasLocalLight()) { return ERayPath::None; } // the composite shows none
	return ChooseQueuePath(Query, "shadows of local lights are");
}

FPassRays ChooseLocalLightRays(const FPassQuery& Query)
{
	FPassRays Rays;
	Rays.Path = ChooseLocalLightPath(Query);
	if (Rays.Path == ERayPath::None) { return Rays; }
	Rays.bTraces = HasLocalRays(Query.Facts);
	Rays.bLightSampling = HasEmitters(Query.Facts);
	// Rays go where pixels have asked for them. What lights bring there was asked before.
	FSceneFacts Traced = Query.Facts;
	Traced.bLightProfiles = Traced.bLightChannels = false;
	const uint32_t Exact = GetExact(Query.Facts);
	Rays.Defines = MakeLocalDefines(Traced, Exact);
	Rays.Defines.emplace_back("LOCAL_RAYS", "1");
	if (!CVarCasters.GetOnRenderThread()) { Rays.Defines.emplace_back("ONE_CASTER", "1"); }
	AddShadowRayDefines(Query.Facts, Rays.Defines);
	Rays.Shaders = ShadowQueueShaders;
	if (!Query.Facts.bMaskAlone) { Rays.Compute = {MakeShadeSource(Query.Facts, Exact)}; }
	ListLocalRequestShaders(Query.Facts, Exact, Rays.Compute);
	ListLightMaskShaders(Query.Facts, Rays.Compute);
	ListLampViewShaders(Rays.Compute);
	if (IsMoreWanted(Query.Facts)) { ListMoreLocalRaysShaders(MakeLocalDefines(Query.Facts, Exact), Rays.Compute); }
	if (IsHalfWanted(Query.Facts)) { ListHalfFrameShaders(Query.Facts, IsPair(Query.Requests), Rays.Compute); }
	if (Denoise.IsEnabled() && AreChangesFollowed(Query.Facts))
	{
		ListLampChangeShaders(AreLampsChosen(Query.Facts), Query.Facts, MakeLocalDefines(Query.Facts, Exact), Rays.Compute);
	}
	return Rays;
}

bool AskLocalRays(FFrameContext& Context, const FRayDispatch& Dispatch, FShadowRayWishes& InOut)
{
	const uint32_t Exact = GetExact(Context.Facts);
	const bool bMany = MayChooseLights(Context.Facts, Exact);
	// A variant from before a change may lack what the lights of now need.
	if (!Dispatch.Has("LOCAL_RAYS") || (bMany && !Dispatch.Has("MANY_LIGHTS"))) { return false; }
	if (FindRate(Dispatch.Defines) != GetLightRate()) { return false; }
	if (Context.Facts.bAreaLights && !Dispatch.Has("HAS_AREA_LIGHTS")) { return false; }
	if (HasEmitters(Context.Facts) && !Dispatch.Has("LOCAL_EMISSIVE")) { return false; }
	if (!AreLocalRequestsReady(Context, Exact) || !IsLightMaskReady(Context)) { return false; }
	if (!Context.Facts.bMaskAlone && !RequireCompute(Context, MakeShadeSource(Context.Facts, Exact))) { return false; }
	InOut.Local = FLocalRays{Exact, GetLocalRaysPerPixel(Context.Facts, Exact), bMany, {}};
	if (IsMoreWanted(Context.Facts))
	{
		const float MinAlpha = GetMinAlpha(Denoise.Get().HistorySeconds, Context.View.DeltaSeconds);
		InOut.Local->More = FMoreRaysFilter{GetSignalInfo(FindMoreLobe(Context.Signals)).Pass, MinAlpha};
	}
	return true;
}

float GetLocalHistorySeconds() { return Denoise.IsEnabled() ? Denoise.Get().HistorySeconds : 0.0f; }

bool AreLocalLightsFiltered(const FRTScene&) { return Denoise.IsEnabled(); }

void SetLocalSpecularReference(FReferenceConstants& Constants) { Constants.ReflectedRoughness = GetReflectedRoughnessInReference(); }

void ListLocalLightFilters(const FRTScene&, const FPassQuery&, std::vector<FShaderSource>& Out)
{
	if (Denoise.IsEnabled()) { ListDenoiseShaders({.bColor = true}, Denoise.Get(), Out); }
}

FGraphTexture AddLocalDiffusePass(FFrameContext& Context, const FGBuffer& GBuffer)
{
	return AddLobe(Context, GBuffer, ESignal::LocalDiffuse);
}

FGraphTexture AddLocalSpecularPass(FFrameContext& Context, const FGBuffer& GBuffer)
{
	return AddLobe(Context, GBuffer, ESignal::LocalSpecular);
}

} // namespace Lantern
