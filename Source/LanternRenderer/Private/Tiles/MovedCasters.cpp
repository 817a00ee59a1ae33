// Moved casters of a view, in the coordinates of shaders.
#include "Tiles/MovedCasters.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <unordered_map>

#include "LanternCore/Config/ConsoleVariables.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarCapsules(
    "r.RT.Debug.Shadow.Capsules", true, "Planted fault. Off: r.RT.Shadow.Adaptive and the filter are not told which casters moved.");
TRTConsoleVariable<bool> CVarEye(
    "r.RT.Debug.Lights.Eye", true, "Planted fault. Off: the filter of highlights is not told that the camera has gone elsewhere.");
TRTConsoleVariable<bool> CVarKnownChanges("r.RT.Shadow.KnownChanges", true,
    "The filter looks for changes of the sun's shadows only where casters or surfaces moved, as the scene knows. If off, it looks for "
    "them everywhere in the picture, and takes some noise for change.");

/// Share of the sun's diameter by which it may move in a frame without a new start. The disk's visible share changes by at most
/// 4/π of it, here 2 % per frame, and every pixel is traced in one frame of four.
constexpr double LittleMove = 1.0 / 64.0;

constexpr double ShiningFirst = 64.0;   // times what only hides, where there is no room for all
constexpr double MostEmission = 1.0e30; // nits, of fp32

/// False: the changes are more than tiles may look at, or may be anywhere. Out is empty then, as it must be before.
bool FindFew(FRTScene& Scene, uint64_t Since, std::vector<FCasterChange>& Out)
{
	const FCasterChanges& Changes = Scene.GetCasterChanges();
	return Changes.GetCount() - Since <= SETTLED_MOST_CASTERS && Changes.Find(Since, Out);
}

/// Returns one change for each object, in the order in which they were changed first. bAdds: their parts add up; else the greatest
/// counts.
std::vector<FCasterChange> JoinByObject(const std::vector<FCasterChange>& Changes, bool bAdds)
{
	std::vector<FCasterChange> Joined;
	std::unordered_map<uint32_t, size_t> Places;
	for (const FCasterChange& Change : Changes)
	{
		const auto [Place, bNew] = Places.emplace(Change.Object, Joined.size());
		if (bNew)
		{
			Joined.push_back(Change);
			continue;
		}
		FCasterChange& All = Joined[Place->second];
		All.To = Change.To;
		All.Radius = std::max(All.Radius, Change.Radius);
		All.Emission = std::max(All.Emission, Change.Emission);
		All.Changed = bAdds ? std::min(All.Changed + Change.Changed, 1.0) : std::max(All.Changed, Change.Changed);
	}
	return Joined;
}
} // namespace

FMovedCasters::FSunState FMovedCasters::MakeSunState(FRTScene& Scene, const FSunRays& Rays)
{
	return {Scene.GetSections().GetIdentity(), glm::normalize(Scene.GetSun().Direction), Rays};
}

bool FMovedCasters::HoldsFor(const FSunState& Before, const FSunState& Now)
{
	return Before.Scene == Now.Scene && glm::length(Now.Direction - Before.Direction) <= LittleMove * double(Now.Rays.Diameter) &&
	       Before.Rays == Now.Rays;
}

FMovedCasters::FFound FMovedCasters::Find(FRTScene& Scene, const FSunRays& Rays, const FView& View)
{
	Note(Scene, Rays, View);
	FFound Found;
	Found.Turn = Turn;
	Found.bOtherSun = !Last.bValid || !HoldsFor(Last.Sun, Next.Sun);
	if (Found.bOtherSun || !CVarCapsules.GetOnRenderThread()) { return Found; }
	std::vector<FCasterChange> Moved;
	Found.bAnywhere = !FindFew(Scene, Last.Changes, Moved);
	Found.Casters = Convert(Scene, Moved);
	return Found;
}

FMovedCasters::FRecent FMovedCasters::FindRecent(FRTScene& Scene, const FSunRays& Rays, const FView& View)
{
	Note(Scene, Rays, View);
	FRecent Found;
	if (Recent.empty()) { return Found; } // nothing was kept before
	for (const FState& State : Recent) { Found.bAnywhere |= !HoldsFor(State.Sun, Next.Sun); }
	AddRecentMoves(Scene, Found);
	return Found;
}

FMovedCasters::FRecent FMovedCasters::FindRecentOfLamps(FRTScene& Scene, bool bHighlights, const FView& View)
{
	if (!Next.bValid) { Note(Scene, {}, View); } // nobody asks for the sun
	FRecent Found;
	if (Recent.empty()) { return Found; }
	const FState& Before = Recent.front();
	const bool bLooksAtEye = bHighlights && CVarEye.GetOnRenderThread();
	Found.bAnywhere = Before.Sun.Scene != Next.Sun.Scene || Before.Lights != Next.Lights;
	if (bLooksAtEye)
	{
		Found.bAnywhere |= std::ranges::any_of(Recent, [&](const FState& State) { return State.Eye != Next.Eye; });
	}
	AddRecentMoves(Scene, Found);
	Found.QuietSeconds = Time - (bLooksAtEye ? std::max(ChangeTime, EyeTime) : ChangeTime);
	return Found;
}

FMovedCasters::FRecent FMovedCasters::FindMovers(FRTScene& Scene, const FView& View)
{
	if (!Next.bValid) { Note(Scene, {}, View); }
	FRecent Found;
	if (Recent.empty()) { return Found; }
	const FState& Before = Recent.front();
	std::vector<FCasterChange> Moved, Others;
	if (Before.Sun.Scene != Next.Sun.Scene) { return {.bAnywhere = true}; }
	Found.bAnywhere = !Scene.GetCasterChanges().Find(Before.Changes, Moved);
	Scene.GetAppearanceChanges().GetObjects().Find(Before.Appearance, Others); // FRadianceEvents sees to those that are too many
	std::vector<FCasterChange> Movers = JoinByObject(Moved, true);
	for (FCasterChange Other : JoinByObject(Others, false))
	{
		Other.From = Other.To; // a way would stand for a move
		Other.bCasts = false;
		Movers.push_back(Other);
	}
	if (Movers.size() > SETTLED_MOST_CASTERS)
	{
		const glm::dvec3 Camera = MakeGatherView(View).Position;
		const auto Hides = [&](const FCasterChange& Mover) {
			const glm::dvec3 Away = Mover.To - Camera;
			return (Mover.Emission > 0.0 ? ShiningFirst : 1.0) * Mover.Changed * Mover.Radius * Mover.Radius /
			       std::max(glm::dot(Away, Away), Mover.Radius * Mover.Radius);
		};
		std::ranges::stable_sort(Movers, std::greater{}, Hides);
		Movers.resize(SETTLED_MOST_CASTERS);
	}
	Found.Casters = Convert(Scene, Movers);
	return Found;
}

/// Recent is not empty.
void FMovedCasters::AddRecentMoves(FRTScene& Scene, FRecent& InOut) const
{
	if (InOut.bAnywhere || !CVarCapsules.GetOnRenderThread()) { return; }
	std::vector<FCasterChange> Moved;
	InOut.bAnywhere = !FindFew(Scene, Recent.front().Changes, Moved);
	InOut.Casters = Convert(Scene, Moved);
}

bool FMovedCasters::HaveLampsChanged(FRTScene& Scene, const FView& View)
{
	if (!Next.bValid) { Note(Scene, {}, View); }
	return Recent.empty() || Recent.back().Sun.Scene != Next.Sun.Scene || Recent.back().Lights != Next.Lights;
}

bool FMovedCasters::HaveEmittersChanged(FRTScene& Scene, const FView& View)
{
	if (!Next.bValid) { Note(Scene, {}, View); }
	return Recent.empty() || Recent.back().Sun.Scene != Next.Sun.Scene || Recent.back().Emitters != Next.Emitters;
}

/// A lamp that comes and goes at a limit must not void what was noted each time.
uint32_t FMovedCasters::GetLampRoom(uint32_t Slots)
{
	constexpr uint32_t Least = 128;
	if (Slots > LampRoom || std::max(Slots, Least) < LampRoom / 8) { LampRoom = std::bit_ceil(std::max(2 * Slots, Least)); }
	return LampRoom;
}

void FMovedCasters::Note(FRTScene& Scene, const FSunRays& Rays, const FView& View)
{
	const FEye Eye{View.Position, View.GetWindow().bOrthographic ? View.Forward : glm::vec3(0)};
	Next = {MakeSunState(Scene, Rays), Scene.GetCasterChanges().GetCount(), true, View.DeltaSeconds, Scene.GetLights().GetChangeCount(),
	    Scene.GetEmissiveChangeCount(), Scene.GetAppearanceChanges().GetObjects().GetCount(), 0.0, Eye};
}

std::vector<FMovedCaster> FMovedCasters::Convert(FRTScene& Scene, const std::vector<FCasterChange>& Changes)
{
	std::vector<FMovedCaster> Out;
	for (const FCasterChange& Change : Changes)
	{
		Out.push_back({Scene.ToRelative(Change.From), static_cast<float>(Change.Radius), Scene.ToRelative(Change.To),
		    static_cast<float>(Change.Changed), static_cast<float>(std::min(Change.Emission, MostEmission)), Change.Object,
		    Change.bCasts ? 1u : 0u});
	}
	return Out;
}

bool FindShadowChanges(FFrameContext& Context, const FSunRays& Rays, FShadowChanges& Out)
{
	// What is in a host's own map, nobody tells.
	if (!CVarKnownChanges.GetOnRenderThread() || Context.Facts.bHostShadow) { return true; }
	const FMovedCasters::FRecent Found = Context.MovedCasters->FindRecent(Context.Scene, Rays, Context.View);
	Out.bKnown = !Found.bAnywhere;
	Out.CasterCount = static_cast<uint32_t>(Found.Casters.size());
	Out.Spread = std::sqrt(2.0f * GetSunOneMinusCos(Rays)) + 1.0e-3f;
	return WriteCasters(Context, Found.Casters, Out.Casters);
}

bool FindLampChanges(FFrameContext& Context, bool bHighlights, FShadowChanges& Out)
{
	constexpr uint64_t MostPairs = 4096; // 64 for each thread of a tile
	const FMovedCasters::FRecent Found = Context.MovedCasters->FindRecentOfLamps(Context.Scene, bHighlights, Context.View);
	const uint64_t Pairs = uint64_t(Found.Casters.size()) * Context.Scene.GetLights().GetSlotCount();
	Out.bKnown = !Found.bAnywhere && Pairs <= MostPairs;
	Out.QuietSeconds = Found.QuietSeconds;
	if (!Out.bKnown) { return true; }
	Out.CasterCount = static_cast<uint32_t>(Found.Casters.size());
	return WriteCasters(Context, Found.Casters, Out.Casters);
}

const FMoversOfFrame& RequireMovers(FFrameContext& Context)
{
	FMoversOfFrame& Movers = Context.World->Movers;
	if (std::exchange(Movers.bAsked, true)) { return Movers; }
	const FMovedCasters::FRecent Found = Context.MovedCasters->FindMovers(Context.Scene, Context.View);
	if (WriteCasters(Context, Found.Casters, Movers.Casters)) { Movers.Count = static_cast<uint32_t>(Found.Casters.size()); }
	return Movers;
}

bool WriteCasters(FFrameContext& Context, const std::vector<FMovedCaster>& Casters, uint64_t& OutAddress)
{
	OutAddress = 0;
	if (Casters.empty()) { return true; }
	FUploadSlice Slice;
	if (FRTStatus S = Context.Owner->GetUploads().Push(Casters.data(), Casters.size() * sizeof(Casters[0]), Slice); !S)
	{
		Context.Fail(S);
		return false;
	}
	OutAddress = Slice.Address;
	return true;
}

void FMovedCasters::EndFrame(bool bSubmitted)
{
	if (!bSubmitted) { return; }
	Last = std::exchange(Next, {});
	++Turn;
	if (!Last.bValid) { return Recent.clear(); }
	Time += double(Last.DeltaSeconds);
	Last.Time = Time;
	if (!Recent.empty())
	{
		const FState& Before = Recent.back();
		if (Before.Sun.Scene != Last.Sun.Scene || Before.Changes != Last.Changes || Before.Lights != Last.Lights) { ChangeTime = Time; }
		if (Before.Eye != Last.Eye) { EyeTime = Time; }
	}
	while (!Recent.empty() && Time - Recent.front().Time > RecentSeconds) { Recent.pop_front(); }
	Recent.push_back(Last);
}

} // namespace Lantern
