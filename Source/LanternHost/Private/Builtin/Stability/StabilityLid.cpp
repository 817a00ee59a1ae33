// A slab over a floor, to be taken away.
#include "Builtin/Stability/StabilityParts.h"
#include "Builtin/Stability/StabilityScenes.h"

namespace Lantern::Builtin
{

FSceneDescription BuildStabilityLid(bool bLamp)
{
	FSceneBuilder Builder("stability-lid");
	AddGround(Builder, AddPaint(Builder, "floor", glm::vec3(0.6f), 0.3f), 10.0f);
	AddBoxNode(Builder, "wall", AddPaint(Builder, "wall", {0.7f, 0.5f, 0.4f}, 0.6f), {-3, 0, -2.2f}, {3, 2, -2});
	AddBoxNode(Builder, "lid", AddPaint(Builder, "lid", {0.3f, 0.4f, 0.6f}, 0.5f), {-1.6f, 0.35f, -1.6f}, {1.6f, 0.45f, 0.9f});
	Builder.AddCamera({0, 0.9, 3.2}, {0, 0.05, 0}, 45);
	Builder.SetLight({0.1f, -1, -0.1f}, 4.0f, {0.6f, 0.8f, 1.0f});
	Builder.Scene.DefaultSunDiameter = 2.0f;
	if (bLamp) { LightByLamp(Builder, {0, 0, 0}, 10.0f); }
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
