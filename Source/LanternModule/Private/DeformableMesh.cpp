// Meshes whose vertices the engine replaces: keeps the new vertices and uploads them.
#include "DeformableMesh.h"

#include <cstring>
#include <utility>

namespace Lantern
{

FDeformableMesh::FDeformableMesh(const FRTModuleMesh& Mesh, const FMeshData& Data)
    : Name(Mesh.Name),
      Shape(Data.Shape),
      Base(Data.Attributes),
      bFindsBounds(Mesh.BoundsRadius < 0.0f)
{}

FRTStatus FDeformableMesh::SetVertices(const float* InPositions, const float* Normals, bool& OutNew)
{
	const auto VertexCount = static_cast<uint32_t>(Shape->Positions.size());
	if (const FRTStatus Status = CheckVertices(Name.c_str(), InPositions, Normals, VertexCount); !Status) { return Status; }
	const auto New = std::make_shared<FVertices>();
	New->Positions.resize(VertexCount);
	std::memcpy(New->Positions.data(), InPositions, New->Positions.size() * sizeof(New->Positions[0]));
	New->Attributes = Base;
	PackNormals(*Shape, New->Positions.data(), Normals, New->Attributes);
	std::lock_guard Lock(Mutex);
	OutNew = Waiting == nullptr;
	Waiting = New;
	return FRTStatus::Success();
}

std::optional<FBoundingSphere> FDeformableMesh::FindNewBounds(const FRTGeometry& Geometry) const
{
	// Room for the next frames: new bounds rewrite all objects of the mesh.
	constexpr float Room = 1.1f, MostExcess = 2.0f;
	if (!bFindsBounds || !Recorded) { return std::nullopt; }
	FBoundingSphere New = FindBoundingSphere(Recorded->Positions.data(), Recorded->Positions.size());
	const FRTGeometryInfo& Old = Geometry.GetInfo();
	const bool bInside = length(New.Center - Old.BoundsCenter) + New.Radius <= Old.BoundsRadius;
	if (New.Radius < 0.0f || (bInside && Old.BoundsRadius <= MostExcess * New.Radius)) { return std::nullopt; }
	New.Radius *= Room;
	return New;
}

FRTStatus FDeformableMesh::Record(IRTCommandList& List, FFrameUploads& Uploads, const FRTGeometryInfo& Info)
{
	{
		std::lock_guard Lock(Mutex);
		Recorded = std::exchange(Waiting, nullptr);
	}
	if (!Recorded) { return FRTStatus::Success(); }
	// Both lie at the start of the mesh's buffer, one behind the other.
	const uint64_t PositionBytes = Recorded->Positions.size() * sizeof(Recorded->Positions[0]);
	const uint64_t AttributeBytes = Recorded->Attributes.size() * sizeof(Recorded->Attributes[0]);
	FUploadSlice Slice;
	if (const FRTStatus Status = Uploads.Allocate(PositionBytes + AttributeBytes, Slice); !Status) { return Status; }
	std::memcpy(Slice.Data, Recorded->Positions.data(), PositionBytes);
	std::memcpy(static_cast<uint8_t*>(Slice.Data) + PositionBytes, Recorded->Attributes.data(), AttributeBytes);
	IRTBuffer* const Buffer = Info.Positions.Get();
	// Named: a barrier of memory as such would move what others hold in the same state.
	const FRTBarrier Before{Buffer, nullptr, UploadedAccess, ERTAccess::CopyWrite};
	const FRTBarrier After{Buffer, nullptr, ERTAccess::CopyWrite, UploadedAccess};
	List.Barriers(&Before, 1);
	List.CopyBuffer(Buffer, 0, Slice.Buffer, Slice.Offset, PositionBytes + AttributeBytes);
	List.Barriers(&After, 1);
	return FRTStatus::Success();
}

bool FDeformableMesh::EndFrame(bool bSubmitted)
{
	const std::shared_ptr<const FVertices> Done = std::exchange(Recorded, nullptr);
	if (bSubmitted || !Done) { return false; }
	std::lock_guard Lock(Mutex);
	if (Waiting) { return false; }
	Waiting = Done;
	return true;
}

} // namespace Lantern
