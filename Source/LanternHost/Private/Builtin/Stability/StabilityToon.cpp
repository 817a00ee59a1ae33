// Smooth shapes in indirect light.
#include <cmath>

#include "Builtin/Stability/StabilityParts.h"
#include "Builtin/Stability/StabilityRoom.h"
#include "Builtin/Stability/StabilityScenes.h"

namespace Lantern::Builtin
{

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
	const int32_t BallNode = Builder.AddNode("ball", Builder.AddMesh(Ball), {-0.9f, 0.75f, -1.1f});
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
	const int32_t VaseNode = Builder.AddNode("vase", Builder.AddMesh(Vase), {1.0f, 0, -1.4f});
	Builder.Scene.Nodes[static_cast<size_t>(BallNode)].Toon = FToonStyle{.SphereWeight = 1.0f, .Bend = 0.0f};
	Builder.Scene.Nodes[static_cast<size_t>(VaseNode)].Toon = FToonStyle();
	Builder.AddCamera({0.9, 1.5, 1.1}, {-0.1, 0.9, -1.6}, 75);
	Builder.SetLight({0.25f, -0.5f, -1}, 6.0f, {0.5f, 0.6f, 0.8f});
	Builder.Scene.DefaultExposure = 3.0f;
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
