// What may have changed the sun's shadows since a view's last frame: casters that moved, and the sun itself. The scene tells
// (FCasterChanges); nothing is guessed from pictures.
#pragma once

#include <cmath>
#include <deque>
#include <vector>

#include "LanternRenderer/View.h"
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
	/// Rays: how the sun's rays are traced in this frame. View: of this frame. After the scene's BeginUpdate.
	FFound Find(FRTScene& Scene, const FSunRays& Rays, const FView& View);

	/// How long FindRecent reports a change, seconds. A filter needs some frames to see that its history is wrong.
	static constexpr double RecentSeconds = 0.13;
	struct FRecent
	{
		bool bAnywhere = false;            ///< any shadow may have moved
		std::vector<FMovedCaster> Casters; ///< empty with bAnywhere
		double QuietSeconds = 0.0;         ///< of lamps: since when nothing has changed; infinite: never in the view's time
	};
	/// Finds what may have changed in the last RecentSeconds. As Find.
	FRecent FindRecent(FRTScene& Scene, const FSunRays& Rays, const FView& View);
	/// As FindRecent, for the light of lamps. A lamp that has changed may have changed all. bHighlights: they move with the camera's place, and
	/// stay where they are when it turns.
	FRecent FindRecentOfLamps(FRTScene& Scene, bool bHighlights, const FView& View);
	/// Finds the objects that have moved or look otherwise, whatever has changed of lights: one caster for each of either. If they are more
	/// than SETTLED_MOST_CASTERS, finds those that hide or shine most of what the camera sees. As FindRecent.
	FRecent FindMovers(FRTScene& Scene, const FView& View);
	/// Returns whether a lamp has changed since the view's last frame, or there is none. As Find.
	bool HaveLampsChanged(FRTScene& Scene, const FView& View);
	/// As HaveLampsChanged, for emissive triangles.
	bool HaveEmittersChanged(FRTScene& Scene, const FView& View);
	/// Returns how many slots of lights a view notes: Slots at least, and seldom another number than in the frame before.
	uint32_t GetLampRoom(uint32_t Slots);
	/// Counts the view's submitted frames.
	uint32_t GetTurn() const { return Turn; }
	/// bSubmitted: false if the frame never runs; the next frame then finds its changes again.
	void EndFrame(bool bSubmitted);

private:
	/// What the shadows of a frame depend on beside the casters.
	struct FSunState
	{
		uint64_t Scene = 0;      ///< its identity
		glm::dvec3 Direction{0}; ///< unit length
		FSunRays Rays;
	};
	/// From where surfaces are seen.
	struct FEye
	{
		glm::dvec3 Position{0};
		glm::vec3 Direction{0}; ///< orthographic views only
		friend bool operator==(const FEye&, const FEye&) = default;
	};
	struct FState
	{
		FSunState Sun;
		uint64_t Changes = 0; ///< FCasterChanges::GetCount
		bool bValid = false;
		float DeltaSeconds = 0.0f;
		uint64_t Lights = 0;     ///< FLightStore::GetChangeCount
		uint64_t Emitters = 0;   ///< FRTScene::GetEmissiveChangeCount
		uint64_t Appearance = 0; ///< FAppearanceChanges::GetObjects
		double Time = 0.0;       ///< of the view's submitted frames, seconds
		FEye Eye;
	};
	static FSunState MakeSunState(FRTScene& Scene, const FSunRays& Rays);
	static bool HoldsFor(const FSunState& Before, const FSunState& Now);
	static std::vector<FMovedCaster> Convert(FRTScene& Scene, const std::vector<FCasterChange>& Changes);
	void AddRecentMoves(FRTScene& Scene, FRecent& InOut) const;
	void Note(FRTScene& Scene, const FSunRays& Rays, const FView& View);

	FState Last, Next;
	std::deque<FState> Recent; ///< of the last frames, the oldest first; the last one is Last
	uint32_t Turn = 0;
	uint32_t LampRoom = 0;
	double Time = 0.0;
	double ChangeTime = -INFINITY, EyeTime = -INFINITY; ///< of the last changes of casters or lamps, and of the camera's place
};

/// Where shadows of the sun, or of lamps, may have changed in the last frames.
struct FShadowChanges
{
	bool bKnown = false;  ///< false: anywhere, and what needs to know looks at the picture
	uint64_t Casters = 0; ///< FMovedCaster[CasterCount], of this frame; with bKnown
	uint32_t CasterCount = 0;
	float Spread = 0.0f;       ///< of a half shadow's border, metres per metre; not of lamps
	double QuietSeconds = 0.0; ///< see FMovedCasters::FRecent
};
/// r.RT.Shadow.KnownChanges. False: an error, which the context has.
bool FindShadowChanges(FFrameContext& Context, const FSunRays& Rays, FShadowChanges& Out);
/// As FindShadowChanges, for the light of lamps. Many casters of many lamps count as anywhere, since each tile looks at all of either.
/// bHighlights: see FMovedCasters::FindRecentOfLamps.
bool FindLampChanges(FFrameContext& Context, bool bHighlights, FShadowChanges& Out);
/// Finds and writes the frame's movers. None: nothing has moved, nobody knows what has, or an error, which the context has.
const FMoversOfFrame& RequireMovers(FFrameContext& Context);
/// Writes casters where this frame's shaders read them. OutAddress: 0 if there are none. False: an error, which the context has.
bool WriteCasters(FFrameContext& Context, const std::vector<FMovedCaster>& Casters, uint64_t& OutAddress);

} // namespace Lantern
