// Moved casters of a view, in the coordinates of shaders.
#include "Tiles/MovedCasters.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "LanternCore/Config/ConsoleVariables.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarCapsules(
    "r.RT.Debug.Shadow.Capsules", true, "Planted fault. Off: r.RT.Shadow.Adaptive and the filter are not told which casters moved.");
TRTConsoleVariable<bool> CVarKnownChanges("r.RT.Shadow.KnownChanges", true,
    "The filter looks for changes of the sun's shadows only where casters or surfaces moved, as the scene knows. If off, it looks for "
    "them everywhere in the picture, and takes some noise for change.");
static_assert(SETTLED_MOST_CASTERS >= FCasterChanges::MostKept);

/// Share of the sun's diameter by which it may move in a frame without a new start. The disk's visible share changes by at most
/// 4/π of it, here 2 % per frame, and every pixel is traced in one frame of four.
constexpr double LittleMove = 1.0 / 64.0;
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

FMovedCasters::FFound FMovedCasters::Find(FRTScene& Scene, const FSunRays& Rays, float DeltaSeconds)
{
	Note(Scene, Rays, DeltaSeconds);
	FFound Found;
	Found.Turn = Turn;
	Found.bOtherSun = !Last.bValid || !HoldsFor(Last.Sun, Next.Sun);
	if (Found.bOtherSun || !CVarCapsules.GetOnRenderThread()) { return Found; }
	std::vector<FCasterChange> Moved;
	Found.bAnywhere = !Scene.GetCasterChanges().Find(Last.Changes, Moved);
	Found.Casters = Convert(Scene, Moved);
	return Found;
}

FMovedCasters::FRecent FMovedCasters::FindRecent(FRTScene& Scene, const FSunRays& Rays, float DeltaSeconds)
{
	Note(Scene, Rays, DeltaSeconds);
	FRecent Found;
	if (Recent.empty()) { return Found; } // nothing was kept before
	for (const FState& State : Recent) { Found.bAnywhere |= !HoldsFor(State.Sun, Next.Sun); }
	if (Found.bAnywhere || !CVarCapsules.GetOnRenderThread()) { return Found; }
	std::vector<FCasterChange> Moved;
	Found.bAnywhere = !Scene.GetCasterChanges().Find(Recent.front().Changes, Moved);
	Found.Casters = Convert(Scene, Moved);
	return Found;
}

FMovedCasters::FRecent FMovedCasters::FindRecentOfLamps(FRTScene& Scene, float DeltaSeconds)
{
	if (!Next.bValid) { Note(Scene, {}, DeltaSeconds); } // nobody asks for the sun
	FRecent Found;
	if (Recent.empty()) { return Found; }
	const FState& Before = Recent.front();
	Found.bAnywhere = Before.Sun.Scene != Next.Sun.Scene || Before.Lights != Next.Lights;
	if (Found.bAnywhere || !CVarCapsules.GetOnRenderThread()) { return Found; }
	std::vector<FCasterChange> Moved;
	Found.bAnywhere = !Scene.GetCasterChanges().Find(Before.Changes, Moved);
	Found.Casters = Convert(Scene, Moved);
	return Found;
}

bool FMovedCasters::HaveLampsChanged(FRTScene& Scene, float DeltaSeconds)
{
	if (!Next.bValid) { Note(Scene, {}, DeltaSeconds); }
	return Recent.empty() || Recent.back().Sun.Scene != Next.Sun.Scene || Recent.back().Lights != Next.Lights;
}

bool FMovedCasters::HaveEmittersChanged(FRTScene& Scene, float DeltaSeconds)
{
	if (!Next.bValid) { Note(Scene, {}, DeltaSeconds); }
	return Recent.empty() || Recent.back().Sun.Scene != Next.Sun.Scene || Recent.back().Emitters != Next.Emitters;
}

/// A lamp that comes and goes at a limit must not void what was noted each time.
uint32_t FMovedCasters::GetLampRoom(uint32_t Slots)
{
	constexpr uint32_t Least = 128;
	if (Slots > LampRoom || std::max(Slots, Least) < LampRoom / 8) { LampRoom = std::bit_ceil(std::max(2 * Slots, Least)); }
	return LampRoom;
}

void FMovedCasters::Note(FRTScene& Scene, const FSunRays& Rays, float DeltaSeconds)
{
	Next = {MakeSunState(Scene, Rays), Scene.GetCasterChanges().GetCount(), true, DeltaSeconds, Scene.GetLights().GetChangeCount(),
	    Scene.GetEmissiveChangeCount(), 0.0};
}

std::vector<FMovedCaster> FMovedCasters::Convert(FRTScene& Scene, const std::vector<FCasterChange>& Changes)
{
	std::vector<FMovedCaster> Out;
	for (const FCasterChange& Change : Changes)
	{
		Out.push_back({Scene.ToRelative(Change.From), static_cast<float>(Change.Radius), Scene.ToRelative(Change.To), 0});
	}
	return Out;
}

bool FindShadowChanges(FFrameContext& Context, const FSunRays& Rays, FShadowChanges& Out)
{
	// What is in a host's own map, nobody tells.
	if (!CVarKnownChanges.GetOnRenderThread() || Context.Facts.bHostShadow) { return true; }
	const FMovedCasters::FRecent Found = Context.MovedCasters->FindRecent(Context.Scene, Rays, Context.View.DeltaSeconds);
	Out.bKnown = !Found.bAnywhere;
	Out.CasterCount = static_cast<uint32_t>(Found.Casters.size());
	Out.Spread = std::sqrt(2.0f * GetSunOneMinusCos(Rays)) + 1.0e-3f;
	return WriteCasters(Context, Found.Casters, Out.Casters);
}

bool FindLampShadowChanges(FFrameContext& Context, FShadowChanges& Out)
{
	constexpr uint64_t MostPairs = 4096; // 64 for each thread of a tile
	const FMovedCasters::FRecent Found = Context.MovedCasters->FindRecentOfLamps(Context.Scene, Context.View.DeltaSeconds);
	const uint64_t Pairs = uint64_t(Found.Casters.size()) * Context.Scene.GetLights().GetSlotCount();
	Out.bKnown = !Found.bAnywhere && Pairs <= MostPairs;
	if (!Out.bKnown) { return true; }
	Out.CasterCount = static_cast<uint32_t>(Found.Casters.size());
	return WriteCasters(Context, Found.Casters, Out.Casters);
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
	while (!Recent.empty() && Time - Recent.front().Time > RecentSeconds) { Recent.pop_front(); }
	Recent.push_back(Last);
}

} // namespace Lantern
