// Meshes as an engine hands them to IRTModuleRenderer: copied from arrays, read where the engine's GPU has them, or made of
// heights. Module.h has the units and the rules.
#pragma once

#include "LanternRHI/RTInterfaces.h"

namespace Lantern
{

enum class ERTMeshHandle : uint64_t
{
	None = 0
};

struct FRTModuleSection
{
	uint32_t FirstIndex = 0;
	uint32_t IndexCount = 0; ///< > 0, a multiple of 3
	/// Allows objects to give this section a masked material; otherwise that is InvalidArgument. True costs nothing until an
	/// object has a masked material. Alpha tests are then set up for all such sections of that object.
	bool bMayBeMasked = false;
	uint32_t FirstVertex = 0; ///< is added to each of the section's indices
};

/// How a vertex of a stream is coded, little-endian. Directions (normals, tangents) in unsigned formats are 2 · value − 1.
enum class ERTModuleVertex : uint8_t
{
	Float2,
	Float3,
	Float4,
	Half2,
	Half4,
	Unorm16x2,    ///< 0 to 1
	Snorm16x2,    ///< −1 to 1
	Snorm16x4,    ///< −1 to 1
	Unorm8x4,     ///< 0 to 1
	Snorm8x4,     ///< −1 to 1
	Bgra8,        ///< 0 to 1, blue first
	Unorm10x3,    ///< x in the lowest 10 bits, then y, z, and w in the highest 2
	Snorm10x3,    ///< the same, signed
	Octahedral16, ///< two 16-bit SNORM (Cigolle et al. 2014); the lowest bit of the second, if set, is a w of −1
};

/// One attribute of all vertices in a buffer of the engine's. Streams may share a buffer, interleaved or one behind the other.
struct FRTModuleStream
{
	/// From IRTDevice::ImportBuffer, with Storage usage. Null: the vertices have no such attribute.
	IRTBuffer* Buffer = nullptr;
	uint64_t Offset = 0; ///< bytes from the buffer's start to vertex 0, a multiple of 4
	uint32_t Stride = 0; ///< bytes from vertex to vertex, a multiple of 4, at least the format's size
	ERTModuleVertex Format = ERTModuleVertex::Float3;
};

/// Vertices and indices where the engine's GPU has them. Nothing is copied: acceleration structures are built from them, and hit
/// shaders read them.
///
/// Lifetime: the renderer holds references. The memory must stay as it is until FRTNativeBuffer::Released, which comes some frames
/// after RemoveMesh, or with the renderer's end.
/// Synchronisation: the engine writes the data before the commands of the next RenderFrame, on the device's queue. It puts a
/// barrier to shader reads and acceleration structure builds between. With FRTModuleFrame::bSubmitAhead, it submits the work before
/// RenderFrame; the compute queue must be able to use the buffer if r.RT.Async names passes of the scene. Without bDeformable, the data must not change afterwards.
/// Nobody can check what is on the GPU: indices must be < VertexCount, with FirstVertex added, and positions finite.
struct FRTModuleStreams
{
	/// Float3, Half4 or Snorm16x4; the buffer needs GeometryInput usage, too. Scale and bias of SNORM belong into the transforms of
	/// objects; bounds are in the numbers of the stream.
	FRTModuleStream Positions;
	/// Float3, Half4, Snorm16x4, Snorm8x4, Unorm8x4, Snorm10x3, Unorm10x3 or Octahedral16. Null: each triangle has its own.
	FRTModuleStream Normals;
	FRTModuleStream Tangents; ///< as Normals, or Float4; w < 0: the bitangent is turned round
	FRTModuleStream UVs;      ///< Float2, Half2, Unorm16x2 or Snorm16x2
	FRTModuleStream UVs1;
	FRTModuleStream Colors; ///< Unorm8x4, Bgra8, Half4 or Float4, linear
	/// Indices from IndicesOffset on, as FRTModuleMesh::IndexCount says. GeometryInput and Storage usage. The buffer must go on to the
	/// next multiple of 4 bytes behind them.
	IRTBuffer* Indices = nullptr;
	uint64_t IndicesOffset = 0; ///< bytes, a multiple of the index size
	bool bIndices16 = false;    ///< 16 bits each; else 32
	/// w of Normals, not of Tangents, is the sign of the bitangent (Unreal Engine). Normals then have a format with w.
	bool bSignInNormals = false;
};

inline constexpr uint32_t MaxMeshVertices = 1u << 28;             ///< with their attributes they have 10 GiB
inline constexpr uint32_t MaxMeshIndices = ((1u << 29) - 1u) * 3; ///< as many triangles as every device can build

/// A mesh. AddMesh reads the arrays and copies them to the GPU. Skinned meshes set bDeformable. Their vertices come from the CPU
/// (UpdateMeshVertices) or from the engine's own work on the GPU (GetMeshBuffer, MarkMeshDeformed).
struct FRTModuleMesh
{
	const char* Name = "";
	const float* Positions = nullptr;           ///< x, y, z of each vertex; finite
	const float* Normals = nullptr;             ///< x, y, z, unit length; null: computed from the triangles
	const float* Tangents = nullptr;            ///< x, y, z, unit length, and the sign of the bitangent; null: none, and no normal maps
	const float* UVs = nullptr;                 ///< u, v; finite; null: zeros
	const float* UVs1 = nullptr;                ///< second set, u, v; finite; null: zeros
	const uint8_t* Colors = nullptr;            ///< r, g, b, a, linear, 255 being 1; multiply the base colour; null: all 1
	uint32_t VertexCount = 0;                   ///< 1 … MaxMeshVertices
	const uint32_t* Indices = nullptr;          ///< counter-clockwise is front; < VertexCount, with FirstVertex added
	const uint16_t* Indices16 = nullptr;        ///< instead of Indices: the same in 16 bits
	uint32_t IndexCount = 0;                    ///< a multiple of 3, 3 … MaxMeshIndices
	const FRTModuleSection* Sections = nullptr; ///< null: one section of all indices, with bMayBeMasked
	uint32_t SectionCount = 0;
	/// Allows UpdateMeshVertices. Rays trace the mesh slightly more slowly, and a copy stays on the CPU.
	bool bDeformable = false;
	/// Sphere around all that the mesh can become, in its own space. Culling, the order of builds and the offset of rays follow
	/// it. A negative radius is computed from the positions, and from new ones with each UpdateMeshVertices.
	float BoundsCenter[3] = {0, 0, 0};
	float BoundsRadius = -1.0f;
	/// Keeps positions and indices on the CPU: 12 bytes for each vertex and 4 for each index. Without them, the mesh has no
	/// coarser levels if memory is short. Its emissive triangles are then found by chance alone.
	bool bKeepOnCpu = true;
	/// In place of all arrays above: the vertices and indices are on the GPU already, and stay there. Needs BoundsRadius, and
	/// counts as without bKeepOnCpu. With bDeformable, the engine writes into its own buffers and calls MarkMeshDeformed.
	const FRTModuleStreams* Streams = nullptr;
};

/// A patch of a landscape: a grid of heights, of which the renderer keeps a copy. It becomes a mesh of one section that may be
/// masked, with normals from the heights and UVs from 0 to 1 across it. In object space, sample (column, row) lies at
/// (column · SpacingX, row · SpacingY, HeightOffset + HeightScale · height), and z points upwards, which is the front.
/// Neighbours share a row or column of samples, and their transforms differ by the extent. Borders reach over by 4e-6 of the
/// extent, so that rounding opens no crack. Normals at borders know this patch alone.
struct FRTModuleLandscape
{
	const char* Name = "";
	const uint16_t* Heights = nullptr;      ///< Rows rows of Columns samples
	uint32_t Columns = 0, Rows = 0;         ///< 2 … MaxLandscapeSamples each
	uint32_t RowPitch = 0;                  ///< samples from row to row, ≥ Columns; 0: Columns
	float SpacingX = 1.0f, SpacingY = 1.0f; ///< > 0, in the engine's unit
	float HeightScale = 1.0f, HeightOffset = 0.0f;
	/// One byte for each quad, Columns − 1 in a row; not 0: the quad is a hole. Null: there are none. Not all quads may be holes.
	const uint8_t* Holes = nullptr;
	uint32_t HolesPitch = 0; ///< bytes from row to row, ≥ Columns − 1; 0: Columns − 1
};

inline constexpr uint32_t MaxLandscapeSamples = 4097; ///< along a patch's side

/// A rectangle of new heights in a patch.
struct FRTModuleHeights
{
	const uint16_t* Heights = nullptr; ///< Rows rows of Columns samples
	uint32_t FirstColumn = 0, FirstRow = 0;
	uint32_t Columns = 0, Rows = 0; ///< > 0; the rectangle lies within the patch
	uint32_t RowPitch = 0;          ///< samples from row to row, ≥ Columns; 0: Columns
};

/// Where a mesh lies on the GPU, for an engine that writes its vertices there.
struct FRTModuleMeshBuffer
{
	/// Holds VertexCount positions of three floats from PositionsOffset on. The renderer owns it; it is valid until RemoveMesh.
	/// Null: the mesh is still on its way, and what is written would be written over.
	IRTBuffer* Buffer = nullptr;
	uint64_t PositionsOffset = 0; ///< bytes
};

} // namespace Lantern
