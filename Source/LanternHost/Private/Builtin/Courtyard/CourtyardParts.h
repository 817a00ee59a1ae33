// The courtyard's pieces. Each function builds meshes once and places many instances of them. Ground level is y = 0,
// the yard is 7 × 7 bays around the origin, and the galleries around it lie two steps higher.
#pragma once

#include "Builtin/Courtyard/CourtyardMaterials.h"
#include "Builtin/Random.h"
#include "Builtin/SceneBuilder.h"

namespace Lantern::Builtin
{

constexpr int BayCount = 7;
constexpr float BayWidth = 2.4f;
constexpr float YardHalf = BayCount * BayWidth / 2;
constexpr float GalleryDepth = 2.6f;
constexpr float GalleryHeight = 0.3f; ///< floor of the galleries
constexpr float ArcadeTop = 4.5f;     ///< top of the arcade walls, above ground
constexpr float UpperTop = 8.1f;      ///< eaves of the northern wing

struct FCourtyard
{
	FSceneBuilder& Builder;
	const FCourtyardMaterials& M;
};

void BuildGround(const FCourtyard& Yard);      ///< paving, steps, galleries, meadow and hills
void BuildArcades(const FCourtyard& Yard);     ///< columns, arches, balustrade
void BuildWings(const FCourtyard& Yard);       ///< walls, windows, doors, roofs
void BuildFountain(const FCourtyard& Yard);    ///< with its turning armillary sphere
void BuildPlants(const FCourtyard& Yard);      ///< potted trees, cypresses, ivy, flowers, fallen leaves
void BuildFurnishings(const FCourtyard& Yard); ///< lanterns, banners, benches, weather vane

/// Turns a node about its own y axis, once per Seconds.
void AddTurning(FSceneBuilder& Builder, int32_t Node, float Seconds);

} // namespace Lantern::Builtin
