// A cube that flies past a flat and a convex mirror.
#include "Builtin/Stability/StabilityParts.h"
#include "Builtin/Stability/StabilityScenes.h"

namespace Lantern::Builtin
{

FSceneDescription BuildStabilityMirror()
{
	FSceneBuilder Builder("stability-mirror");
	AddGround(Builder, AddPaint(Builder, "floor", glm::vec3(0.45f), 0.5f), 14.0f);
	const int32_t Light = AddPaint(Builder, "light stripe", {0.7f, 0.65f, 0.55f}, 0.6f),
	              Dark = AddPaint(Builder, "dark stripe", {0.2f, 0.25f, 0.35f}, 0.6f);
	AddStripes(Builder, "wall behind", Light, Dark, {0, 1.5f, 4.5f}, {0, 0, -1}, 14.0f, 3.0f, 0.5f);
	AddBoxNode(Builder, "wall", AddPaint(Builder, "wall", {0.5f, 0.45f, 0.4f}, 0.7f), {-4, 0, -2.4f}, {4, 3.2f, -2.1f});
	const int32_t Silver = AddMetal(Builder, "silver", glm::vec3(0.95f), 0.0f);
	AddBoxNode(Builder, "mirror", Silver, {-2.8f, 0.5f, -2.1f}, {0.0f, 2.5f, -2.05f});
	FMeshBuilder Ball("ball");
	Ball.BeginSection(Silver);
	Ball.AddSphere(glm::vec3(0), 0.9f, 5);
	Builder.AddNode("convex mirror", Builder.AddMesh(Ball), {1.4f, 1.1f, -1.1f});
	FMeshBuilder Cube("mover");
	Cube.BeginSection(AddPaint(Builder, "mover", {0.9f, 0.35f, 0.1f}, 0.5f));
	Cube.AddBox(glm::vec3(-0.3f), glm::vec3(0.3f));
	const glm::vec4 From(-3, 0.7f, 0.6f, 0), To(3, 0.7f, 0.6f, 0);
	const int32_t Node = Builder.AddNode("mover", Builder.AddMesh(Cube), glm::vec3(From));
	AddKeys(Builder, Node, EAnimationPath::Translation, 1.5f, {From, To});
	Builder.AddCamera({0, 1.7, 3.6}, {-0.2, 1.2, -2}, 50);
	Builder.SetLight({-0.3f, -1, -0.35f}, 4.0f, {0.5f, 0.7f, 1.0f});
	Builder.Scene.DefaultSunDiameter = 1.0f;
	Builder.Scene.DefaultExposure = -0.7f;
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
