// Scenes in which something moves, or the camera does.
#include <cmath>

#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>

#include "Builtin/Stability/StabilityParts.h"
#include "Builtin/Stability/StabilityScenes.h"

namespace Lantern::Builtin
{

FSceneDescription BuildStabilityPoles()
{
	FSceneBuilder Builder("stability-poles");
	AddGround(Builder, AddPaint(Builder, "floor", glm::vec3(0.5f), 0.4f), 12.0f);
	const int32_t Light = AddPaint(Builder, "light stripe", {0.75f, 0.7f, 0.6f}, 0.5f),
	              Dark = AddPaint(Builder, "dark stripe", {0.25f, 0.3f, 0.4f}, 0.5f);
	for (const glm::vec3& Side : {glm::vec3(0, 0, -1), glm::vec3(0, 0, 1), glm::vec3(-1, 0, 0), glm::vec3(1, 0, 0)})
	{
		AddStripes(Builder, "wall", Light, Dark, 6.0f * Side + glm::vec3(0, 1.5f, 0), -Side, 12.0f, 3.0f, 0.6f);
	}
	// Channels, open towards the camera: dark inside, so that it shows on the wall if they are taken for it.
	FMeshBuilder Pole("pole");
	Pole.BeginSection(AddPaint(Builder, "pole", {0.6f, 0.25f, 0.2f}, 0.6f));
	Pole.AddBox({-0.15f, 0, 0.15f}, {0.15f, 3, 0.17f});
	Pole.AddBox({-0.15f, 0, -0.15f}, {-0.13f, 3, 0.15f});
	Pole.AddBox({0.13f, 0, -0.15f}, {0.15f, 3, 0.15f});
	const int32_t PoleMesh = Builder.AddMesh(Pole);
	constexpr int Count = 20;
	for (int I = 0; I < Count; ++I)
	{
		const float Angle = glm::two_pi<float>() * (float(I) + 0.5f) / Count;
		Builder.AddNode("pole", PoleMesh, {3.0f * std::sin(Angle), 0, 3.0f * std::cos(Angle)}, Angle);
	}
	Builder.AddCamera({0, 1.5, 0}, {0, 1.3, -6}, 50);
	Builder.SetLight({0.35f, -1, -0.6f}, 4.0f, {0.5f, 0.7f, 1.0f});
	Builder.Scene.DefaultSunDiameter = 2.0f;
	return std::move(Builder.Scene);
}

FSceneDescription BuildStabilityGhost()
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
	return std::move(Builder.Scene);
}

FSceneDescription BuildStabilityFan()
{
	FSceneBuilder Builder("stability-fan");
	AddGround(Builder, AddPaint(Builder, "floor", glm::vec3(0.6f), 0.3f), 12.0f);
	FMeshBuilder Fan("fan");
	Fan.BeginSection(AddPaint(Builder, "blade", {0.3f, 0.3f, 0.35f}, 0.5f));
	for (int I = 0; I < 4; ++I)
	{
		Fan.SetTransform(glm::mat4_cast(glm::angleAxis(glm::half_pi<float>() * float(I), glm::vec3(0, 1, 0))));
		Fan.AddBox({0.1f, -0.01f, -0.16f}, {1.1f, 0.01f, 0.16f});
	}
	const int32_t Node = Builder.AddNode("fan", Builder.AddMesh(Fan), {0, 1.6f, 0});
	std::vector<glm::vec4> Turns;
	for (int I = 0; I <= 4; ++I)
	{
		Turns.emplace_back(0, std::sin(glm::pi<float>() * float(I) / 4), 0, std::cos(glm::pi<float>() * float(I) / 4));
	}
	AddKeys(Builder, Node, EAnimationPath::Rotation, 1.0f, std::move(Turns));
	Builder.AddCamera({0, 1.3, 2.4}, {0, 0, 0.1}, 60);
	Builder.SetLight({0.05f, -1, 0.1f}, 4.0f, {0.3f, 0.4f, 0.6f});
	Builder.Scene.DefaultSunDiameter = 2.0f;
	return std::move(Builder.Scene);
}

FSceneDescription BuildStabilityLid()
{
	FSceneBuilder Builder("stability-lid");
	AddGround(Builder, AddPaint(Builder, "floor", glm::vec3(0.6f), 0.3f), 10.0f);
	AddBoxNode(Builder, "wall", AddPaint(Builder, "wall", {0.7f, 0.5f, 0.4f}, 0.6f), {-3, 0, -2.2f}, {3, 2, -2});
	AddBoxNode(Builder, "lid", AddPaint(Builder, "lid", {0.3f, 0.4f, 0.6f}, 0.5f), {-1.6f, 0.35f, -1.6f}, {1.6f, 0.45f, 0.9f});
	Builder.AddCamera({0, 0.9, 3.2}, {0, 0.05, 0}, 45);
	Builder.SetLight({0.1f, -1, -0.1f}, 4.0f, {0.6f, 0.8f, 1.0f});
	Builder.Scene.DefaultSunDiameter = 2.0f;
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
