#include "Builtin/Courtyard.h"

#include "Builtin/SceneBuilder.h"

namespace Lantern::Builtin
{

FSceneDescription BuildCourtyard()
{
	FSceneBuilder Builder("courtyard");
	FMeshBuilder Mesh("box");
	Mesh.BeginSection(Builder.AddLambert("stone", glm::vec3(0.6f)));
	Mesh.AddBeveledBox({-1, 0, -1}, {1, 2, 1}, 0.05f);
	Mesh.AddQuad({-9, 0, 9}, {9, 0, 9}, {9, 0, -9}, {-9, 0, -9});
	Builder.AddNode("box", Builder.AddMesh(Mesh));
	Builder.AddCamera({4, 3, 8}, {0, 1, 0}, 50);
	Builder.SetLight({0.25f, -1, 0.35f}, 4.0f, {0.5f, 0.7f, 1.0f});
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
