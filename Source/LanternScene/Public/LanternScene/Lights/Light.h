// A light as the scene takes it, in plain units, and its form on the GPU.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "LanternScene/Lights/LightJournal.h"
#include "LightCellTypes.h"

namespace Lantern
{

/// Names a light of a scene. It is stale after RemoveLight; using it then is an assert.
struct FLightId
{
	uint32_t Index = ~0u;
	uint32_t Generation = 0;
	bool IsValid() const { return Index != ~0u; }
	friend bool operator==(FLightId, FLightId) = default;
};

/// Returns what readers of the light mask know a light by. 24 bits are its slot, from 1 on, and 8 how often the slot was used.
inline uint32_t MakeLightNumber(FLightId Id) { return (Id.Index + 1) | Id.Generation << LIGHT_INDEX_BITS; }

/// A light of the scene. All numbers are finite. Area lights are seen by what they light, and not by rays that meet them.
struct FSceneLight
{
	uint32_t Type = LIGHT_POINT;   ///< LIGHT_…, not LIGHT_NONE
	glm::dvec3 Position{0};        ///< of its centre, metres; not of a directional light
	glm::vec3 Direction{0, -1, 0}; ///< in which it shines, length > 0: of directional lights, rectangles, disks, cones and profiles
	/// Rectangle: direction of its width; tube: its axis; profile: horizontal angle 0. Length > 0, and not along Direction for a
	/// rectangle. A profile whose Tangent is along Direction begins anywhere.
	glm::vec3 Tangent{1, 0, 0};
	/// Point: candela; with a profile, those where that has its peak. Directional: lux of a plane that faces it. Others: nits. Not negative.
	glm::vec3 Color{0};
	float Range = 0.0f; ///< metres, at which it fades out (KHR_lights_punctual); 0: unlimited
	/// Angles from Direction at which the light begins to fade, and is dark. 0 ≤ InnerCone < OuterCone ≤ π; OuterCone 0: no cone.
	float InnerCone = 0.0f, OuterCone = 0.0f;
	/// Rectangle: width and height. Disk, sphere: radius, unused. Tube: radius, length of its axis without the rounded ends.
	/// Metres, > 0. Directional: angular diameter, radians, 0 to π. Not of point lights.
	glm::vec2 Size{0};
	bool bCastsShadow = true;
	bool bTwoSided = false; ///< rectangle, disk: it shines to its back as well
	bool bLightsFog = true; ///< fog scatters it
	/// Point: intensity by direction, a number of FRTScene::AddLightProfile; 0: the same in all. It multiplies the cone.
	uint32_t Profile = 0;
	uint32_t Number = 0;                 ///< names it to readers of the light mask; 0: MakeLightNumber of its id
	uint8_t Channels = CHANNELS_DEFAULT; ///< it lights objects that share a bit with it (FRTObjectTraits); fog has none
	friend bool operator==(const FSceneLight&, const FSceneLight&) = default;
};

/// Kinds of lights that have a switch for their shadows. A kind follows from what engines call the light, and not from its extent.
enum class ELightKind : uint8_t
{
	Point,       ///< also spheres and tubes, which engines make of point lights
	Spot,        ///< the same with a cone
	Rect,        ///< rectangles and disks, with a cone or without
	Directional, ///< without a switch
	Count,
};
ELightKind GetLightKind(const FSceneLight& Light);

/// Tells whether shaders sample points of the light: it has an extent.
bool HasExtent(const FSceneLight& Light);

/// Tells whether no distance dims the light to nothing.
bool ReachesEverywhere(const FSceneLight& Light);

/// Returns where the light may bring anything, whichever way it shines.
FLightReach GetReach(const FSceneLight& Light);

/// Tells whether two lights bring something to the same points, though not the same light.
bool ReachAlike(const FSceneLight& A, const FSceneLight& B);

/// Returns the luminance of the light in its brightest direction: candela, from far away; of a directional light lux.
double GetPeakIntensity(const FSceneLight& Light);

/// Compares two states of one light.
FLightChange CompareLights(uint32_t Slot, const FSceneLight& Before, const FSceneLight& After);

/// Returns the light as shaders see it.
FLightData PackLight(const FSceneLight& Light);

} // namespace Lantern
