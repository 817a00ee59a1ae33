// The inside of a diffuse sphere around a point light.
#include <cmath>

#include <glm/gtc/constants.hpp>

#include "Builtin/Tests/TestParts.h"
#include "Builtin/Tests/TestScenes.h"

namespace Lantern::Builtin
{

FSceneDescription BuildSphere(float Albedo)
{
	constexpr double Area = 96.0, Flux = 10000.0;
	FSceneBuilder Builder("sphere");
	FMeshBuilder Mesh("sphere");
	Mesh.BeginSection(Builder.AddLambert("wall", glm::vec3(Albedo)));
	Mesh.AddSphere(glm::vec3(0), 1.0f, 6, true);
	// The triangles' area, not the sphere's: the inscribed polyhedron is a little smaller.
	Mesh.Scale(float(std::sqrt(Area / Mesh.ComputeArea())));
	Builder.AddNode("sphere", Builder.AddMesh(Mesh));
	Builder.AddPointLight("light", glm::vec3(0), glm::vec3(float(Flux / (4.0 * glm::pi<double>()))));
	Builder.AddCamera({0, 0.4, 1.5}, {0, 0, -1}, 60);
	Darken(Builder);
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
