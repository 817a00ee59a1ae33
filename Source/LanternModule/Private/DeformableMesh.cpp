// Meshes whose vertices the engine replaces: keeps the new vertices and uploads them.
#include "DeformableMesh.h"

#include <cstring>

#include "MeshData.h"

namespace Lantern
{

FDeformableMesh::FDeformableMesh(const FRTModuleMesh& Mesh, std::vector<FVertexAttributes> InAttributes, FRTGeometryRef InGeometry)
    : Geometry(std::move(InGeometry)),
      Indices(Mesh.Indices, Mesh.Indices + Mesh.IndexCount),
      Positions(Mesh.VertexCount),
      Attributes(std::move(InAttributes))
{}

FRTStatus FDeformableMesh::SetVertices(const float* InPositions, const float* Normals)
{
	FRTModuleMesh Mesh;
	Mesh.Name = Geometry->GetInfo().Name.c_str();
	Mesh.Positions = InPositions;
	Mesh.Normals = Normals;
	Mesh.VertexCount = static_cast<uint32_t>(Positions.size());
	Mesh.Indices = Indices.data();
	Mesh.IndexCount = static_cast<uint32_t>(Indices.size());
	const FRTStatus Status = CheckVertices(Mesh);
	if (Status)
	{
		std::memcpy(Positions.data(), InPositions, Positions.size() * sizeof(Positions[0]));
		PackNormals(Mesh, Attributes);
		State = EState::Pending;
	}
	return Status;
}

FRTStatus FDeformableMesh::Record(IRTCommandList& List, FFrameUploads& Uploads)
{
	const FRTGeometryInfo& Info = Geometry->GetInfo();
	const uint64_t PositionBytes = Positions.size() * sizeof(Positions[0]);
	const uint64_t AttributeBytes = Attributes.size() * sizeof(Attributes[0]);
	FUploadSlice PositionSlice, AttributeSlice;
	if (const FRTStatus Status = Uploads.Push(Positions.data(), PositionBytes, PositionSlice); !Status) { return Status; }
	if (const FRTStatus Status = Uploads.Push(Attributes.data(), AttributeBytes, AttributeSlice); !Status) { return Status; }
	// Named one by one: a barrier of memory as such would move what others hold in the same state.
	const FRTBarrier Before[] = {{Info.Positions.Get(), nullptr, UploadedAccess, ERTAccess::CopyWrite},
	    {Info.Attributes.Get(), nullptr, UploadedAccess, ERTAccess::CopyWrite}};
	const FRTBarrier After[] = {{Info.Positions.Get(), nullptr, ERTAccess::CopyWrite, UploadedAccess},
	    {Info.Attributes.Get(), nullptr, ERTAccess::CopyWrite, UploadedAccess}};
	List.Barriers(Before, 2);
	List.CopyBuffer(Info.Positions.Get(), 0, PositionSlice.Buffer, PositionSlice.Offset, PositionBytes);
	List.CopyBuffer(Info.Attributes.Get(), 0, AttributeSlice.Buffer, AttributeSlice.Offset, AttributeBytes);
	List.Barriers(After, 2);
	State = EState::Recorded;
	return FRTStatus::Success();
}

void FDeformableMesh::EndFrame(bool bSubmitted)
{
	// Vertices set since they were recorded are pending whatever became of those.
	if (State == EState::Recorded) { State = bSubmitted ? EState::Clean : EState::Pending; }
}

} // namespace Lantern
