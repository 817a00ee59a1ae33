// What may have changed the sun's shadows since a view's last frame: casters that moved, and the sun itself. The scene tells
// (FCasterChanges); nothing is guessed from pictures.
#pragma once

#include <deque>
#include <vector>

#include "LanternScene/Scene/Scene.h"
#include "Rays/RayQueue.h"
#include "SettledTypes.h"

namespace Lantern
{

/// Belongs to one view. Render thread. A frame: Find or FindRecent, if sun shadows rely on frames before → EndFrame.
class FMovedCasters
{
public:
	struct FFound
	{
		bool bOtherSun = false; ///< what was known of the sun's shadows is void; also in the first frame
		bool bAnywhere = false; ///< any shadow may have moved
		uint32_t Turn = 0;      ///< counts the view's submitted frames
		/// Casters that moved, came, went or were deformed, at most SETTLED_MOST_CASTERS. Empty with bAnywhere.
		std::vector<FMovedCaster> Casters;
	};
	/// Rays: how the sun's rays are traced in this frame. After the scene's BeginUpdate.
	FFound Find(const FRTScene& Scene, const FSunRays& Rays);

	/// Frames before this one whose changes FindRecent reports. A filter needs some frames to see that its history is wrong.
	static constexpr uint32_t RecentFrames = 8;
	struct FRecent
	{
		bool bAnywhere = false;            ///< any shadow may have moved
		std::vector<FMovedCaster> Casters; ///< empty with bAnywhere
	};
	/// Finds what may have changed in the last RecentFrames frames and in this one. As Find.
	FRecent FindRecent(const FRTScene& Scene, const FSunRays& Rays);
	/// Returns whether FindRecent would find anything.
	bool HasMoved(const FRTScene& Scene, const FSunRays& Rays);
	/// bSubmitted: false if the frame never runs; the next frame then finds its changes again.
	void EndFrame(bool bSubmitted);

private:
	/// What the shadows of a frame depend on beside the casters.
	struct FSunState
	{
		glm::dvec3 Direction{0}; ///< unit length
		FSunRays Rays;
	};
	struct FState
	{
		FSunState Sun;
		uint64_t Changes = 0; ///< FCasterChanges::GetCount
		bool bValid = false;
	};
	static FSunState MakeSunState(const FRTScene& Scene, const FSunRays& Rays);
	static bool HoldsFor(const FSunState& Before, const FSunState& Now);
	static std::vector<FMovedCaster> Convert(const FRTScene& Scene, const std::vector<FCasterChange>& Changes);
	void Note(const FRTScene& Scene, const FSunRays& Rays);

	FState Last, Next;
	std::deque<FState> Recent; ///< of the last frames, the oldest first; the last one is Last
	uint32_t Turn = 0;
};

/// Writes casters where this frame's shaders read them. OutAddress: 0 if there are none. False: an error, which the context has.
bool WriteCasters(FFrameContext& Context, const std::vector<FMovedCaster>& Casters, uint64_t& OutAddress);

} // namespace Lantern
