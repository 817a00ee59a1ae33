// Puts the courtyard together from its parts.
#include "Builtin/Courtyard/Courtyard.h"

#include "Builtin/Courtyard/CourtyardMaterials.h"
#include "Builtin/Courtyard/CourtyardParts.h"
#include "Builtin/SceneBuilder.h"

namespace Lantern::Builtin
{

FSceneDescription BuildCourtyard()
{
	FSceneBuilder Builder("courtyard");
	const FCourtyardMaterials Materials = MakeCourtyardMaterials(Builder);
	const FCourtyard Yard{Builder, Materials};
	BuildGround(Yard);
	BuildArcades(Yard);
	BuildWings(Yard);
	BuildFountain(Yard);
	BuildPlants(Yard);
	BuildFurnishings(Yard);
	Builder.AddCamera({5.9, 1.75, 7.8}, {-1.9, 2.05, -3.0}, 50);
	// Low in the west, so that the open arcade throws its arches across the floor.
	Builder.SetLight({0.70f, -0.50f, -0.30f}, 4.2f, {0.21f, 0.30f, 0.44f});
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
