// A glowing cube that crosses a striped wall: histories must not trail.
#include "Builtin/Stability/StabilityParts.h"
#include "Builtin/Stability/StabilityScenes.h"

namespace Lantern::Builtin
{

FSceneDescription BuildStabilityGhost(bool bLamp)
{
	FSceneBuilder Builder("stability-ghost");
	AddGround(Builder, AddPaint(Builder, "floor", glm::vec3(0.5f), 0.3f), 12.0f);
	const int32_t Light = AddPaint(Builder, "light stripe", glm::vec3(0.7f), 0.5f),
	              Dark = AddPaint(Builder, "dark stripe", glm::vec3(0.2f), 0.5f);
	AddStripes(Builder, "wall", Light, Dark, {0, 1.5f, -2}, {0, 0, 1}, 12.0f, 3.0f, 0.3f);
	FMeshBuilder Cube("cube");
	Cube.BeginSection(Builder.AddLambert("glow", glm::vec3(0.5f), {6.0f, 4.0f, 2.0f}));
	Cube.AddBox(glm::vec3(-0.4f), glm::vec3(0.4f));
	const int32_t Node = Builder.AddNode("cube", Builder.AddMesh(Cube), {-5, 0.5f, -1.4f});
	AddKeys(Builder, Node, EAnimationPath::Translation, 2.0f, {{-5, 0.5f, -1.4f, 0}, {5, 0.5f, -1.4f, 0}});
	Builder.AddCamera({0, 1.9, 2.6}, {0, 0.6, -1.6}, 50);
	Builder.SetLight({-0.9f, -0.7f, -0.8f}, 4.0f, {0.5f, 0.7f, 1.0f}); // the shadow trails
	Builder.Scene.DefaultSunDiameter = 2.0f;
	if (bLamp) { LightByLamp(Builder, {0, 0.5f, -1.6f}, 14.0f); }
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
