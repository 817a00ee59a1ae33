// From the wishes of signals to one queue: tiles, requests, rays.
#include "Rays/ShadowRays.h"

#include "LocalLights/LocalRequests.h"
#include "SignalPasses.h"
#include "Tiles/MoreRays.h"
#include "Tiles/Tiles.h"

namespace Lantern
{

namespace
{
struct FAsked
{
	FRayDispatch Dispatch;
	FShadowRayWishes Wishes;
};

std::optional<FAsked> AskSignals(FFrameContext& Context)
{
	std::optional<FAsked> Asked;
	ForEachSignalPass([&](const FSignalPass& Pass) {
		if (!Pass.AskShadowRays) { return; }
		const std::optional<FRayDispatch> Dispatch = RequireRayDispatch(Context, Pass.Signal, ChooseSignalRays(Context, Pass.Signal));
		if (!Dispatch || (Pass.IsHalf && Pass.IsHalf(Context)) != Context.bHalf) { return; }
		FAsked Next = Asked ? *Asked : FAsked{*Dispatch, {}};
		if (!Pass.AskShadowRays(Context, *Dispatch, Next.Wishes)) { return; }
		Asked = std::move(Next);
	});
	return Asked;
}

uint32_t GetMostPerPixel(const FShadowRayWishes& Wishes)
{
	return (Wishes.Sun.SamplesPerPixel > 0 ? 1 : 0) + (Wishes.Local ? Wishes.Local->PerPixel : 0);
}

std::shared_ptr<const FShadowRays> AddShadowRays(FFrameContext& Context, const FGBuffer& GBuffer)
{
	if (!CanQueueRays(Context.Width, Context.Height)) { return nullptr; }
	const std::optional<FAsked> Asked = AskSignals(Context);
	if (!Asked) { return nullptr; }
	FShadowRays Rays;
	Rays.Sun = Asked->Wishes.Sun;
	if (Rays.Sun.SamplesPerPixel > 0) { Rays.Map = AddHostShadowPass(Context, Rays.Sun); }
	const bool bFiltered = Asked->Wishes.bSunFiltered && Rays.Sun.SamplesPerPixel > 0;
	if (bFiltered && !FindShadowChanges(Context, Rays.Sun, Rays.Changes)) { return nullptr; }
	Rays.Traced.Sun = Rays.Sun;
	Rays.Queue = CreateRayQueue(Context, GetMostPerPixel(Asked->Wishes));
	if (Asked->Wishes.bSunWidths)
	{
		const uint64_t Pixels = uint64_t(Context.Width) * Context.Height;
		Rays.Queue.SunWidths = Context.Graph.CreateBuffer({Pixels * sizeof(float)}, "SunWidths");
	}
	if (Rays.Sun.SamplesPerPixel > 0)
	{
		Rays.Settled = FindSettledTiles(Context, GBuffer, Rays.Sun, Asked->Wishes.SunRates, Asked->Wishes.bSunFiltered);
		Rays.Tiles = AddTilesPass(Context, GBuffer, Rays.Queue, Rays.Sun, Rays.Settled, Rays.Map);
		if (!Rays.Tiles.IsValid()) { return nullptr; }
	}
	if (Asked->Wishes.Local) { AddLocalRequests(Context, GBuffer, Rays, *Asked->Wishes.Local); }
	if (GetMostPerPixel(Asked->Wishes) > 0) { AddShadowRaysPass(Context, GBuffer, Asked->Dispatch, Rays.Queue, Rays.Traced); }
	if (Rays.Settled.Known.Current.IsValid())
	{
		AddSettledRays(Context, GBuffer, Asked->Dispatch, Rays.Queue, Rays.Traced, Rays.Tiles, Rays.Settled);
	}
	if (Rays.Traced.TileLights.IsValid()) { AddFurtherLocalRays(Context, GBuffer, Asked->Dispatch, Rays, *Asked->Wishes.Local); }
	const FShadowRayWishes& Wishes = Asked->Wishes;
	if (Wishes.MoreSunRays > 0 && Rays.Queue.SunWidths.IsValid())
	{
		const FGraphBuffer Lit = Rays.Map.IsValid() ? Rays.Tiles : FGraphBuffer();
		AddMoreRays(Context, GBuffer, Asked->Dispatch, Rays.Queue, Rays.Traced, Rays.Tiles, Lit, Rays.Changes, Wishes.SunFilterName,
		    Rays.SunHistory);
	}
	return std::make_shared<const FShadowRays>(std::move(Rays));
}
} // namespace

const FShadowRays* RequireShadowRays(FFrameContext& Context, const FGBuffer& GBuffer)
{
	if (!Context.bShadowRaysAsked)
	{
		Context.bShadowRaysAsked = true;
		Context.ShadowRays = AddShadowRays(Context, GBuffer);
	}
	return Context.ShadowRays.get();
}

} // namespace Lantern
