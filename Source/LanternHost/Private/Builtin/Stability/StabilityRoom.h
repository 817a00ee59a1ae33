// A room whose walls have a thickness.
#pragma once

#include "Builtin/SceneBuilder.h"

namespace Lantern::Builtin
{

/// Six slabs of 20 cm around the space from Min to Max, overlapping at the edges: no light comes in.
void AddRoom(FSceneBuilder& Builder, int32_t Material, const glm::vec3& Min, const glm::vec3& Max);

enum class EOpening : uint8_t
{
	Front,
	Back
}; ///< towards +z, −z

/// The same with an opening in one wall: Half metres to both sides of the wall's middle at X, from Bottom to Top.
struct FOpening
{
	EOpening Side = EOpening::Front;
	float X = 0.0f, Half = 0.5f, Bottom = 0.0f, Top = 2.0f;
};
void AddRoom(FSceneBuilder& Builder, int32_t Material, const glm::vec3& Min, const glm::vec3& Max, const FOpening& Opening);

} // namespace Lantern::Builtin
