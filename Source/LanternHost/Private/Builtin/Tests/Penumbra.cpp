// The penumbra of a straight edge.
#include <cmath>

#include <glm/gtc/constants.hpp>

#include "Builtin/Tests/TestParts.h"
#include "Builtin/Tests/TestScenes.h"

namespace Lantern::Builtin
{

FSceneDescription BuildPenumbra(float Height)
{
	constexpr float DiameterDegrees = 0.533f;
	FSceneBuilder Builder("penumbra");
	AddFloor(Builder, 1.0f);
	FMeshBuilder Mesh("occluder");
	Mesh.BeginSection(Builder.AddLambert("occluder", glm::vec3(0)));
	constexpr float S = FloorSize / 2;
	Mesh.AddQuad({-S, Height, S}, {0, Height, S}, {0, Height, -S}, {-S, Height, -S});
	Builder.AddNode("occluder", Builder.AddMesh(Mesh));
	const double Width = 2.0 * Height * std::tan(glm::radians(double(DiameterDegrees)) / 2);
	const double CameraHeight = 0.5 * Height;
	const double FovY = 2.0 * std::atan(2.0 * Width / CameraHeight);
	Builder.AddCamera({0, CameraHeight, 0}, {0, 0, 0}, float(glm::degrees(FovY)), {0, 0, -1});
	Builder.SetLight(Down, glm::pi<float>(), glm::vec3(0));
	Builder.Scene.DefaultSunDiameter = DiameterDegrees;
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
