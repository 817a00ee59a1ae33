// Meshes in the engine's own buffers: formats, strides and ranges.
#include "StreamedMesh.h"

#include <initializer_list>
#include <utility>

#include "LanternRHI/RTText.h"
#include "MeshData.h"

namespace Lantern
{

namespace
{

using EVertex = ERTModuleVertex;

static_assert(uint32_t(EVertex::Float2) == VERTEX_FLOAT2 && uint32_t(EVertex::Float3) == VERTEX_FLOAT3);
static_assert(uint32_t(EVertex::Float4) == VERTEX_FLOAT4 && uint32_t(EVertex::Half2) == VERTEX_HALF2);
static_assert(uint32_t(EVertex::Half4) == VERTEX_HALF4 && uint32_t(EVertex::Unorm16x2) == VERTEX_UNORM16X2);
static_assert(uint32_t(EVertex::Snorm16x2) == VERTEX_SNORM16X2 && uint32_t(EVertex::Snorm16x4) == VERTEX_SNORM16X4);
static_assert(uint32_t(EVertex::Unorm8x4) == VERTEX_UNORM8X4 && uint32_t(EVertex::Snorm8x4) == VERTEX_SNORM8X4);
static_assert(uint32_t(EVertex::Bgra8) == VERTEX_BGRA8 && uint32_t(EVertex::Unorm10x3) == VERTEX_UNORM10X3);
static_assert(uint32_t(EVertex::Snorm10x3) == VERTEX_SNORM10X3 && uint32_t(EVertex::Octahedral16) == VERTEX_OCTAHEDRAL16);

uint32_t GetBytes(EVertex Format)
{
	switch (Format)
	{
	case EVertex::Float4: return 16;
	case EVertex::Float3: return 12;
	case EVertex::Float2:
	case EVertex::Half4:
	case EVertex::Snorm16x4: return 8;
	default: return 4;
	}
}

using FFormats = std::initializer_list<EVertex>;
constexpr FFormats PositionFormats = {EVertex::Float3, EVertex::Half4, EVertex::Snorm16x4};
constexpr FFormats NormalFormats = {EVertex::Float3, EVertex::Half4, EVertex::Snorm16x4, EVertex::Snorm8x4, EVertex::Unorm8x4,
    EVertex::Snorm10x3, EVertex::Unorm10x3, EVertex::Octahedral16};
constexpr FFormats TangentFormats = {EVertex::Float4, EVertex::Float3, EVertex::Half4, EVertex::Snorm16x4, EVertex::Snorm8x4,
    EVertex::Unorm8x4, EVertex::Snorm10x3, EVertex::Unorm10x3, EVertex::Octahedral16};
constexpr FFormats UVFormats = {EVertex::Float2, EVertex::Half2, EVertex::Unorm16x2, EVertex::Snorm16x2};
constexpr FFormats ColorFormats = {EVertex::Unorm8x4, EVertex::Bgra8, EVertex::Half4, EVertex::Float4};

constexpr ERTBufferUsage Read = ERTBufferUsage::Storage;
constexpr ERTBufferUsage ReadAndBuild = ERTBufferUsage::Storage | ERTBufferUsage::GeometryInput;

bool HasAll(ERTBufferUsage Usage, ERTBufferUsage Wanted) { return (Usage & Wanted) == Wanted; }

/// Name: of the member of FRTModuleStreams.
FRTStatus Refuse(const FRTModuleMesh& Mesh, const char* Name, const char* Reason)
{
	return FRTStatus::Error(ERTResult::InvalidArgument, "mesh \"%s\": FRTModuleStreams::%s%s", FRTShown(Mesh.Name).Text, Name, Reason);
}

FRTStatus CheckStream(const FRTModuleMesh& Mesh, const FRTModuleStream& Stream, const char* Name, FFormats Formats, ERTBufferUsage Usage)
{
	if (Stream.Buffer == nullptr) { return FRTStatus::Success(); }
	bool bKnown = false;
	for (const EVertex Format : Formats) { bKnown |= Format == Stream.Format; }
	if (!bKnown) { return Refuse(Mesh, Name, ".Format is none for it"); }
	const FRTBufferDesc& Desc = Stream.Buffer->GetDesc();
	if (!HasAll(Desc.Usage, Usage)) { return Refuse(Mesh, Name, ".Buffer lacks a usage"); }
	const uint32_t Bytes = GetBytes(Stream.Format);
	if (Stream.Stride < Bytes || Stream.Stride % 4 != 0) { return Refuse(Mesh, Name, ".Stride is too small, or no multiple of 4"); }
	if (Stream.Offset % 4 != 0) { return Refuse(Mesh, Name, ".Offset is no multiple of 4"); }
	const uint64_t Needed = uint64_t(Mesh.VertexCount - 1) * Stream.Stride + Bytes;
	const bool bFits = Stream.Offset <= Desc.Size && Needed <= Desc.Size - Stream.Offset;
	return bFits ? FRTStatus::Success() : Refuse(Mesh, Name, ".Offset: the vertices reach past the end of its Buffer");
}

FRTStatus CheckIndices(const FRTModuleMesh& Mesh)
{
	const FRTModuleStreams& Streams = *Mesh.Streams;
	if (Streams.Indices == nullptr) { return Refuse(Mesh, "Indices", " is null"); }
	const FRTBufferDesc& Desc = Streams.Indices->GetDesc();
	if (!HasAll(Desc.Usage, ReadAndBuild)) { return Refuse(Mesh, "Indices", " lacks a usage"); }
	const uint32_t Bytes = Streams.bIndices16 ? 2 : 4;
	if (Streams.IndicesOffset % Bytes != 0) { return Refuse(Mesh, "IndicesOffset", " is no multiple of the index size"); }
	// Shaders read whole words.
	const uint64_t Needed = (uint64_t(Mesh.IndexCount) * Bytes + Streams.IndicesOffset % 4 + 3) / 4 * 4;
	const uint64_t First = Streams.IndicesOffset / 4 * 4;
	const bool bFits = First <= Desc.Size && Needed <= Desc.Size - First;
	return bFits ? FRTStatus::Success() : Refuse(Mesh, "Indices", ": IndexCount of them reach past the end");
}

ERTVertexFormat ToBuildFormat(EVertex Format)
{
	if (Format == EVertex::Half4) { return ERTVertexFormat::Half4; }
	return Format == EVertex::Snorm16x4 ? ERTVertexFormat::Snorm16x4 : ERTVertexFormat::Float3;
}

FVertexStream Pack(const FRTModuleStream& Stream, uint32_t FirstVertex)
{
	if (Stream.Buffer == nullptr) { return {}; }
	const uint64_t Address = Stream.Buffer->GetDeviceAddress() + Stream.Offset + uint64_t(FirstVertex) * Stream.Stride;
	return {Address, Stream.Stride, static_cast<uint32_t>(Stream.Format)};
}

} // namespace

FRTStatus CheckStreamedMesh(const FRTModuleMesh& Mesh)
{
	if (const FRTStatus Status = CheckShape(Mesh); !Status) { return Status; }
	const FRTModuleStreams& Streams = *Mesh.Streams;
	const bool bArrays = Mesh.Positions != nullptr || Mesh.Normals != nullptr || Mesh.Tangents != nullptr || Mesh.UVs != nullptr ||
	                     Mesh.UVs1 != nullptr || Mesh.Colors != nullptr || Mesh.Indices != nullptr || Mesh.Indices16 != nullptr;
	if (bArrays) { return RefuseMesh(Mesh, "has an array (Positions … Indices16) beside Streams"); }
	if (Mesh.BoundsRadius < 0.0f) { return RefuseMesh(Mesh, "BoundsRadius is negative: with Streams, it cannot be computed"); }
	if (Streams.Positions.Buffer == nullptr) { return Refuse(Mesh, "Positions", ".Buffer is null"); }
	FRTStatus Status = CheckStream(Mesh, Streams.Positions, "Positions", PositionFormats, ReadAndBuild);
	if (Status) { Status = CheckStream(Mesh, Streams.Normals, "Normals", NormalFormats, Read); }
	if (Status) { Status = CheckStream(Mesh, Streams.Tangents, "Tangents", TangentFormats, Read); }
	if (Status) { Status = CheckStream(Mesh, Streams.UVs, "UVs", UVFormats, Read); }
	if (Status) { Status = CheckStream(Mesh, Streams.UVs1, "UVs1", UVFormats, Read); }
	if (Status) { Status = CheckStream(Mesh, Streams.Colors, "Colors", ColorFormats, Read); }
	if (!Status) { return Status; }
	if (Streams.bSignInNormals && (Streams.Normals.Buffer == nullptr || Streams.Normals.Format == EVertex::Float3))
	{
		return Refuse(Mesh, "bSignInNormals", ": Normals have no w");
	}
	for (const FRTModuleSection& Section : GetSections(Mesh))
	{
		if (Section.FirstVertex >= Mesh.VertexCount) { return RefuseMesh(Mesh, "a section's FirstVertex is behind all vertices"); }
	}
	return CheckIndices(Mesh);
}

FRTGeometryInfo DescribeStreamedMesh(const FRTModuleMesh& Mesh)
{
	const FRTModuleStreams& Streams = *Mesh.Streams;
	FRTGeometryInfo Out;
	Out.Name = Mesh.Name;
	Out.bStreams = true;
	Out.Positions = TRTRef<IRTBuffer>(Streams.Positions.Buffer);
	Out.PositionsOffset = Streams.Positions.Offset;
	Out.PositionStride = Streams.Positions.Stride;
	Out.PositionFormat = ToBuildFormat(Streams.Positions.Format);
	Out.Indices = TRTRef<IRTBuffer>(Streams.Indices);
	Out.IndicesOffset = Streams.IndicesOffset;
	Out.IndexType = Streams.bIndices16 ? ERTIndexType::UInt16 : ERTIndexType::UInt32;
	Out.VertexCount = Mesh.VertexCount;
	for (const FRTModuleSection& From : GetSections(Mesh))
	{
		FRTSectionInfo& Section = Out.Sections.emplace_back();
		Section.FirstIndex = From.FirstIndex;
		Section.IndexCount = From.IndexCount;
		Section.bOpaque = !From.bMayBeMasked;
		Section.FirstVertex = From.FirstVertex;
	}
	Out.bHasTangents = Streams.Tangents.Buffer != nullptr;
	Out.bOpaqueVertices = Streams.Colors.Buffer == nullptr;
	Out.bDynamic = Mesh.bDeformable;
	Out.bWaitsForData = true;
	Out.BoundsCenter = {Mesh.BoundsCenter[0], Mesh.BoundsCenter[1], Mesh.BoundsCenter[2]};
	Out.BoundsRadius = Mesh.BoundsRadius;
	for (const FRTModuleStream* const Stream : {&Streams.Normals, &Streams.Tangents, &Streams.UVs, &Streams.UVs1, &Streams.Colors})
	{
		if (Stream->Buffer != nullptr) { Out.StreamBuffers.emplace_back(Stream->Buffer); }
	}
	return Out;
}

std::vector<FVertexStreams> PackStreams(const FRTModuleMesh& Mesh)
{
	const FRTModuleStreams& Streams = *Mesh.Streams;
	std::vector<FVertexStreams> Out;
	for (const FRTModuleSection& Section : GetSections(Mesh))
	{
		FVertexStreams& To = Out.emplace_back();
		To.Positions = Pack(Streams.Positions, Section.FirstVertex);
		To.Normals = Pack(Streams.Normals, Section.FirstVertex);
		To.Tangents = Pack(Streams.Tangents, Section.FirstVertex);
		To.UV0 = Pack(Streams.UVs, Section.FirstVertex);
		To.UV1 = Pack(Streams.UVs1, Section.FirstVertex);
		To.Colors = Pack(Streams.Colors, Section.FirstVertex);
		To.Flags = Streams.bSignInNormals ? STREAMS_SIGN_IN_NORMAL : 0u;
	}
	return Out;
}

} // namespace Lantern
