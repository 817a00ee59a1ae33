// 640 equal lamps in a grid over a flat floor.
#include "Builtin/Stability/StabilityParts.h"
#include "Builtin/Stability/StabilityScenes.h"

namespace Lantern::Builtin
{

FSceneDescription BuildStabilityLightGrid(float Range)
{
	FSceneBuilder Builder("stability-lightgrid");
	AddGround(Builder, Builder.AddLambert("floor", glm::vec3(0.5f)), 120.0f);
	for (int I = 0; I < 640; ++I)
	{
		Builder.AddPointLight("lamp", {-19.5f + float(I % 32) * 1.25f, 2.0f, -11.875f + float(I / 32) * 1.25f}, glm::vec3(1.0f), Range);
	}
	Builder.AddCamera({0, 7, 15}, {0, 0, -1}, 60);
	SetDarkness(Builder, -1.0f);
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
