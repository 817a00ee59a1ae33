// rtGeometry: triangles (or boxes) in sections, and the acceleration structure over them. It knows nothing of shaders
// or materials; any number of objects may share it.
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
	uint32_t FirstIndex = 0; ///< procedural: first AABB
	uint32_t IndexCount = 0; ///< > 0, a multiple of 3; procedural: number of AABBs
	/// False where some object may give this section an alpha-tested material: any-hit shaders then run on it.
	bool bOpaque = true;
	/// AABBs with the intersection shader of the material's program, instead of triangles.
	bool bProcedural = false;
	/// Classified alpha test: the index range is ordered mixed | opaque | transparent, and these are the lengths of the last
	/// two, multiples of 3. 0, 0: not classified.
	uint32_t OpaqueIndexCount = 0, TransparentIndexCount = 0;
	uint64_t OpacityKey = 0; ///< names the alpha test that it was classified with
	/// Pieces that cover of the mixed triangles what is not transparent (OpacityPieces.h), in place of them; 0: none.
	uint32_t FirstPiece = 0, PieceCount = 0;
	bool IsClassified() const { return OpaqueIndexCount + TransparentIndexCount + PieceCount > 0; }
};

/// Where a geometry's data lies. Buffers need ERTBufferUsage::GeometryInput and Storage.
struct FRTGeometryInfo
{
	std::string Name;
	TRTRef<IRTBuffer> Positions;  ///< float3
	uint64_t PositionsOffset = 0; ///< bytes, a multiple of 4
	/// float3, from its start: what Positions held before they were deformed, written by whoever deforms them (the skinning
	/// pass does). Null: deformation has no motion vectors. Dynamic geometry only.
	TRTRef<IRTBuffer> PreviousPositions;
	TRTRef<IRTBuffer> Attributes; ///< FVertexAttributes
	uint64_t AttributesOffset = 0;
	TRTRef<IRTBuffer> Indices;
	uint64_t IndicesOffset = 0; ///< bytes, a multiple of 4
	ERTIndexType IndexType = ERTIndexType::UInt32;
	TRTRef<IRTBuffer> Aabbs;          ///< six floats each: min, max; null without procedural sections
	uint64_t AabbsOffset = 0;         ///< bytes, a multiple of 8
	TRTRef<IRTBuffer> PiecePositions; ///< float3, three for each piece; null without pieces
	TRTRef<IRTBuffer> PieceIndices;   ///< uint32, three for each piece: the corners of the triangle that it is a piece of
	uint32_t VertexCount = 0;
	std::vector<FRTSectionInfo> Sections; ///< > 0
	bool bHasTangents = false;
	/// The alpha of every vertex colour is 1: alpha tests then do not read it. False is always right.
	bool bOpaqueVertices = false;
	/// Vertices change after creation (skinning): call FRTScene::MarkDeformed when they did.
	bool bDynamic = false;
	/// The same data on the CPU, alive as long as the geometry; null: its emissive triangles are found by chance
	/// alone, not by light sampling, and it has no coarser levels of detail. Ignored for dynamic geometry.
	const glm::vec3* CpuPositions = nullptr;
	const uint32_t* CpuIndices = nullptr;
	glm::vec3 BoundsCenter{0}; ///< object space
	/// Of a sphere around everything the geometry can become. < 0: from CpuPositions if there are any and the geometry is
	/// not dynamic, else unknown: its objects are never culled.
	float BoundsRadius = -1.0f;
};

/// What the acceleration structure really holds: its geometryIndex counts parts. Part i < section count is section i: all
/// of it, or its mixed triangles or the pieces of them, or, where it has none of those, its opaque ones. Parts behind are
/// the opaque triangles of classified sections. Transparent triangles are in none, but for one of a section that has
/// nothing else.
struct FRTGeometryPart
{
	uint32_t FirstIndex = 0, IndexCount = 0; ///< as in FRTSectionInfo
	uint32_t Section = 0;
	bool bOpaque = true;
	bool bPieces = false; ///< the range is of PieceIndices
	friend bool operator==(const FRTGeometryPart&, const FRTGeometryPart&) = default;
};

/// bClassified: false takes sections as if they had not been.
std::vector<FRTGeometryPart> MakeGeometryParts(const FRTGeometryInfo& Info, bool bClassified = true);
/// The bounds that Info states, or those of its positions (see FRTGeometryInfo::BoundsRadius).
void FillBounds(FRTGeometryInfo& Info);
/// Parts as the RHI takes them. Pointers are good as long as the geometry.
class FRTGeometry;
std::vector<FRTGeometrySection> MakeStructureSections(const FRTGeometry& Geometry);

struct FGeometryReleases;
class FCoarserLevel;

class FRTGeometry
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
	/// Room that a range of sections needs, ≥ the number of parts; constant over the geometry's life.
	uint32_t GetPartCapacity() const { return PartCapacity; }
	uint32_t GetSlot() const { return Slot; } ///< in FGeometryStore; constant
	uint64_t GetPrimitiveCount() const;       ///< in all parts
	/// Index buffer that parts refer to: the info's, or that of a coarser level of detail.
	IRTBuffer* GetIndices() const { return Indices.Get(); }
	uint64_t GetIndicesOffset() const { return IndicesOffset; }
	ERTIndexType GetIndexType() const { return IndexType; }
	/// Parts and indices are those of a coarser level: they no longer follow CpuIndices.
	bool IsCoarse() const { return bCoarse; }
	/// Some section's triangles are told apart by their opacity (see FRTSectionInfo::OpacityKey).
	bool HasClassifiedSections() const { return PartCapacity > Info.Sections.size(); }
	/// Parts follow the classification; false: as if there were none.
	bool IsClassified() const { return bClassified; }
	/// A submitted frame has deformed it: what its positions are is what they were in the frame before.
	bool WasDeformed() const { return bWasDeformed; }

private:
	friend class FRTScene;
	friend class FObjectMotions;
	friend class FGeometryBuilder;
	friend class FGeometryStore;
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
	bool bDeformed = false;
	bool bMotionMarked = false; // in FObjectMotions' list of this frame
	bool bWasDeformed = false;
	uint32_t RefitsSinceBuild = 0;
	std::shared_ptr<FGeometryReleases> Releases; // told of the end; null without a store
	std::unique_ptr<FCoarserLevel> Coarser;      // in the making
};

using FRTGeometryRef = std::shared_ptr<FRTGeometry>;

} // namespace Lantern
