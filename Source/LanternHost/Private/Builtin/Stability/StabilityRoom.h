// A room whose walls have a thickness.
#pragma once

#include "Builtin/SceneBuilder.h"

namespace Lantern::Builtin
{

/// Adds six slabs of 20 cm around the space from Min to Max. They overlap at the edges, so that no light comes in.
void AddRoom(FSceneBuilder& Builder, int32_t Material, const glm::vec3& Min, const glm::vec3& Max);

enum class EOpening : uint8_t
{
	Front, ///< towards +z
	Back,  ///< towards −z
};

/// An opening in one wall: Half metres to either side of X, from Bottom to Top.
struct FOpening
{
	EOpening Side = EOpening::Front;
	float X = 0.0f, Half = 0.5f, Bottom = 0.0f, Top = 2.0f;
};
void AddRoom(FSceneBuilder& Builder, int32_t Material, const glm::vec3& Min, const glm::vec3& Max, const FOpening& Opening);

} // namespace Lantern::Builtin
