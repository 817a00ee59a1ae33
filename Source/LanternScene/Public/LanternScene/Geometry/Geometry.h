// A geometry: triangles (or boxes) in sections, and the acceleration structure over them. It knows nothing of shaders or
// materials. Any number of objects may share it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "LanternRHI/RTInterfaces.h"

namespace Lantern
{

struct FRTSectionInfo
{
	uint32_t FirstIndex = 0; ///< procedural: the first AABB
	uint32_t IndexCount = 0; ///< > 0, a multiple of 3; procedural: number of AABBs
	/// False if some object may give this section an alpha-tested material: any-hit shaders then run on it.
	bool bOpaque = true;
	/// The section has AABBs and the intersection shader of the material's program, instead of triangles.
	bool bProcedural = false;
	/// Lengths of the last two parts of the index range if triangles are classified by their alpha test. The range is then
	/// ordered mixed | opaque | transparent. Multiples of 3; 0, 0: not classified.
	uint32_t OpaqueIndexCount = 0, TransparentIndexCount = 0;
	uint64_t OpacityKey = 0; ///< names the alpha test that the section was classified with
	/// Pieces that take the place of the mixed triangles and cover what is not transparent of them (OpacityPieces.h).
	/// 0: none.
	uint32_t FirstPiece = 0, PieceCount = 0;
	uint32_t FirstVertex = 0; ///< is added to its indices; only with FRTGeometryInfo::bStreams
	bool IsClassified() const { return OpaqueIndexCount + TransparentIndexCount + PieceCount > 0; }
};

/// Where a geometry's data lies. Buffers need ERTBufferUsage::GeometryInput and Storage.
struct FRTGeometryInfo
{
	std::string Name;
	TRTRef<IRTBuffer> Positions;  ///< float3; or see bStreams
	uint64_t PositionsOffset = 0; ///< bytes, a multiple of 4
	/// The vertices lie in a host's own buffers: Attributes holds an FVertexStreams for each section, and positions have the
	/// stride and format below. Shaders read positions from the streams.
	bool bStreams = false;
	std::vector<TRTRef<IRTBuffer>> StreamBuffers; ///< what else the streams name: held as long as the geometry lives
	uint32_t PositionStride = 12;                 ///< bytes, a multiple of 4
	ERTVertexFormat PositionFormat = ERTVertexFormat::Float3;
	/// Positions before the last deformation: float3, from the start of the buffer. Whoever deforms them writes it, as the
	/// skinning pass does. Null: deformation has no motion vectors. Dynamic geometry only.
	TRTRef<IRTBuffer> PreviousPositions;
	TRTRef<IRTBuffer> Attributes; ///< FVertexAttributes, or FVertexStreams
	uint64_t AttributesOffset = 0;
	TRTRef<IRTBuffer> Indices;
	uint64_t IndicesOffset = 0; ///< bytes, a multiple of 4
	ERTIndexType IndexType = ERTIndexType::UInt32;
	TRTRef<IRTBuffer> Aabbs;          ///< six floats each: min, max; null without procedural sections
	uint64_t AabbsOffset = 0;         ///< bytes, a multiple of 8
	TRTRef<IRTBuffer> PiecePositions; ///< float3, three for each piece; null without pieces
	TRTRef<IRTBuffer> PieceIndices;   ///< uint32, three for each piece: corners of the triangle that it was cut from
	uint32_t VertexCount = 0;
	std::vector<FRTSectionInfo> Sections; ///< > 0
	bool bHasTangents = false;
	/// Alpha is 1 in every vertex colour: alpha tests then do not read it. False is always right.
	bool bOpaqueVertices = false;
	/// The buffers are still being filled: the geometry is built after FRTScene::MarkFilled.
	bool bWaitsForData = false;
	/// Vertices change after creation (skinning). Call FRTScene::MarkDeformed each time.
	bool bDynamic = false;
	/// A copy of the positions and indices on the CPU. Without CpuOwner it must live until the store has begun a frame after the
	/// geometry's last owner let go, or is gone. Ignored for dynamic geometry.
	/// Null: the geometry has no coarser levels of detail.
	const glm::vec3* CpuPositions = nullptr;
	const uint32_t* CpuIndices = nullptr;
	std::shared_ptr<const void> CpuOwner; ///< held as long as the geometry lives; null: CpuPositions and CpuIndices live by other means
	glm::vec3 BoundsCenter{0};            ///< object space
	/// Radius of a sphere around everything that the geometry can become. A negative radius is computed from CpuPositions if
	/// there are any and the geometry is static. Otherwise it is unknown, and the geometry's objects are never culled.
	float BoundsRadius = -1.0f;
};

/// What the acceleration structure really holds: its geometryIndex counts parts. Part i < section count belongs to section i.
/// It is the whole section if that is not classified. Otherwise it is the mixed triangles or the pieces of them, or the opaque
/// triangles if no triangle is mixed. The parts behind are the opaque triangles of sections that have mixed ones too.
/// Transparent triangles are in no part, except one of a section that has nothing else.
struct FRTGeometryPart
{
	uint32_t FirstIndex = 0, IndexCount = 0; ///< as in FRTSectionInfo
	uint32_t Section = 0;
	bool bOpaque = true;
	bool bPieces = false; ///< the range counts PieceIndices
	friend bool operator==(const FRTGeometryPart&, const FRTGeometryPart&) = default;
};

struct FBoundingSphere
{
	glm::vec3 Center{0};
	float Radius = -1.0f; ///< < 0: unknown
};
/// Returns a sphere that holds all points; an unknown one if there are none, or if one is not finite. O(Count).
FBoundingSphere FindBoundingSphere(const glm::vec3* Points, size_t Count);

/// bClassified: false ignores the classification of sections.
std::vector<FRTGeometryPart> MakeGeometryParts(const FRTGeometryInfo& Info, bool bClassified = true);
/// Sets the bounds from the positions if Info does not state them (see FRTGeometryInfo::BoundsRadius).
void FillBounds(FRTGeometryInfo& Info);
class FRTGeometry;
/// Describes the parts as the RHI takes them. Pointers are valid as long as the geometry lives.
std::vector<FRTGeometrySection> MakeStructureSections(const FRTGeometry& Geometry);

class FCoarserLevel;

class FRTGeometry : public std::enable_shared_from_this<FRTGeometry>
{
public:
	explicit FRTGeometry(FRTGeometryInfo InInfo);
	~FRTGeometry();
	FRTGeometry(const FRTGeometry&) = delete;
	FRTGeometry& operator=(const FRTGeometry&) = delete;

	const FRTGeometryInfo& GetInfo() const { return Info; }
	/// Null before the first build.
	IRTGeometry* GetStructure() const { return Structure.Get(); }
	bool IsBuilt() const { return bBuilt; }
	uint32_t GetSectionCount() const { return static_cast<uint32_t>(Info.Sections.size()); }
	const std::vector<FRTGeometryPart>& GetParts() const { return Parts; }
	/// Number of elements that a range of sections needs. At least the number of parts; constant.
	uint32_t GetPartCapacity() const { return PartCapacity; }
	uint32_t GetSlot() const { return Slot; } ///< in FGeometryStore; constant
	uint64_t GetPrimitiveCount() const;       ///< in all parts
	/// Index buffer that parts refer to: the one of the info, or that of a coarser level of detail.
	IRTBuffer* GetIndices() const { return Indices.Get(); }
	uint64_t GetIndicesOffset() const { return IndicesOffset; }
	ERTIndexType GetIndexType() const { return IndexType; }
	/// Parts and indices belong to a coarser level: they no longer follow CpuIndices.
	bool IsCoarse() const { return bCoarse; }
	/// Some section's triangles are classified by their opacity (see FRTSectionInfo::OpacityKey).
	bool HasClassifiedSections() const { return PartCapacity > Info.Sections.size(); }
	/// Parts follow the classification of their sections. False: they ignore it.
	bool IsClassified() const { return bClassified; }
	/// A submitted frame has deformed it: what the next deformation finds are the positions of the frame before.
	bool WasDeformed() const { return bWasDeformed; }

private:
	friend class FObjectMotions;
	friend class FSceneObjects; // bounds
	friend struct FGeometryEntry;
	friend struct FGeometryTestAccess;
	FRTGeometryInfo Info;
	std::vector<FRTGeometryPart> Parts;
	uint32_t PartCapacity = 0;
	uint32_t Slot = 0;
	TRTRef<IRTBuffer> Indices;
	uint64_t IndicesOffset = 0;
	ERTIndexType IndexType = ERTIndexType::UInt32;
	bool bCoarse = false;
	bool bClassified = true;
	TRTRef<IRTGeometry> Structure;
	bool bBuilt = false;
	bool bMotionMarked = false; // is in FObjectMotions' list of this frame
	bool bWasDeformed = false;
	std::unique_ptr<FCoarserLevel> Coarser; // is being made; last: it reads the others
};

using FRTGeometryRef = std::shared_ptr<FRTGeometry>;

} // namespace Lantern
