// A wall of quads with a material each.
#include "Builtin/SceneBuilder.h"
#include "Builtin/Stability/StabilityScenes.h"

namespace Lantern::Builtin
{

FSceneDescription BuildStabilityMaterials()
{
	FSceneBuilder Builder("stability-materials");
	constexpr int Columns = 20, Rows = 10;
	FMeshBuilder Quad("quad");
	Quad.BeginSection(0);
	Quad.AddUnitQuad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
	const int32_t Mesh = Builder.AddMesh(Quad);
	for (int I = 0; I < Columns * Rows; ++I)
	{
		const int32_t Material = Builder.AddLambert("quad", {float(I % Columns) / Columns, float(I / Columns) / Rows, 0.5f});
		const int32_t Node = Builder.AddNode("quad", Mesh, {float(I % Columns), float(I / Columns), 0});
		Builder.Scene.Nodes[size_t(Node)].Materials = {Material};
	}
	Builder.AddCamera({10, 5, 12}, {10, 5, 0}, 50);
	Builder.SetLight({0, -0.3f, -1}, 4.0f, glm::vec3(1));
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
