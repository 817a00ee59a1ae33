// A sphere light over a floor.
#include <cmath>

#include <glm/gtc/constants.hpp>

#include "Builtin/Tests/TestParts.h"
#include "Builtin/Tests/TestScenes.h"

namespace Lantern::Builtin
{

FSceneDescription BuildSphereLight(float Distance, float AngleDegrees)
{
	constexpr double Radius = 0.5;
	FSceneBuilder Builder("spherelight");
	AddFloor(Builder, FloorAlbedo);
	FMeshBuilder Mesh("emitter");
	Mesh.BeginSection(AddEmitter(Builder));
	Mesh.AddSphere(glm::vec3(0), 1.0f, 5);
	// By Cauchy's formula a convex body shows a quarter of its area on average: equal area, equal light.
	Mesh.Scale(float(Radius * std::sqrt(4.0 * glm::pi<double>() / Mesh.ComputeArea())));
	const float Angle = glm::radians(AngleDegrees);
	Builder.AddNode("emitter", Builder.AddMesh(Mesh), Distance * glm::vec3(std::sin(Angle), std::cos(Angle), 0));
	Builder.AddCamera({-0.1, 0.2, 0.3}, {0, 0, 0}, PointFov);
	Darken(Builder);
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
