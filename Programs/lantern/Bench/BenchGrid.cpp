// FBenchGrid: its vertices, and where its objects stand.
#include "Bench/BenchGrid.h"

#include <algorithm>
#include <cmath>

namespace Lantern
{

FBenchGrid::FBenchGrid(uint32_t Triangles)
{
	const auto Side = static_cast<uint32_t>(std::max(1.0, std::sqrt(Triangles / 2.0)));
	for (uint32_t Vertex = 0; Vertex < (Side + 1) * (Side + 1); ++Vertex)
	{
		Positions.insert(Positions.end(), {float(Vertex % (Side + 1)), 0.0f, float(Vertex / (Side + 1))});
	}
	for (uint32_t Quad = 0; Quad < Side * Side; ++Quad)
	{
		const uint32_t A = Quad / Side * (Side + 1) + Quad % Side, B = A + Side + 1;
		Indices.insert(Indices.end(), {A, B, A + 1, A + 1, B, B + 1});
	}
}

FRTModuleMesh FBenchGrid::Describe() const
{
	FRTModuleMesh Mesh;
	Mesh.Name = "Grid";
	Mesh.Positions = Positions.data();
	Mesh.VertexCount = static_cast<uint32_t>(Positions.size() / 3);
	Mesh.Indices = Indices.data();
	Mesh.IndexCount = static_cast<uint32_t>(Indices.size());
	return Mesh;
}

FRTStatus AddBenchGrid(IRTModuleRenderer& Renderer, const FBenchGrid& Grid, ERTMaterialHandle Material, uint32_t Number)
{
	FRTModuleObject Object;
	if (FRTStatus Status = Renderer.AddMesh(Grid.Describe(), &Object.Mesh); !Status) { return Status; }
	Object.Materials = &Material;
	Object.MaterialCount = 1;
	Object.Transform[3] = 20.0 * (Number % 100);
	Object.Transform[7] = -5.0;
	Object.Transform[11] = -20.0 * (Number / 100);
	ERTObjectHandle Handle = ERTObjectHandle::None;
	return Renderer.AddObject(Object, &Handle);
}

} // namespace Lantern
