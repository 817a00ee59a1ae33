// FRTGeometry: its parts, its bounds and its sections as the RHI takes them.
#include "LanternScene/Geometry/Geometry.h"

#include <cmath>

#include "Geometry/CoarserLevel.h"

namespace Lantern
{

std::vector<FRTGeometryPart> MakeGeometryParts(const FRTGeometryInfo& Info, bool bClassified)
{
	std::vector<FRTGeometryPart> Parts, Behind;
	for (uint32_t Section = 0; Section < Info.Sections.size(); ++Section)
	{
		const FRTSectionInfo& From = Info.Sections[Section];
		const uint32_t Transparent = bClassified ? From.TransparentIndexCount : 0;
		const uint32_t Opaque = bClassified ? From.OpaqueIndexCount : 0;
		const uint32_t Mixed = From.IndexCount - Opaque - Transparent;
		const FRTGeometryPart OpaquePart{From.FirstIndex + Mixed, Opaque, Section, true};
		if (!bClassified || !From.IsClassified()) { Parts.push_back({From.FirstIndex, From.IndexCount, Section, From.bOpaque}); }
		else if (Mixed > 0)
		{
			const FRTGeometryPart Pieces{3 * From.FirstPiece, 3 * From.PieceCount, Section, From.bOpaque, true};
			Parts.push_back(From.PieceCount > 0 ? Pieces : FRTGeometryPart{From.FirstIndex, Mixed, Section, From.bOpaque});
			if (Opaque > 0) { Behind.push_back(OpaquePart); }
		}
		// A part is never empty. If all triangles are transparent, one stays, and its any-hit shader lets rays pass.
		else { Parts.push_back(Opaque > 0 ? OpaquePart : FRTGeometryPart{From.FirstIndex, 3, Section, From.bOpaque}); }
	}
	Parts.insert(Parts.end(), Behind.begin(), Behind.end());
	return Parts;
}

FBoundingSphere FindBoundingSphere(const glm::vec3* Points, size_t Count)
{
	if (Count == 0) { return {}; }
	glm::vec3 Low = Points[0], High = Low;
	for (size_t Point = 1; Point < Count; ++Point)
	{
		Low = glm::min(Low, Points[Point]);
		High = glm::max(High, Points[Point]);
	}
	const glm::vec3 Center = 0.5f * Low + 0.5f * High;
	float SquaredRadius = 0.0f;
	for (size_t Point = 0; Point < Count; ++Point)
	{
		const glm::vec3 Away = Points[Point] - Center;
		SquaredRadius = glm::max(SquaredRadius, glm::dot(Away, Away));
	}
	if (!std::isfinite(SquaredRadius)) { return {}; }
	return {Center, std::sqrt(SquaredRadius) * (1.0f + 1e-5f)}; // rounding must leave no vertex outside
}

void FillBounds(FRTGeometryInfo& Info)
{
	if (Info.BoundsRadius >= 0.0f || Info.bDynamic || !Info.CpuPositions || Info.VertexCount == 0) { return; }
	for (const FRTSectionInfo& Section : Info.Sections)
	{
		if (Section.bProcedural) { return; } // boxes may lie anywhere
	}
	const FBoundingSphere Bounds = FindBoundingSphere(Info.CpuPositions, Info.VertexCount);
	Info.BoundsCenter = Bounds.Center;
	Info.BoundsRadius = Bounds.Radius;
}

std::vector<FRTGeometrySection> MakeStructureSections(const FRTGeometry& Geometry)
{
	const FRTGeometryInfo& Info = Geometry.GetInfo();
	const uint32_t IndexBytes = Geometry.GetIndexType() == ERTIndexType::UInt16 ? 2 : 4;
	std::vector<FRTGeometrySection> Sections;
	Sections.reserve(Geometry.GetParts().size());
	for (const FRTGeometryPart& Part : Geometry.GetParts())
	{
		FRTGeometrySection Out;
		Out.bOpaque = Part.bOpaque;
		if (Info.Sections[Part.Section].bProcedural)
		{
			Out.bProcedural = true;
			Out.Vertices = Info.Aabbs.Get();
			Out.VertexStride = 24;
			Out.VertexOffset = Info.AabbsOffset + uint64_t(Part.FirstIndex) * Out.VertexStride;
			Out.VertexCount = Part.IndexCount;
			Out.IndexType = ERTIndexType::None;
		}
		else if (Part.bPieces)
		{
			Out.Vertices = Info.PiecePositions.Get();
			Out.VertexOffset = uint64_t(Part.FirstIndex) * Out.VertexStride;
			Out.VertexCount = Part.IndexCount;
			Out.TriangleCount = Part.IndexCount / 3;
			Out.IndexType = ERTIndexType::None;
		}
		else
		{
			Out.Vertices = Info.Positions.Get();
			const uint32_t FirstVertex = Info.Sections[Part.Section].FirstVertex;
			Out.VertexOffset = Info.PositionsOffset + uint64_t(FirstVertex) * Info.PositionStride;
			Out.VertexStride = Info.PositionStride;
			Out.VertexFormat = Info.PositionFormat;
			Out.VertexCount = Info.VertexCount - FirstVertex;
			Out.Indices = Geometry.GetIndices();
			Out.IndexOffset = Geometry.GetIndicesOffset() + uint64_t(Part.FirstIndex) * IndexBytes;
			Out.TriangleCount = Part.IndexCount / 3;
			Out.IndexType = Geometry.GetIndexType();
		}
		Sections.push_back(Out);
	}
	return Sections;
}

FRTGeometry::FRTGeometry(FRTGeometryInfo InInfo)
    : Info(std::move(InInfo)),
      Indices(Info.Indices),
      IndicesOffset(Info.IndicesOffset),
      IndexType(Info.IndexType)
{
	FillBounds(Info);
	Parts = MakeGeometryParts(Info);
	PartCapacity = GetSectionCount();
	for (const FRTSectionInfo& Section : Info.Sections) { PartCapacity += Section.IsClassified() ? 1 : 0; }
}

FRTGeometry::~FRTGeometry() = default;

uint64_t FRTGeometry::GetPrimitiveCount() const
{
	uint64_t Count = 0;
	for (const FRTGeometryPart& Part : Parts) { Count += Info.Sections[Part.Section].bProcedural ? Part.IndexCount : Part.IndexCount / 3; }
	return Count;
}

} // namespace Lantern
