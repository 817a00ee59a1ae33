// Camera paths for any scene, and scripts along them: what methods are measured on.
//
//   still   the view stands, the world stands; then the light is switched
//   slow    the view moves sideways about what it looks at and arrives home, a tenth as fast as
//   fast    which takes 0.6 s for all of the way (and begins where it must to arrive with the last timed frame); the
//           scene's time runs. Then all stands still for 4 frames
//   cut     another view, which stands, then a cut to the home view; the world stands
//
// Every path ends at the home view at the same time of the scene, so that all share one reference.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "LanternMeasure/MeasureSequence.h"

namespace Lantern
{

enum class EMeasurePath : uint8_t
{
	Still,
	Slow,
	Fast,
	Cut,
	Count,
};
const char* GetPathName(EMeasurePath Path); ///< "still"
std::optional<EMeasurePath> FindPath(std::string_view Name);

/// Nearest hits of rays with a scene's triangles, skinned ones as the pose bends them, alpha ignored: one after another,
/// for a few hundred rays.
class FSceneRays
{
public:
	FSceneRays(const FSceneDescription& Scene, const FScenePose& Pose);
	/// Distance in lengths of Direction; infinity where nothing is hit.
	double Trace(glm::dvec3 Origin, glm::dvec3 Direction) const;

private:
	struct FInstance
	{
		const FHostMesh* Mesh = nullptr;
		const std::vector<glm::vec3>* Positions = nullptr; // of Mesh, or of Bent
		glm::dmat4 ToLocal{1};
		glm::dvec3 Min{0}, Max{0}; // local
	};
	std::vector<FInstance> Instances;
	std::vector<std::unique_ptr<std::vector<glm::vec3>>> Bent;
};

struct FMeasureViews
{
	FView Home;
	FView Cut;             ///< sees other things, or the same from elsewhere
	glm::dvec3 Focus{0};   ///< what Home looks at: the median distance of what its middle sees
	glm::dvec3 Travel{0};  ///< from Home to where the fast path begins; at most 0.4 of the distance to Focus, and at most half
	                       ///< of the free way, so that no path passes through anything
	double PanRadians = 0; ///< where there is no room to move: the view turns by so much instead
	/// Way: 0 is home, 1 the beginning of the fast path.
	FView GetView(double Way) const;
};
FMeasureViews FindMeasureViews(const FSceneDescription& Scene, const FScenePose& Pose, const FView& Home);

/// Switches the light of a scene between frames. On: as it was when it was made; off: the sun turned by 60° over the
/// zenith (it never sets) or, in a scene without a sun, its punctual lights off.
class FLightSwitch
{
public:
	explicit FLightSwitch(FHostScene& Scene);
	bool CanSwitch() const { return bSun || bLights; }
	void Set(FHostScene& Scene, bool bSwitched) const;

private:
	bool bSun = false, bLights = false;
	FSunLight Before, After;
};

struct FPathSettings
{
	double Time = 1.0; ///< of the scene, at home
	float DeltaSeconds = 1.0f / 60.0f;
	uint32_t WarmUp = 16;       ///< frames that are neither timed nor judged
	uint32_t Frames = 20;       ///< timed ones; > SettleFrames
	uint32_t SwitchFrames = 60; ///< watched at most after the light switch; 0: no switch
};

/// A script and what its frames are for.
struct FPathScript
{
	static constexpr uint32_t SettleFrames = 4; ///< after which ghosts are looked for
	FScript Script;
	uint32_t FirstTimed = 0, TimedCount = 0;
	std::vector<uint32_t> ErrorFrames; ///< seen from home, with the light on: all have the reference of PictureFrame
	uint32_t PictureFrame = 0;         ///< the last of them
	/// Whose reference a ghost would look like; not of the slow path, on which frames differ too little …
	std::optional<uint32_t> BeforeFrame;
	std::optional<uint32_t> GhostFrame;    ///< … in this frame
	std::optional<uint32_t> FirstSwitched; ///< from here to the end: the light is switched
	bool bStill = false;                   ///< nothing changes from one of ErrorFrames to the next
};
/// Switch: null: none. It must outlive the script.
FPathScript MakePathScript(EMeasurePath Path, const FMeasureViews& Views, const FPathSettings& Settings, const FLightSwitch* Switch);

} // namespace Lantern
