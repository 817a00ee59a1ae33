// What makes the light of radiance cells old: the sun, the sky, lamps and materials of many objects that change. The scene tells; nothing is guessed from pictures.
// Objects that move or look otherwise are told apart (RequireMovers).
#pragma once

#include <array>
#include <map>
#include <vector>

#include "LanternScene/Scene/Scene.h"
#include "RadianceCellTypes.h"

namespace Lantern
{

/// r.RT.Debug.GI.Events. Render thread.
bool AreIndirectChangesTold();

/// Belongs to one view. Render thread. A frame: Find, if it keeps radiance cells → EndFrame.
class FRadianceEvents
{
public:
	struct FFound
	{
		/// Frames over which cells anywhere may average; large if nothing but time limits it.
		float Window = 1.0e9f;
		bool bHurry = false; ///< more updates than usual are worth their time
		/// Lamps that have changed, relative to the scene's origin. Of more than RADIANCE_CELL_MOST_EVENTS those that bring most to the
		/// camera.
		std::vector<FRadianceEvent> Lamps;
	};
	/// Finds what has changed since the view's last frame, and what did so less than HoldSeconds ago. DeltaSeconds: since that frame.
	/// Camera: in the world. SkyChange: FWorldOfFrame's.
	FFound Find(FRTScene& Scene, const glm::dvec3& Camera, float DeltaSeconds, double SkyChange);
	/// Counts the frames of a table of cells. bFresh: it begins anew. Returns those before this one.
	uint32_t CountFrames(bool bFresh) { return Frames = bFresh ? 0 : Frames + 1; }
	/// Returns whether anything has changed within LivelySeconds. bNow: something has changed in this frame, or did so of late.
	bool HasChangedLately(bool bNow)
	{
		if (bNow) { ChangedAt = Time; }
		return Time - ChangedAt < LivelySeconds;
	}
	/// bSubmitted: false if the frame never runs; the next one then finds its changes again.
	void EndFrame(bool bSubmitted);

	static constexpr double HoldSeconds = 0.25;  ///< cells and filters take some frames to follow
	static constexpr uint32_t LeastWindow = 4;   ///< frames
	static constexpr double LivelySeconds = 2.0; ///< light goes from cell to cell for so long after a change

private:
	struct FLight
	{
		uint64_t Scene = 0; ///< identity
		glm::dvec3 SunDirection{0, -1, 0};
		glm::vec3 Sun{0}, Sky{0};
		uint64_t Lamps = 0;       ///< place in the journal of lights
		uint64_t Appearances = 0; ///< FAppearanceChanges::GetObjects
		double Surfaces = 0.0;    ///< FAppearanceChanges::GetEverywhere
		bool bValid = false;
	};
	/// A change of all light.
	struct FEvent
	{
		float Window = LeastWindow;
		double Until = 0.0;
	};
	struct FLampEvent
	{
		FLightChange Change;
		double Until = 0.0;
	};
	/// By slot and metre of the world: what a lamp leaves and where it comes to are apart.
	using FLampEvents = std::map<std::array<int64_t, 4>, FLampEvent>;
	/// Weight: of what Events has of the lamp.
	static FLampEvent Join(const FLampEvents& Events, const FLampEvents::key_type& Key, const FLampEvent& Event, double Weight = 1.0);
	void FindLampEvents(const FRTScene& Scene);
	std::vector<FRadianceEvent> MakeLampEvents(const FRTScene& Scene, const glm::dvec3& Camera) const;

	FLight Last, Next;
	std::vector<FEvent> Kept, Fresh; ///< of frames before, and of this one
	FLampEvents KeptLamps, FreshLamps;
	double Time = 0.0; ///< of the view's submitted frames, seconds
	double ChangedAt = -LivelySeconds;
	double Delta = 0.0;
	uint32_t Frames = 0;
};

} // namespace Lantern
