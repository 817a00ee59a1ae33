// Scenes in which light that comes round corners leaks where none should be, or is too noisy to stylise.
#include <cmath>

#include <glm/gtc/quaternion.hpp>

#include "Builtin/Stability/StabilityLaterScenes.h"
#include "Builtin/Stability/StabilityParts.h"
#include "Builtin/Stability/StabilityRoom.h"

namespace Lantern::Builtin
{

FSceneDescription BuildStabilityEdge(float Distance)
{
	FSceneBuilder Builder("stability-edge");
	AddGround(Builder, Builder.AddLambert("ground", glm::vec3(0.04f)), 400.0f, -17.0f);
	AddBoxNode(Builder, "top", Builder.AddLambert("table", {0.7f, 0.6f, 0.45f}), {-1.2f, 0, -1.2f}, {1.2f, 0.25f, 0});
	AddBoxNode(Builder, "mast", Builder.AddLambert("mast", glm::vec3(0.1f)), {-0.1f, -17, -0.7f}, {0.1f, 0, -0.5f});
	Builder.AddCamera(double(Distance) * glm::normalize(glm::dvec3(0.15, -0.27, 1)), {0, 0, 0}, 45);
	Builder.SetLight({-0.2f, -0.6f, -1}, 4.0f, glm::vec3(0));
	return std::move(Builder.Scene);
}

FSceneDescription BuildStabilityTemple()
{
	FSceneBuilder Builder("stability-temple");
	const int32_t Stone = Builder.AddLambert("stone", glm::vec3(0.85f));
	AddGround(Builder, Builder.AddLambert("sand", {0.6f, 0.5f, 0.35f}), 60.0f, -0.25f);
	// Light enters at the front, goes round the inner room to its door at the back, and past a screen behind that: each of
	// these is a corner that no straight line takes.
	AddRoom(Builder, Stone, {-5.2f, 0, -5.2f}, {5.2f, 4.6f, 5.2f}, {EOpening::Front, 0, 2.2f, 0, 4.2f});
	AddRoom(Builder, Stone, {-3, 0.2f, -3}, {3, 3.8f, 3}, {EOpening::Back, -1.3f, 1.2f, 0.2f, 3.4f});
	AddBoxNode(Builder, "screen", Stone, {-3.1f, 0.1f, -1.4f}, {1.7f, 3.9f, -1.2f});
	AddBoxNode(Builder, "altar", Builder.AddLambert("altar", {0.75f, 0.35f, 0.25f}), {-1.4f, 0.2f, 0.6f}, {-0.4f, 1.2f, 1.4f});
	Builder.AddCamera({2.4, 1.9, 0.0}, {-1.2, 1.1, 1.8}, 65);
	Builder.SetLight({0.1f, -0.7f, -1}, 8.0f, glm::vec3(0));
	Builder.Scene.DefaultExposure = 9.0f;
	return std::move(Builder.Scene);
}

FSceneDescription BuildStabilityToon()
{
	FSceneBuilder Builder("stability-toon");
	const int32_t White = Builder.AddLambert("white", glm::vec3(0.75f));
	AddRoom(Builder, White, {-3, 0, -3}, {3, 3, 3}, {EOpening::Front, -1.6f, 0.9f, 0.6f, 2.4f});
	// Between the window and what the camera sees: only light from walls comes past it.
	AddBoxNode(Builder, "screen", White, {-3, 0, 1.3f}, {0.4f, 2.6f, 1.4f});
	FMeshBuilder Ball("ball");
	Ball.BeginSection(Builder.AddLambert("ball", {0.8f, 0.45f, 0.35f}));
	Ball.AddSphere({0, 0, 0}, 0.75f, 4);
	Builder.AddNode("ball", Builder.AddMesh(Ball), {-0.9f, 0.75f, -1.1f});
	FMeshBuilder Vase("vase");
	Vase.BeginSection(Builder.AddLambert("vase", {0.4f, 0.6f, 0.75f}));
	std::vector<glm::vec2> Profile;
	for (int I = 0; I <= 24; ++I)
	{
		const float Height = 1.6f * float(I) / 24;
		Profile.emplace_back(0.38f + 0.18f * std::sin(3.6f * Height), Height);
	}
	Vase.AddLathe(Profile, 48);
	Vase.AddDisk({0, 1.6f, 0}, {0, 1, 0}, Profile.back().x, 48);
	Builder.AddNode("vase", Builder.AddMesh(Vase), {1.0f, 0, -1.4f});
	Builder.AddCamera({0.9, 1.5, 1.1}, {-0.1, 0.9, -1.6}, 75);
	Builder.SetLight({0.25f, -0.5f, -1}, 6.0f, {0.5f, 0.6f, 0.8f});
	Builder.Scene.DefaultExposure = 3.0f;
	return std::move(Builder.Scene);
}

FSceneDescription BuildStabilityFog()
{
	FSceneBuilder Builder("stability-fog");
	const int32_t Wall = Builder.AddLambert("wall", glm::vec3(0.3f));
	AddRoom(Builder, Wall, {-4, 0, -6}, {4, 5, 6}, {EOpening::Front, -1.5f, 0.8f, 2.6f, 4.4f});
	// From wall to wall: what is behind it is sealed.
	AddBoxNode(Builder, "inner wall", Wall, {1.6f, -0.1f, -6.1f}, {1.8f, 5.1f, 6.1f});
	AddBoxNode(Builder, "block", Wall, {-2.6f, 0, -2.6f}, {-1.2f, 1.2f, -1.2f});
	FMeshBuilder Board("board");
	Board.BeginSection(Builder.AddLambert("board", {0.35f, 0.25f, 0.15f}));
	Board.AddBox({-0.5f, -1.2f, -0.05f}, {0.5f, 1.2f, 0.05f});
	const glm::vec3 From(-3.2f, 3.5f, 6.6f), To(0.2f, 3.5f, 6.6f);
	const int32_t Node = Builder.AddNode("board", Builder.AddMesh(Board), From);
	AddKeys(Builder, Node, EAnimationPath::Translation, 2.0f, {glm::vec4(From, 0), glm::vec4(To, 0), glm::vec4(From, 0)});
	Builder.AddCamera({0.9, 1.6, -5.4}, {-1.6, 2.0, 2.5}, 75);
	Builder.SetLight({0.05f, -0.55f, -1}, 30.0f, glm::vec3(0.2f));
	Builder.Scene.DefaultExposure = 2.5f;
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
