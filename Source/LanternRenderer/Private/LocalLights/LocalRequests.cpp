// Lights of tiles and requests for rays to them.
#include "LocalLights/LocalRequests.h"

#include <algorithm>
#include <cmath>

#include "Lights/LightCells.h"
#include "Lights/PixelChannels.h"
#include "LocalLightTypes.h"
#include "LocalLights/Emitters.h"
#include "LocalLights/LightMask.h"
#include "LocalLights/LightRegions.h"
#include "LocalLights/MoreLocalRays.h"
#include "LocalLights/SecondRays.h"
#include "Rays/ThreadList.h"
#include "TwoFrames.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<int32_t> CVarCandidates("r.RT.Lights.Candidates", 8,
    "Lights that a pixel looks at where a tile has many, before one of them gets its ray. They are drawn from the lights of its tile, by "
    "what these bring and by how visible they were. 0: all lights, which takes long. It is 64 where surfaces emit.",
    {0, 64});
TRTConsoleVariable<int32_t> CVarRays("r.RT.Lights.Rays", 2,
    "Rays of a pixel whose tile has many lights, each to a light that it chooses of its candidates. Twice as many have half the noise, as "
    "far as hidden lights are its cause. Without candidates, and for emissive triangles beside few lights, it is 1.",
    {1, TILE_CHOSEN_MOST});
TRTConsoleVariable<float> CVarGuideSeconds("r.RT.Lights.GuideSeconds", 0.5f,
    "Time in seconds for which a tile of many lights remembers which of them were visible. 0: it forgets all.", {0.0, 60.0});
TRTConsoleVariable<bool> CVarUnbiased("r.RT.Lights.Unbiased", false,
    "A pixel of many lights takes the colour of the one that it chose. Off: it takes the mean colour of its candidates, which has less "
    "noise "
    "but does not know which of them are hidden. Its luminance has no bias either way.");
TRTConsoleVariable<bool> CVarCellTarget("r.RT.Debug.Lights.CellTarget", true,
    "Planted fault. If off, a tile weighs its lights at one of its pixels alone, so that some that reach others are never chosen.");
TRTConsoleVariable<bool> CVarWeight("r.RT.Debug.Lights.Weight", true,
    "Planted fault. If off, a light that a pixel chose of many counts once, and not for all that it was chosen from.");

uint32_t GetCandidates()
{
	constexpr uint32_t Most = 64;
	const auto Candidates = static_cast<uint32_t>(CVarCandidates.GetOnRenderThread());
	return Candidates > 0 ? Candidates : Most;
}

/// Lights that a pixel of a tile of many chooses.
uint32_t GetChosen(const FSceneFacts& Facts, uint32_t Exact)
{
	if (Facts.bLightMask) { return 1; } // slots have the bits of further answers
	return Facts.Lights > Exact && IsGuided(Facts, Exact) ? static_cast<uint32_t>(CVarRays.GetOnRenderThread()) : 1;
}

bool HasRegions(const FSceneFacts& Facts, uint32_t Exact) { return IsGuided(Facts, Exact) && NeedsLightRegions(Facts); }

/// Whether tiles whose pixels choose are listed, and do so in a pass of their own. Slots of a light mask depend on what is chosen.
bool ListsChoosers(const FSceneFacts& Facts, uint32_t Exact) { return IsGuided(Facts, Exact) && !Facts.bLightMask; }

FShaderDefines MakeRequestsDefines(const FSceneFacts& Facts, uint32_t Exact)
{
	FShaderDefines Defines = MakeChoiceDefines(Facts, Exact);
	if (Facts.bMaskAlone) { Defines.emplace_back("MASK_ALONE", "1"); }
	if (Facts.bLightMask) { AddMaskOrderDefine(Defines); }
	if (!CVarCellTarget.GetOnRenderThread()) { Defines.emplace_back("ONE_SAMPLER", "1"); }
	if (!CVarWeight.GetOnRenderThread()) { Defines.emplace_back("NO_CHOICE_WEIGHT", "1"); }
	return Defines;
}

FShaderSource MakeRequestsSource(const FSceneFacts& Facts, uint32_t Exact)
{
	FShaderDefines Defines = MakeRequestsDefines(Facts, Exact);
	if (ListsChoosers(Facts, Exact)) { Defines.emplace_back("LISTS_CHOOSERS", "1"); }
	return MakeComputeSource("LocalLights/Requests.comp", std::move(Defines));
}

FShaderSource MakeChooseSource(const FSceneFacts& Facts, uint32_t Exact)
{
	return MakeComputeSource("LocalLights/Choose.comp", MakeRequestsDefines(Facts, Exact));
}

FShaderSource MakeShareSource()
{
	FShaderDefines Defines;
	AddRateDefine(GetLightRate(), Defines);
	return MakeComputeSource("LocalLights/ShareRequests.comp", std::move(Defines));
}

struct FRequestsPass
{
	FGBuffer GBuffer;
	FRayQueue Queue;
	FLocalRays Rays;
	bool bFirst = false; ///< no pass before it writes requests and answers
	FGraphBuffer TileLights, Choices, Lit, Regions;
	FGraphTexture Channels;   ///< of RequirePixelChannels
	FGraphBuffer Emitters;    ///< of AddEmitterClusters
	FGraphBuffer Guide;       ///< two times FTileGuide[Tiles], of this frame and of the one before
	uint64_t GuideOffset = 0; ///< of this frame's, bytes
	bool bPreviousGuide = false;
	FGraphTexture PreviousLights; ///< FQueuedRays::MaskLights, of the previous frame
	uint32_t Tiles = 0;
	FThreadMarks Choosers; ///< tiles whose pixels choose in a pass of their own; invalid: they do so at once
	bool IsGuided() const { return Guide.IsValid(); }
};

/// Adds the buffers by which pixels choose of a table. False: there is no memory, which the context has.
bool AddGuide(FFrameContext& Context, uint64_t Choices, FRequestsPass& InOut)
{
	const uint64_t Bytes = uint64_t(InOut.Tiles) * sizeof(FTileGuide);
	if (CVarGuideSeconds.GetOnRenderThread() > 0.0f)
	{
		FTwoFrames Guide;
		if (!RequireTwoFrames(Context, "LightGuide", Bytes, Guide)) { return false; }
		InOut.Guide = Guide.Buffer;
		InOut.GuideOffset = Guide.Offset;
		InOut.bPreviousGuide = Guide.bPrevious;
	}
	else { InOut.Guide = Context.Graph.CreateBuffer({2 * Bytes}, "LightGuide"); } // nobody reads it in the next frame
	if (Choices > 0 && !CVarUnbiased.GetOnRenderThread())
	{
		InOut.Lit = Context.Graph.CreateBuffer({Choices * sizeof(FLitPixel)}, "LitPixels");
	}
	return true;
}

/// Fills what GUIDED shaders read beside the rest.
void SetGuide(FPassContext& Pass, const FFrameContext& Frame, const FRequestsPass& Inputs, FLocalRequestsConstants& C)
{
	C.BaseColor = GetSampledIndex(Pass, Inputs.GBuffer.BaseColor);
	C.Material = GetSampledIndex(Pass, Inputs.GBuffer.Material);
	C.BackAlbedo = GetSampledIndex(Pass, Inputs.GBuffer.BackAlbedo);
	C.Guide = GetAddress(Pass, Inputs.Guide) + Inputs.GuideOffset;
	const uint32_t Previous = Inputs.GuideOffset > 0 ? PREVIOUS_GUIDE_BEFORE : PREVIOUS_GUIDE_BEHIND;
	C.Limits |= ((Inputs.bPreviousGuide ? Previous : PREVIOUS_GUIDE_NONE) << 8) | (GetCandidates() << 16);
	C.Regions = GetAddress(Pass, Inputs.Regions);
	C.Emitters = GetAddress(Pass, Inputs.Emitters);
	C.GuideKept = std::exp(-Frame.View.DeltaSeconds / std::max(CVarGuideSeconds.GetOnRenderThread(), 1e-6f));
}

/// Declares what GUIDED shaders read and write. bChoose: pixels choose there.
void DeclareGuide(FPassBuilder& Builder, const FRequestsPass& Inputs, bool bChoose)
{
	// A light mask alone needs none.
	for (const FGraphTexture Texture : {Inputs.GBuffer.BaseColor, Inputs.GBuffer.Material, Inputs.GBuffer.BackAlbedo})
	{
		if (Texture.IsValid()) { Builder.Read(Texture, ERTAccess::ShaderRead); }
	}
	if (Inputs.bPreviousGuide) { Builder.Read(Inputs.Guide, ERTAccess::StorageRead); }
	if (Inputs.Regions.IsValid()) { Builder.Read(Inputs.Regions, ERTAccess::ShaderRead); }
	Builder.Write(Inputs.Guide, ERTAccess::StorageWrite);
	if (Inputs.Lit.IsValid() && bChoose) { Builder.Write(Inputs.Lit, ERTAccess::StorageWrite); }
	if (Inputs.Emitters.IsValid()) { Builder.Read(Inputs.Emitters, ERTAccess::ShaderRead); }
}

FLocalRequestsConstants MakeConstants(FPassContext& Pass, const FFrameContext& Frame, const FRequestsPass& Inputs)
{
	FLocalRequestsConstants C{};
	C.Pass = Frame.Pass;
	C.TileLights = GetAddress(Pass, Inputs.TileLights);
	C.Requests = GetAddress(Pass, Inputs.Queue.Requests);
	C.Counters = GetAddress(Pass, Inputs.Queue.Counters);
	C.Capacity = Inputs.Queue.Capacity;
	C.Limits = Inputs.Rays.Exact;
	return C;
}

void DeclareQueue(FPassBuilder& Builder, const FRayQueue& Queue, bool bFirst)
{
	for (const FGraphBuffer Buffer : {Queue.Requests, Queue.Counters})
	{
		if (!bFirst) { Builder.Read(Buffer, ERTAccess::StorageRead); }
		Builder.Write(Buffer, ERTAccess::StorageWrite);
	}
}

void DeclareSurfaces(FPassBuilder& Builder, const FRequestsPass& Inputs)
{
	for (const FGraphTexture Texture : {Inputs.GBuffer.Depth, Inputs.GBuffer.Normals, Inputs.Channels})
	{
		if (Texture.IsValid()) { Builder.Read(Texture, ERTAccess::ShaderRead); }
	}
}

void SetSurfaces(FPassContext& Pass, const FRequestsPass& Inputs, FLocalRequestsConstants& C)
{
	C.Depth = GetSampledIndex(Pass, Inputs.GBuffer.Depth);
	C.Normals = GetSampledIndex(Pass, Inputs.GBuffer.Normals);
	C.Channels = GetSampledIndex(Pass, Inputs.Channels);
}

void AddRequestsPass(FFrameContext& Context, IRTPipeline* Pipeline, const FRequestsPass& Inputs)
{
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass((Inputs.Queue.Name + "Lights").c_str(), [&](FPassBuilder& Builder) -> FPassExecute {
		DeclareSurfaces(Builder, Inputs);
		if (Inputs.PreviousLights.IsValid()) { Builder.Read(Inputs.PreviousLights, ERTAccess::ShaderRead); }
		DeclareQueue(Builder, Inputs.Queue, Inputs.bFirst);
		Builder.Write(Inputs.TileLights, ERTAccess::StorageWrite);
		const bool bLists = Inputs.Choosers.IsValid();
		if (bLists) { MarkThreads(Builder, Inputs.Choosers.List); }
		else if (Inputs.Choices.IsValid()) { Builder.Write(Inputs.Choices, ERTAccess::StorageWrite); }
		if (Inputs.bFirst) { Builder.Write(Inputs.Queue.Answers, ERTAccess::StorageWrite); }
		if (Inputs.IsGuided()) { DeclareGuide(Builder, Inputs, !bLists); }
		else if (Inputs.Rays.bMany) { ReadLightCells(Builder, Frame->World->LightCells, false); }
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			if (Inputs.bFirst) { StartQueue(Pass, Inputs.Queue); }
			FLocalRequestsConstants C = MakeConstants(Pass, *Frame, Inputs);
			C.Answers = Inputs.bFirst ? GetAddress(Pass, Inputs.Queue.Answers) : 0;
			C.PreviousLights = GetSampledIndex(Pass, Inputs.PreviousLights);
			SetSurfaces(Pass, Inputs, C);
			if (Inputs.IsGuided()) { SetGuide(Pass, *Frame, Inputs, C); }
			C.Choices = GetAddress(Pass, bLists ? Inputs.Choosers.List : Inputs.Choices);
			C.Lit = bLists ? 0 : GetAddress(Pass, Inputs.Lit);
			Dispatch2D(Pass, Pipeline, C, Frame->Width, Frame->Height, TILE_SIZE);
		};
	});
}

/// Adds the pass in which pixels of listed tiles choose.
void AddChoosePass(FFrameContext& Context, IRTPipeline* Pipeline, const FRequestsPass& Inputs)
{
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass((Inputs.Queue.Name + "LightsChoose").c_str(), [&](FPassBuilder& Builder) -> FPassExecute {
		DeclareSurfaces(Builder, Inputs);
		DeclareQueue(Builder, Inputs.Queue, false);
		LaunchFromThreadList(Builder, Inputs.Choosers.List);
		Builder.Read(Inputs.TileLights, ERTAccess::StorageRead);
		Builder.Write(Inputs.TileLights, ERTAccess::StorageWrite);
		Builder.Read(Inputs.Guide, ERTAccess::StorageRead); // other tiles have theirs
		Builder.Write(Inputs.Choices, ERTAccess::StorageWrite);
		DeclareGuide(Builder, Inputs, true);
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			FLocalRequestsConstants C = MakeConstants(Pass, *Frame, Inputs);
			SetSurfaces(Pass, Inputs, C);
			SetGuide(Pass, *Frame, Inputs, C);
			C.Choices = GetAddress(Pass, Inputs.Choices);
			C.Lit = GetAddress(Pass, Inputs.Lit);
			C.Answers = GetAddress(Pass, Inputs.Choosers.List);
			DispatchThreadList(Pass, Pipeline, Inputs.Choosers.List, C);
		};
	});
}

void AddSharePass(FFrameContext& Context, IRTPipeline* Pipeline, const FRequestsPass& Inputs)
{
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass((Inputs.Queue.Name + "LightsShare").c_str(), [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.Read(Inputs.TileLights, ERTAccess::ShaderRead);
		DeclareQueue(Builder, Inputs.Queue, false);
		Builder.AllowAsync();
		return [=](FPassContext& Pass) { Dispatch2D(Pass, Pipeline, MakeConstants(Pass, *Frame, Inputs), Inputs.Tiles, 1, TILE_PIXELS); };
	});
}
} // namespace

// Where surfaces emit, pixels always choose of a table. A light mask ranks lights as tables do.
bool IsGuided(const FSceneFacts& Facts, uint32_t Exact)
{
	return HasEmitters(Facts) || (MayChooseLights(Facts, Exact) && (CVarCandidates.GetOnRenderThread() > 0 || Facts.bLightMask));
}

FShaderDefines MakeLocalDefines(FSceneFacts Facts, uint32_t Exact)
{
	const bool bMany = MayChooseLights(Facts, Exact);
	Facts.bSun = Facts.bSky = Facts.bSkyInPlace = Facts.bMasked = Facts.bDiffuseTransmission = false; // nothing of it reaches these shaders
	FShaderDefines Defines = MakeFactDefines(Facts);
	if (bMany) { Defines.emplace_back("MANY_LIGHTS", "1"); }
	AddRateDefine(GetLightRate(), Defines);
	AddEmitterDefines(Facts, Defines);
	return Defines;
}

FShaderDefines MakeChoiceDefines(const FSceneFacts& Facts, uint32_t Exact)
{
	FShaderDefines Defines = MakeLocalDefines(Facts, Exact);
	if (IsGuided(Facts, Exact)) { Defines.emplace_back("GUIDED", "1"); }
	if (Facts.bLightMask) { Defines.emplace_back("LIGHT_MASK", "1"); }
	if (const uint32_t Chosen = GetChosen(Facts, Exact); Chosen > 1) { Defines.emplace_back("CHOSEN_RAYS", std::to_string(Chosen) + "u"); }
	if (HasEmitters(Facts) && Facts.bMasked) { Defines.emplace_back("HAS_MASKED", "1"); } // what is cut away does not shine
	return Defines;
}

bool HasLocalRays(const FSceneFacts& Facts) { return Facts.ShadowedLights > 0 || HasEmitters(Facts); }

uint32_t GetLocalRaysPerPixel(const FSceneFacts& Facts, uint32_t Exact)
{
	if (!HasLocalRays(Facts)) { return 0; }
	const bool bRest = Facts.bLightMask && !Facts.bMaskAlone && MayChooseLights(Facts, Exact); // beside the lights of the mask
	return std::max(std::min(Facts.ShadowedLights, Exact) + (HasEmitters(Facts) || bRest ? 1 : 0), GetChosen(Facts, Exact));
}

bool MayChooseLights(const FSceneFacts& Facts, uint32_t Exact) { return Facts.Lights > Exact || HasEmitters(Facts); }

void ListLocalRequestShaders(const FSceneFacts& Facts, uint32_t Exact, std::vector<FShaderSource>& Out)
{
	Out.push_back(MakeRequestsSource(Facts, Exact));
	if (ListsChoosers(Facts, Exact))
	{
		Out.push_back(MakeChooseSource(Facts, Exact));
		Out.push_back(MakeThreadOrderSource());
	}
	if (MayChooseLights(Facts, Exact) && !IsGuided(Facts, Exact)) { ListLightCellShaders(Facts, Out); }
	ListEmitterShaders(Facts, Out);
	if (HasRegions(Facts, Exact)) { Out.push_back(MakeLightRegionsSource(Facts)); }
	// The half frame's queue has room for all; the whole one's serves until that frame is ready.
	if (MayQueuesOverflow(1 + GetLocalRaysPerPixel(Facts, Exact))) { Out.push_back(MakeShareSource()); }
	if (HasLocalRays(Facts) && WantsSecondRays()) { Out.push_back(MakeSecondRaysSource(MakeLocalDefines(Facts, Exact))); }
}

bool AreLocalRequestsReady(FFrameContext& Context, uint32_t Exact)
{
	const bool bShared =
	    Context.bHalf || !MayQueuesOverflow(1 + GetLocalRaysPerPixel(Context.Facts, Exact)) || RequireCompute(Context, MakeShareSource());
	const bool bSecond = !HasLocalRays(Context.Facts) || !WantsSecondRays() ||
	                     RequireCompute(Context, MakeSecondRaysSource(MakeLocalDefines(Context.Facts, Exact)));
	const bool bListed = !HasRegions(Context.Facts, Exact) || RequireCompute(Context, MakeLightRegionsSource(Context.Facts));
	const bool bLists = ListsChoosers(Context.Facts, Exact);
	const bool bChosen = !bLists || RequireCompute(Context, MakeChooseSource(Context.Facts, Exact));
	const bool bOrdered = !bLists || RequireCompute(Context, MakeThreadOrderSource());
	return RequireCompute(Context, MakeRequestsSource(Context.Facts, Exact)) && bChosen && bOrdered && bShared && bListed && bSecond &&
	       AreEmittersReady(Context);
}

void AddLocalRequests(FFrameContext& Context, const FGBuffer& GBuffer, FShadowRays& InOut, const FLocalRays& Rays)
{
	FRequestsPass Inputs{GBuffer, InOut.Queue, Rays, !InOut.Tiles.IsValid()};
	Inputs.Tiles = DivideUp(Context.Width, TILE_SIZE) * DivideUp(Context.Height, TILE_SIZE);
	Inputs.TileLights = Context.Graph.CreateBuffer({Inputs.Tiles * sizeof(FTileLights)}, "TileLights");
	if (Context.Facts.bLightMask && !FindMaskLights(Context, InOut.Traced.MaskLights)) { return; }
	Inputs.PreviousLights = InOut.Traced.MaskLights.Previous;
	if (Rays.bMany)
	{
		const uint64_t Pixels = uint64_t(Context.Width) * Context.Height;
		const uint64_t Choices = Context.Facts.bMaskAlone ? 0 : Pixels * GetChosen(Context.Facts, Rays.Exact);
		if (Choices > 0) { Inputs.Choices = Context.Graph.CreateBuffer({Choices * sizeof(FLightChoice)}, "LightChoices"); }
		if (!IsGuided(Context.Facts, Rays.Exact)) { RequireLightCells(Context, GBuffer); } // pixels visit the lights of their cell
		else if (!AddGuide(Context, Choices, Inputs)) { return; }
		if (HasRegions(Context.Facts, Rays.Exact))
		{
			Inputs.Regions = AddLightRegions(Context, GBuffer, RequireCompute(Context, MakeLightRegionsSource(Context.Facts)));
		}
	}
	Inputs.Emitters = AddEmitterClusters(Context, GBuffer);
	if (Rays.bMany && ListsChoosers(Context.Facts, Rays.Exact))
	{
		Inputs.Choosers = AddThreadMarks(
		    Context, DivideUp(Context.Width, TILE_SIZE), DivideUp(Context.Height, TILE_SIZE), Inputs.Queue.Name + "Choosers");
	}
	Inputs.Channels = RequirePixelChannels(Context, GBuffer);
	AddRequestsPass(Context, RequireCompute(Context, MakeRequestsSource(Context.Facts, Rays.Exact)), Inputs);
	if (Inputs.Choosers.IsValid())
	{
		AddThreadOrder(Context, Inputs.Choosers, {}, 1);
		AddChoosePass(Context, RequireCompute(Context, MakeChooseSource(Context.Facts, Rays.Exact)), Inputs);
	}
	if (InOut.Queue.bMayOverflow) { AddSharePass(Context, RequireCompute(Context, MakeShareSource()), Inputs); }
	InOut.Traced.TileLights = Inputs.TileLights;
	InOut.Traced.Choices = Inputs.Choices;
	InOut.Traced.Lit = Inputs.Lit;
	InOut.Traced.Guide = Inputs.Guide;
	InOut.Traced.GuideOffset = Inputs.GuideOffset;
	InOut.Traced.LocalPerPixel = Rays.PerPixel;
}

void AddFurtherLocalRays(
    FFrameContext& Context, const FGBuffer& GBuffer, const FRayDispatch& Dispatch, FShadowRays& InOut, const FLocalRays& Rays)
{
	if (Rays.PerPixel == 0) { return; }
	const FShaderDefines Defines = MakeLocalDefines(Context.Facts, Rays.Exact);
	if (WantsSecondRays())
	{
		IRTPipeline* const Pipeline = RequireCompute(Context, MakeSecondRaysSource(Defines));
		if (Pipeline) { AddSecondRays(Context, GBuffer, Dispatch, InOut.Queue, InOut.Traced, Pipeline); }
	}
	if (Rays.More) { AddMoreLocalRays(Context, GBuffer, Dispatch, InOut, Defines, *Rays.More); }
}

} // namespace Lantern
