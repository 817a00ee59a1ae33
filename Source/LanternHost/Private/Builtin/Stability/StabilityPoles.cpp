// A ring of poles around the camera: disocclusion.
#include <cmath>

#include <glm/gtc/constants.hpp>

#include "Builtin/Stability/StabilityParts.h"
#include "Builtin/Stability/StabilityScenes.h"

namespace Lantern::Builtin
{

FSceneDescription BuildStabilityPoles(bool bLamp)
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
	if (bLamp) { LightByLamp(Builder, {0, 1.5f, 0}, 14.0f); }
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
