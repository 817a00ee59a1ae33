// Moved casters of a view, in the coordinates of shaders.
#include "Tiles/MovedCasters.h"

#include <algorithm>
#include <cmath>

#include "LanternCore/Config/ConsoleVariables.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarCapsules(
    "r.RT.Debug.Shadow.Capsules", true, "Planted fault. Off: r.RT.Shadow.Adaptive is not told which casters moved.");
static_assert(SETTLED_MOST_CASTERS >= FCasterChanges::MostKept);

/// Share of the sun's diameter by which it may move in a frame without a new start. The disk's visible share changes by at most
/// 4/π of it, here 2 % per frame, and every pixel is traced in one frame of four.
constexpr double LittleMove = 1.0 / 64.0;
} // namespace

FMovedCasters::FSunState FMovedCasters::MakeSunState(const FRTScene& Scene, const FSunRays& Rays)
{
	return {glm::normalize(Scene.GetSun().Direction), Rays};
}

bool FMovedCasters::HoldsFor(const FSunState& Before, const FSunState& Now)
{
	return glm::length(Now.Direction - Before.Direction) <= LittleMove * double(Now.Rays.Diameter) && Before.Rays == Now.Rays;
}

FMovedCasters::FFound FMovedCasters::Find(const FRTScene& Scene, const FSunRays& Rays)
{
	const FCasterChanges& Changes = Scene.GetCasterChanges();
	Next = {MakeSunState(Scene, Rays), Changes.GetCount(), true};
	FFound Found;
	Found.Turn = Turn;
	Found.bOtherSun = !Last.bValid || !HoldsFor(Last.Sun, Next.Sun);
	if (Found.bOtherSun || !CVarCapsules.GetOnRenderThread()) { return Found; }
	std::vector<FCasterChange> Moved;
	Found.bAnywhere = !Changes.Find(Last.Changes, Moved);
	for (const FCasterChange& Change : Moved)
	{
		Found.Casters.push_back({Scene.ToRelative(Change.From), static_cast<float>(Change.Radius), Scene.ToRelative(Change.To), 0});
	}
	return Found;
}

void FMovedCasters::EndFrame(bool bSubmitted)
{
	if (!bSubmitted) { return; }
	Last = std::exchange(Next, {});
	++Turn;
}

} // namespace Lantern
