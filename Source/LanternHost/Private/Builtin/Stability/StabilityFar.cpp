// An open room that may stand far from the origin.
#include "Builtin/Stability/StabilityParts.h"
#include "Builtin/Stability/StabilityScenes.h"

namespace Lantern::Builtin
{

FSceneDescription BuildStabilityFar(float Far)
{
	FSceneBuilder Builder("stability-far");
	const glm::dvec3 Place = double(Far) * glm::dvec3(16'000.0, 500.0, 16'000.0);
	const int32_t Wall = AddPaint(Builder, "wall", {0.7f, 0.65f, 0.6f}, 0.6f);
	AddBoxNode(Builder, "floor", Wall, {-2.37f, -0.2f, -2.37f}, {2.37f, 0, 2.37f});
	AddBoxNode(Builder, "back", Wall, {-2.37f, 0, -2.57f}, {2.37f, 2.71f, -2.37f});
	AddBoxNode(Builder, "side", Wall, {-2.57f, 0, -2.37f}, {-2.37f, 2.71f, 2.37f});
	AddBoxNode(Builder, "roof", Wall, {-2.37f, 2.71f, -2.37f}, {0.13f, 2.81f, 2.37f});
	AddBoxNode(Builder, "crate", AddPaint(Builder, "crate", {0.4f, 0.3f, 0.2f}, 0.4f), {-0.93f, 0, -1.21f}, {0.17f, 1.1f, -0.11f});
	FMeshBuilder Ball("ball");
	// Nothing that focuses light: rare bright paths would hide what is looked for.
	Ball.BeginSection(AddPaint(Builder, "ball", {0.8f, 0.7f, 0.5f}, 0.5f));
	Ball.AddSphere(glm::vec3(0), 0.41f, 4);
	Builder.AddNode("ball", Builder.AddMesh(Ball), {1.13f, 0.41f, 0.37f});
	for (FHostNode& Node : Builder.Scene.Nodes) { Node.Translation += Place; }
	Builder.AddCamera(Place + glm::dvec3(2.77, 2.03, 3.91), Place + glm::dvec3(-0.31, 0.83, -0.53), 55);
	Builder.SetLight({-0.45f, -1, -0.35f}, 4.0f, {0.5f, 0.7f, 1.0f});
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
