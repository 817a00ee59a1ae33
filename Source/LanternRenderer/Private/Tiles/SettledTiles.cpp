// Passes and tables of tiles that need few rays.
#include "Tiles/SettledTiles.h"

#include <cstring>
#include <utility>

#include "LanternCore/Config/ConsoleVariables.h"
#include "Tiles/MovedCasters.h"
#include "Tiles/Tiles.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarAdaptive("r.RT.Shadow.Adaptive", false,
    "Traces a quarter of the sun's rays where they all had one answer for 16 frames and no caster moved. If one of them disagrees, the "
    "rest "
    "follows in the same frame. It needs r.RT.Shadow.Denoise.");

TRTConsoleVariable<float> CVarRateDistance("r.RT.Shadow.RateDistance", 0.0f,
    "Distance in metres from which on fewer pixels trace sun rays: half of them at twice the distance, a quarter from four times on. The "
    "others are filled from their neighbours. 0: all are traced.",
    {0.0, 1e9});

FShaderSource MakeCheckSource() { return MakeComputeSource("Tiles/CheckSettled.comp"); }

/// False: shaders are being compiled, or an error, which the context has.
bool RequireKnown(FFrameContext& Context, const FGBuffer& GBuffer, const FMovedCasters::FFound& Found, FSettledTiles& Out)
{
	if (!RequireSurface(Context, {GBuffer.Depth, GBuffer.Normals, GBuffer.Motion})) { return false; }
	if (!WriteCasters(Context, Found.Casters, Out.Values.Casters)) { return false; }
	Out.Values.CasterCount = static_cast<uint32_t>(Found.Casters.size());
	if (FRTStatus S = Context.History->GetTexture("SunSettled", {Context.Width, Context.Height, ERTFormat::R8_UNORM}, Out.Known); !S)
	{
		Context.Fail(S);
		return false;
	}
	if (Found.bOtherSun || !Context.Surface.Previous.IsValid()) { Out.Known.Previous = {}; }
	return true;
}

void AddCheckPass(
    FFrameContext& Context, IRTPipeline* Pipeline, const FRayQueue& Second, FGraphBuffer Tiles, FGraphBuffer Marks, FGraphTexture Known)
{
	const FFrameContext* const Frame = &Context;
	Context.Graph.AddPass((Second.Name + "Check").c_str(), [&](FPassBuilder& Builder) -> FPassExecute {
		for (const FGraphBuffer Buffer : {Tiles, Second.Answers})
		{
			Builder.Read(Buffer, ERTAccess::StorageRead);
			Builder.Write(Buffer, ERTAccess::StorageWrite);
		}
		Builder.Read(Known, ERTAccess::StorageRead);
		Builder.Write(Marks, ERTAccess::StorageWrite);
		Builder.AllowAsync();
		return [=](FPassContext& Pass) {
			FCheckSettledConstants C{};
			C.Pass = Frame->Pass;
			C.Tiles = GetAddress(Pass, Tiles);
			C.Marks = GetAddress(Pass, Marks);
			C.Answers = GetAddress(Pass, Second.Answers);
			C.Settled = GetStorageIndex(Pass, Known);
			Dispatch2D(Pass, Pipeline, C, Frame->Width, Frame->Height, TILE_SIZE);
		};
	});
}
} // namespace

FSunRates GetSunRates(const FSceneFacts& Facts, bool bMayFilter)
{
	// A host's map answers most pixels, and rays take its place where it cannot.
	if (Facts.bHostShadow) { return {}; }
	return {bMayFilter && CVarAdaptive.GetOnRenderThread(), CVarRateDistance.GetOnRenderThread()};
}

FShaderDefines MakeSettledDefines(const FSunRates& Rates) { return Rates.IsAny() ? FShaderDefines{{"ADAPTIVE", "1"}} : FShaderDefines{}; }

void ListSettledShaders(std::vector<FShaderSource>& Out) { Out.push_back(MakeCheckSource()); }

FSettledTiles FindSettledTiles(FFrameContext& Context, const FGBuffer& GBuffer, const FSunRays& Sun, const FSunRates& Rates, bool bFiltered)
{
	FSettledTiles Settled{.Rates = Rates};
	const bool bAdaptive = Rates.bAdaptive && bFiltered;
	if (!bAdaptive && Rates.DistanceMetres <= 0.0f) { return Settled; }
	const FMovedCasters::FFound Found = Context.MovedCasters->Find(Context.Scene, Sun, Context.View);
	Settled.Values.bAnywhere = Found.bAnywhere ? 1u : 0u;
	Settled.Values.Turn = Found.Turn;
	Settled.Values.RateDistance = Rates.DistanceMetres;
	if (bAdaptive && (!RequireCompute(Context, MakeCheckSource()) || !RequireKnown(Context, GBuffer, Found, Settled)))
	{
		return {.Rates = Rates};
	}
	if (FRTStatus S = Context.Owner->GetUploads().Allocate(sizeof(FSettledConstants), Settled.Constants); !S)
	{
		Context.Fail(S);
		return {.Rates = Rates};
	}
	return Settled;
}

void DeclareSettled(FPassBuilder& Builder, const FFrameContext& Context, const FSettledTiles& Settled)
{
	if (!Settled.Known.Current.IsValid()) { return; }
	Builder.Read(Context.Surface.Current, ERTAccess::ShaderRead);
	Builder.Write(Settled.Known.Current, ERTAccess::StorageWrite);
	Builder.Keep(Settled.Known.Current);
	if (!Settled.Known.Previous.IsValid()) { return; }
	for (const FGraphTexture Texture : {Context.Surface.Reprojection, Context.Surface.Motion, Settled.Known.Previous})
	{
		Builder.Read(Texture, ERTAccess::ShaderRead);
	}
}

FAddress WriteSettled(FPassContext& Pass, const FFrameContext& Context, const FSettledTiles& Settled)
{
	if (!Settled.IsUsed()) { return 0; }
	const bool bPrevious = Settled.Known.Previous.IsValid();
	FSettledConstants C = Settled.Values;
	C.Surface = GetSampledIndex(Pass, Settled.Known.Current.IsValid() ? Context.Surface.Current : FGraphTexture{});
	C.Reprojection = GetSampledIndex(Pass, bPrevious ? Context.Surface.Reprojection : FGraphTexture{});
	C.Motion = GetSampledIndex(Pass, bPrevious ? Context.Surface.Motion : FGraphTexture{});
	C.Previous = GetSampledIndex(Pass, Settled.Known.Previous);
	C.Current = GetStorageIndex(Pass, Settled.Known.Current);
	std::memcpy(Settled.Constants.Data, &C, sizeof(C));
	return Settled.Constants.Address;
}

void AddSettledRays(FFrameContext& Context, const FGBuffer& GBuffer, const FRayDispatch& Dispatch, const FRayQueue& Queue,
    const FQueuedRays& Rays, FGraphBuffer Tiles, const FSettledTiles& Settled)
{
	IRTPipeline* const Check = RequireCompute(Context, MakeCheckSource());
	if (!Check) { return; } // FindSettledTiles had it
	FRayQueue Second = CreateFurtherQueue(Context, Queue, "Rest");
	Second.bRest = true;
	const FGraphBuffer Marks = CreateSunMarks(Context, Second);
	AddCheckPass(Context, Check, Second, Tiles, Marks, Settled.Known.Current);
	// What has no room makes its tile unsettled: the next frame asks the first queue, which then grows.
	AddSunQueuePass(Context, {Second, Marks, {}, 1, MayLackSunRays(Context, Queue)});
	AddShadowRaysPass(Context, GBuffer, Dispatch, Second, Rays);
}

} // namespace Lantern
