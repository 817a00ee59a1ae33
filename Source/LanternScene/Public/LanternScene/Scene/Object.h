// rtObject: a geometry placed in the world, with a material for each section.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "LanternScene/Geometry/Geometry.h"
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

/// Bits of FRTObjectInfo::Mask by convention. Rays of a pass name those that they see.
inline constexpr uint8_t MaskVisible = MASK_VISIBLE;          ///< seen by camera, reflection and GI rays
inline constexpr uint8_t MaskCastsShadow = MASK_CASTS_SHADOW; ///< seen by shadow rays
inline constexpr uint8_t MaskAll = 0xff;

struct FRTObjectInfo
{
	FRTGeometryRef Geometry;
	std::vector<uint32_t> Materials; ///< per section, indices of the scene's materials
	glm::dmat4 Transform{1.0};       ///< object to world, affine, metres
	uint8_t Mask = MaskAll;
	/// > 0: the object is culled together with all objects of this group, by the bounds of the whole group.
	uint32_t Group = 0;
};

} // namespace Lantern
