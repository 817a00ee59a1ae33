// FInstanceStore keeps the objects of a scene in a layout for gathering. Up to 64 objects that lie close together and are of
// about one size form a bucket. Each bucket has bounds, so that most are kept or left out whole. An object's transform and
// centre are floats relative to the centre of its cell. A cell is a cube of CellSize of the double-precision world.
//
// Instances of a section range share geometry address, first hit record and flags. These are one FInstanceBinding for each
// range: a compacted geometry or a new RTPSO changes bindings, never instances.
//
// Threads: one at a time; const functions may run on any number at once.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include <glm/glm.hpp>

#include "LanternScene/Instances/Culling.h"
#include "LanternScene/Memory/PagedArray.h"

namespace Lantern
{

/// Side of a cell, metres. The GPU adds a cell's offset, which is exact in fp32, and the position in the cell. Within 1.8 km
/// of the origin the sum is right to 0.1 mm.
inline constexpr double CellSize = CELL_SIZE;
/// Returns the cell whose centre is nearest.
glm::ivec3 FindCell(const glm::dvec3& World);
inline glm::dvec3 CellCenter(const glm::ivec3& Cell) { return glm::dvec3(Cell) * CellSize; }
/// Step of the grid on which a scene's origin lies, metres. It divides CellSize, so that offsets from origins to cells are
/// exact in fp32. The smaller the coordinates of rays, the more precise they are, see Docs/Architecture.md.
inline constexpr double OriginStep = 64.0;
/// Returns the point of that grid, within the cell of World, that is nearest.
glm::dvec3 FindOrigin(const glm::dvec3& World);
/// Returns the vector from an origin to the centre of Cell, metres.
inline glm::vec3 CellOffset(const glm::ivec3& Cell, const glm::dvec3& Origin) { return glm::vec3(CellCenter(Cell) - Origin); }

/// What all instances of a section range have in common.
struct FInstanceBinding
{
	uint64_t GeometryAddress = 0;     ///< 0: the geometry is not there (yet), and its objects are left out
	uint32_t TableOffsetAndFlags = 0; ///< as in FRTInstance
	uint32_t GeometrySlot = ~0u;      ///< the geometry whose priority rises while it is missing; ~0: none
	uint32_t MaskBits = ~0u;          ///< what FRTInstance::CustomIndexAndMask keeps
	friend bool operator==(const FInstanceBinding&, const FInstanceBinding&) = default;
};

/// What the store is told of an object.
struct FInstancePlacement
{
	glm::dmat4 Transform{1.0}; ///< object to world, affine
	glm::dvec3 Center{0};      ///< of the bounding sphere, in the world
	double Radius = -1.0;      ///< < 0: unknown, never left out
	uint32_t Range = 0;        ///< section range
	uint32_t Group = 0;        ///< > 0: kept or left out together with the other objects of the group
	uint8_t Mask = 0xff;
};

/// The plain record of one object. Exact tests and the plain gather read it.
struct FInstanceRecord
{
	glm::dvec3 Center{0};
	double Radius = 0; ///< UnboundedRadius if unknown
	glm::ivec3 Cell{0};
	uint32_t Range = 0;
	uint32_t Group = 0;  ///< index into the store's groups; 0: none
	uint32_t Member = 0; ///< place in the group's list
	uint32_t Bucket = ~0u;
	uint8_t Lane = 0; ///< in the bucket
	uint8_t Mask = 0;
	bool bAlive = false;
};

/// Objects in arrays, one lane for each; lanes from Count on are unused.
struct FInstanceBucket
{
	static constexpr uint32_t Capacity = 64;

	alignas(64) float X[Capacity], Y[Capacity], Z[Capacity], R[Capacity]; ///< spheres, relative to the cell's centre
	alignas(64) float Transform[Capacity][12];                            ///< rows, relative to the cell's centre
	uint32_t IndexAndMask[Capacity];                                      ///< as in FRTInstance
	uint32_t Range[Capacity];
	uint64_t SeenByShadow = 0, SeenByOthers = 0; ///< one bit a lane: the object's mask has such bits
	glm::ivec3 Cell{0};
	int32_t Level = 0;
	uint32_t Group = 0;
	uint32_t Count = 0;
	uint32_t Node = ~0u; ///< leaf of the k-d tree that finds the bucket; ~0: none
	bool bDirty = false;

	uint32_t Object(uint32_t Lane) const { return IndexAndMask[Lane] & 0xffffffu; }
	uint64_t Used() const { return Count == Capacity ? ~0ull : (1ull << Count) - 1; }
};

/// Bounds of all buckets in the world, in arrays; fp32, and users allow for its error. RMax < 0: the bucket is unused.
struct FBucketBounds
{
	std::vector<float> X, Y, Z, Extent; ///< sphere around the centres of the objects, Extent its radius
	std::vector<float> RMin, RMax;      ///< least and greatest radius of the objects' own spheres
	void Resize(size_t Count);
};

struct FInstanceGroup
{
	glm::dvec3 Center{0};
	double Radius = 0;
	std::vector<uint32_t> Members;
	bool bDirty = false;
};

/// Groups have indices of the store, which differ from the names that objects give them.
class FInstanceStore
{
public:
	FInstanceStore();
	~FInstanceStore();
	FInstanceStore(const FInstanceStore&) = delete;
	FInstanceStore& operator=(const FInstanceStore&) = delete;

	/// Adds the object or changes it. Object ≤ MaxInstanceIndex.
	void Set(uint32_t Object, const FInstancePlacement& Placement);
	void Remove(uint32_t Object);
	void SetRange(uint32_t Object, uint32_t Range);
	/// Returns whether objects of the range come to be there or cease to be, because their geometry does.
	bool SetBinding(uint32_t Range, const FInstanceBinding& Binding);

	const FInstanceRecord& GetRecord(uint32_t Object) const { return Records[Object]; }
	const TPagedArray<FInstanceRecord>& GetRecords() const { return Records; }
	/// Returns 12 floats: the rows of the object's transform, relative to its cell.
	const float* GetTransform(uint32_t Object) const;
	uint32_t GetCount() const { return Count; } ///< objects in the store
	const FInstanceBinding* GetBindings() const { return Bindings.data(); }
	const FInstanceBinding& GetBinding(uint32_t Range) const { return Bindings[Range]; }
	/// Tells whether some object's geometry is missing: a binding in use has no address.
	bool HasMissing() const { return MissingBindings > 0; }
	/// Changes with every change that instances could show.
	uint64_t GetRevision() const { return Revision; }

	/// Brings bounds of buckets and groups up to date, before gathering. Takes time in proportion to what changed.
	void Refresh();
	size_t GetBucketCapacity() const { return Buckets.size(); } ///< empty ones included
	const FInstanceBucket* GetBucket(size_t Index) const { return Buckets[Index].get(); }
	const FBucketBounds& GetBounds() const { return Bounds; }
	const std::vector<FInstanceGroup>& GetGroups() const { return Groups; } ///< [0] is none
	uint32_t GetBucketCount() const { return static_cast<uint32_t>(Buckets.size() - FreeBuckets.size()); }

private:
	struct FKey
	{
		glm::ivec3 Cell;
		int32_t Level;
		uint32_t Group;
		friend bool operator==(const FKey&, const FKey&) = default;
	};
	struct FKeyHash
	{
		size_t operator()(const FKey& Key) const;
	};
	/// A node of the k-d trees that find the bucket for a position: one tree for each cell, level of size and group.
	struct FNode
	{
		float Split = 0.0f;
		int32_t Axis = -1;          ///< -1: a leaf
		uint32_t Child[2] = {0, 0}; ///< in a leaf [0] is the bucket
		uint32_t Parent = ~0u;
	};
	static FKey MakeKey(const FInstanceRecord& Record);
	void Insert(uint32_t Object, const float* Rows, const glm::vec3& Place);
	void Extract(uint32_t Object);
	void Detach(uint32_t Object);
	void Place(uint32_t Object, uint32_t Bucket, const float* Rows, const glm::vec3& Place);
	void WriteLane(FInstanceBucket& Bucket, uint32_t Lane, uint32_t Object, const float* Rows, const glm::vec3& Place);
	void MoveLane(FInstanceBucket& From, uint32_t FromLane, uint32_t ToBucket);
	bool StaysInBucket(const FInstanceRecord& Record, const FInstanceRecord& New, const glm::vec3& Place);
	bool IsWithinBounds(uint32_t Bucket, const FInstanceRecord& New, const glm::vec3& Place) const;
	void MarkDirty(uint32_t Bucket);
	void RefreshBucket(uint32_t Bucket);
	void RefreshGroup(FInstanceGroup& Group);
	void MarkGroupDirty(uint32_t Group);
	uint32_t FindGroup(uint32_t Name);
	void JoinGroup(uint32_t Object);
	void LeaveGroup(uint32_t Object);
	uint32_t AllocateBucket(const FKey& Key, uint32_t Node);
	void FreeBucket(uint32_t Bucket);
	// InstanceTree.cpp
	uint32_t FindLeaf(const FKey& Key, const glm::vec3& Place);
	uint32_t AllocateNode();
	void Split(uint32_t Bucket);
	void RemoveLeaf(uint32_t Bucket);
	void MergeWithSibling(uint32_t Bucket);
	void Collapse(uint32_t Parent, uint32_t Kept, uint32_t Dropped);

	TPagedArray<FInstanceRecord> Records;
	std::vector<std::unique_ptr<FInstanceBucket>> Buckets;
	std::vector<uint32_t> FreeBuckets, DirtyBuckets;
	FBucketBounds Bounds;
	std::vector<FNode> Nodes;
	std::vector<uint32_t> FreeNodes;
	std::unordered_map<FKey, uint32_t, FKeyHash> Roots;
	std::vector<FInstanceGroup> Groups;
	std::vector<uint32_t> FreeGroups, DirtyGroups, GroupNames;
	std::unordered_map<uint32_t, uint32_t> GroupsByName;
	std::vector<FInstanceBinding> Bindings;
	std::vector<uint32_t> RangeUsers; // objects of each range
	uint32_t MissingBindings = 0;     // without an address, of ranges with users
	uint32_t Count = 0;
	uint64_t Revision = 1;
};

} // namespace Lantern
