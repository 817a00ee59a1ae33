// Arrays of vertices for the plugin.
#include "Example/PluginMeshes.h"

namespace Fork
{

using namespace Lantern;

FMeshArrays::FMeshArrays(const FBoxMesh& Box) : Indices(Box.Indices.begin(), Box.Indices.end())
{
	for (const FVertex& Vertex : Box.Vertices)
	{
		Positions.push_back(Vertex.Position);
		Normals.push_back(Vertex.Normal);
		UVs.push_back(Vertex.UV);
	}
}

FMeshArrays::FMeshArrays(const FReedMesh& Reed) : Indices(Reed.Indices)
{
	for (const FSkinVertex& Vertex : Reed.Vertices) { Positions.push_back(Vertex.Position); }
}

FRTModuleMesh FMeshArrays::Describe(const char* Name, bool bDeformable) const
{
	FRTModuleMesh Mesh;
	Mesh.Name = Name;
	Mesh.Positions = &Positions[0].x;
	Mesh.Normals = Normals.empty() ? nullptr : &Normals[0].x;
	Mesh.UVs = UVs.empty() ? nullptr : &UVs[0].x;
	Mesh.VertexCount = static_cast<uint32_t>(Positions.size());
	Mesh.Indices = Indices.data();
	Mesh.IndexCount = static_cast<uint32_t>(Indices.size());
	Mesh.bDeformable = bDeformable;
	return Mesh;
}

FMeshArrays MakePaneArrays()
{
	FMeshArrays Pane;
	Pane.Positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
	Pane.Normals.assign(4, {0, 0, 1});
	Pane.Indices = {0, 1, 2, 0, 2, 3};
	return Pane;
}

FRTModuleMesh DescribeReed(const FMeshArrays& Reed)
{
	FRTModuleMesh Mesh = Reed.Describe("Reed", true);
	Mesh.BoundsRadius = 2.2f * float(Metre);
	return Mesh;
}

} // namespace Fork
