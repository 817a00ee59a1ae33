#include "Builtin/Courtyard.h"

#include "Builtin/CourtyardMaterials.h"
#include "Builtin/CourtyardParts.h"
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
	Builder.AddCamera({6.4, 1.85, 7.6}, {-2.4, 2.15, -3.0}, 52);
	// Low in the west, so that the open loggia throws its arches across the floor.
	Builder.SetLight({0.66f, -0.50f, -0.36f}, 6.0f, {0.38f, 0.55f, 0.85f});
	Builder.Scene.DefaultExposure = 0.3f;
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
