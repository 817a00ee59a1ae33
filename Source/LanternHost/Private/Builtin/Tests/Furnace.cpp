// The furnace: a closed room that emits everywhere.
#include "Builtin/Tests/TestParts.h"
#include "Builtin/Tests/TestScenes.h"

namespace Lantern::Builtin
{

FSceneDescription BuildFurnace(float Albedo)
{
	FSceneBuilder Builder("furnace");
	FMeshBuilder Mesh("room");
	Mesh.BeginSection(Builder.AddLambert("glow", glm::vec3(Albedo), glm::vec3(0.5f)));
	Mesh.AddBox({-2, 0, -2}, {2, 3, 2}, true);
	Mesh.AddBox({-1.2f, 0, -1.4f}, {-0.2f, 1.6f, -0.4f});
	Mesh.AddBox({0.4f, 0.5f, -1.0f}, {1.2f, 1.3f, -0.2f});
	Builder.AddNode("room", Builder.AddMesh(Mesh));
	Builder.AddCamera({0.3, 1.6, 1.7}, {0, 0.9, -1}, 70);
	Darken(Builder);
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
