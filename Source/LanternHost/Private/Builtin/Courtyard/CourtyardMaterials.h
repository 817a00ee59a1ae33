// The materials of the courtyard.
#pragma once

#include "Builtin/SceneBuilder.h"

namespace Lantern::Builtin
{

struct FCourtyardMaterials
{
	int32_t Ashlar, Trim, Plaster, Paving, RoofTile, Earth, Grass;
	int32_t Wood, DarkWood, Iron, Bronze, Terracotta;
	int32_t Water, Spray, Glow, Cloth, ClothBlue;
	int32_t Bark, Leaves, Ivy, Cypress, Flower;
};

FCourtyardMaterials MakeCourtyardMaterials(FSceneBuilder& Builder);

} // namespace Lantern::Builtin
