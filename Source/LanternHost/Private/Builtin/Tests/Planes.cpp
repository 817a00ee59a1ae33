// Single-sided and double-sided planes between sun and floor.
#include "Builtin/Tests/TestParts.h"
#include "Builtin/Tests/TestScenes.h"

namespace Lantern::Builtin
{

FSceneDescription BuildPlanes()
{
	FSceneBuilder Builder("planes");
	AddFloor(Builder, 0.7f);
	const int32_t Single = Builder.AddLambert("single-sided", {0.7f, 0.3f, 0.2f});
	const int32_t Double = Builder.AddLambert("double-sided", {0.2f, 0.4f, 0.7f});
	Builder.Scene.Materials[size_t(Double)].bDoubleSided = true;
	for (int I = 0; I < 3; ++I)
	{
		FMeshBuilder Mesh(I == 0 ? "facing up" : I == 1 ? "facing down" : "double-sided");
		Mesh.BeginSection(I == 2 ? Double : Single);
		const glm::vec3 A(-0.75f, 0, 0.75f), B(0.75f, 0, 0.75f), C(0.75f, 0, -0.75f), D(-0.75f, 0, -0.75f);
		if (I == 1) { Mesh.AddQuad(A, D, C, B); }
		else { Mesh.AddQuad(A, B, C, D); }
		const int32_t MeshIndex = Builder.AddMesh(Mesh);
		Builder.AddNode(Builder.Scene.Meshes.back().Name.c_str(), MeshIndex, {float(I - 1) * 2.5f, 1.5f, 0});
	}
	Builder.AddCamera({0, 4.5, 8}, {0, 0.5, 0}, 45);
	Builder.SetLight({0.25f, -1, 0.35f}, 4.0f, {0.5f, 0.7f, 1.0f});
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
