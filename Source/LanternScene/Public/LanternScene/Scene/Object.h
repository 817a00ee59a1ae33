// rtObject: a geometry placed in the world, with a material for each section.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <glm/glm.hpp>

#include "LanternScene/Geometry/Geometry.h"
#include "LanternScene/Scene/ToonStyles.h"
#include "SceneTypes.h"

namespace Lantern
{

/// Names an object of a scene. It is stale after RemoveObject; using it then is an assert.
struct FRTObjectId
{
	uint32_t Index = ~0u;
	uint32_t Generation = 0;
	bool IsValid() const { return Index != ~0u; }
	friend bool operator==(FRTObjectId, FRTObjectId) = default;
};

/// Who sees an object and what it casts shadows on, as a host says it.
struct FRTObjectTraits
{
	bool bVisible = true;          ///< to camera, reflection and GI rays
	bool bCastsShadow = true;      ///< from any light
	bool bCastsLocalShadow = true; ///< from local lights too; not of trees whose lamps should shine through them
	bool bMoves = false;           ///< moves or deforms
	/// A character shadows everything but characters, itself included: seen from the sun or a lamp, faces have no self-shadow.
	bool bCharacter = false;
	/// Lights light it that share a bit with it. They do not change who casts.
	uint8_t Channels = CHANNELS_DEFAULT;
	friend bool operator==(const FRTObjectTraits&, const FRTObjectTraits&) = default;
};

/// Returns the bits of FRTObjectInfo::Mask, MASK_…, that say so. Rays of a pass name those that they see.
constexpr uint8_t MakeObjectMask(const FRTObjectTraits& Traits)
{
	uint32_t Mask = Traits.bVisible ? 0xffu & ~MASK_CASTERS : 0u;
	if (Traits.bCastsShadow && Traits.bCharacter) { return static_cast<uint8_t>(Mask | MASK_CHARACTER); }
	if (Traits.bCastsShadow) { Mask |= Traits.bMoves ? MASK_SUN_MOVING : MASK_SUN; }
	if (Traits.bCastsShadow && Traits.bCastsLocalShadow) { Mask |= MASK_LOCAL; }
	return static_cast<uint8_t>(Mask);
}
inline constexpr uint8_t MaskDefault = MakeObjectMask({});
inline constexpr uint8_t MaskVisible = MASK_VISIBLE;
inline constexpr uint8_t MaskSunCasters = MASK_SUN_CASTERS; ///< rays to the sun
inline constexpr uint8_t MaskCasters = MASK_CASTERS;        ///< rays to any light

struct FRTObjectInfo
{
	FRTGeometryRef Geometry;
	std::vector<uint32_t> Materials; ///< per section, indices of the scene's materials
	glm::dmat4 Transform{1.0};       ///< object to world, affine, metres
	uint8_t Mask = MaskDefault;
	bool bCharacter = false;                ///< characters do not shadow it: FRTObjectTraits
	uint8_t Channels = CHANNELS_DEFAULT;    ///< FRTObjectTraits
	std::shared_ptr<const FToonStyle> Toon; ///< null: light falls on it as on any other
	/// > 0: the object is culled together with all objects of this group, by the bounds of the whole group.
	uint32_t Group = 0;
};

} // namespace Lantern
