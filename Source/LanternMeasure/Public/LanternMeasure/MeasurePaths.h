// Camera paths for any scene, and scripts along them, on which methods are measured.
//
//   still   view and world are static; then the light is switched
//   slow    as fast, at a tenth of the speed
//   fast    the view moves sideways about its focus and arrives at the home view. The scene's time runs. The whole way takes
//           0.6 s; the view starts so that it arrives with the last timed frame. Then everything is static for 4 frames
//   cut     another view, static, then a cut to the home view; the world is static
//
// Every path ends at the home view at one time of the scene, so that all paths share one reference.
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

/// Traces rays against a scene's triangles on the CPU, skinned ones in the given pose, without alpha tests. It has no
/// acceleration structure and suits a few hundred rays.
class FSceneRays
{
public:
	FSceneRays(const FSceneDescription& Scene, const FScenePose& Pose);
	/// Returns the distance of the nearest hit, in lengths of Direction; infinity if nothing is hit.
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
	FView Cut;           ///< sees other things, or the same things from elsewhere
	glm::dvec3 Focus{0}; ///< the point that Home looks at, at the median distance of what its middle sees
	/// From Home to the beginning of the fast path. It is at most 0.4 of the distance to Focus, and at most half of the free
	/// way, so that no path passes through anything.
	glm::dvec3 Travel{0};
	double PanRadians = 0; ///< if there is no room to move, the view turns by this angle instead
	/// Way: 0 is home, 1 the beginning of the fast path.
	FView GetView(double Way) const;
};
FMeasureViews FindMeasureViews(const FSceneDescription& Scene, const FScenePose& Pose, const FView& Home);

/// Switches the light of a scene between frames. Not switched: the light as the constructor found it. Switched: the sun turns by
/// 60° over the zenith, so that it never sets. A scene without a sun loses its punctual lights instead.
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
	double Time = 1.0; ///< scene time at the home view, seconds
	float DeltaSeconds = 1.0f / 60.0f;
	uint32_t WarmUp = 16;       ///< frames that are neither timed nor judged
	uint32_t Frames = 20;       ///< timed ones; > SettleFrames
	uint32_t SwitchFrames = 60; ///< maximum watched after the light switch; 0: no switch
};

/// A script and the purpose of its frames.
struct FPathScript
{
	static constexpr uint32_t SettleFrames = 4; ///< after which ghosts are looked for
	FScript Script;
	uint32_t FirstTimed = 0, TimedCount = 0;
	std::vector<uint32_t> ErrorFrames; ///< at the home view, before the light switch: all have the reference of PictureFrame
	uint32_t PictureFrame = 0;         ///< the last of them
	/// The frame that a ghost would look like. Absent on the slow path, on which frames differ too little.
	std::optional<uint32_t> BeforeFrame;
	std::optional<uint32_t> GhostFrame;    ///< the frame in which ghosts are looked for
	std::optional<uint32_t> FirstSwitched; ///< from here to the end: the light is switched
	bool bStill = false;                   ///< nothing changes from one of ErrorFrames to the next
};
/// Makes a path's script. Switch: null for none; it must outlive the script.
FPathScript MakePathScript(EMeasurePath Path, const FMeasureViews& Views, const FPathSettings& Settings, const FLightSwitch* Switch);

} // namespace Lantern
