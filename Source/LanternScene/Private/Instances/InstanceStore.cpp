// FInstanceStore: objects, bindings and buckets. The trees and groups are in InstanceTree.cpp.
#include "LanternScene/Instances/InstanceStore.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

#include "LanternCore/Tasks/Tasks.h"

namespace Lantern
{

namespace
{
constexpr uint32_t None = ~0u;
constexpr int32_t GroupLevel = 1000;
constexpr int32_t UnboundedLevel = 1001;
/// Returns the level of size. Two radii of one level differ by less than a factor of two.
int32_t LevelOf(double Radius)
{
	if (Radius >= UnboundedRadius) { return UnboundedLevel; }
	return std::clamp(static_cast<int32_t>(std::ilogb(std::max(Radius, 1e-3))), -10, 40);
}

void MakeRows(const glm::dmat4& Transform, const glm::dvec3& Center, float Out[12])
{
	for (int Row = 0; Row < 3; ++Row)
	{
		for (int Column = 0; Column < 3; ++Column) { Out[4 * Row + Column] = static_cast<float>(Transform[Column][Row]); }
		Out[4 * Row + 3] = static_cast<float>(Transform[3][Row] - Center[Row]);
	}
}
} // namespace

namespace
{
/// Returns the nearest number of steps in −Most … Most; −Most if At is not a number.
double FindStep(double At, double Step, double Most)
{
	const double Nearest = std::floor(At / Step + 0.5);
	return Nearest > -Most ? std::min(Nearest, Most) : -Most;
}
} // namespace

glm::ivec3 FindCell(const glm::dvec3& World)
{
	// Beyond Most, and for NaN, positions in a cell are large, but nothing overflows.
	constexpr double Most = 1 << 30;
	glm::ivec3 Cell;
	for (int Axis = 0; Axis < 3; ++Axis) { Cell[Axis] = static_cast<int32_t>(FindStep(World[Axis], CellSize, Most)); }
	return Cell;
}

glm::dvec3 FindOrigin(const glm::dvec3& World)
{
	const glm::dvec3 Center = CellCenter(FindCell(World));
	glm::dvec3 Origin;
	for (int Axis = 0; Axis < 3; ++Axis)
	{
		Origin[Axis] = Center[Axis] + OriginStep * FindStep(World[Axis] - Center[Axis], OriginStep, 0.5 * CellSize / OriginStep);
	}
	return Origin;
}

void FBucketBounds::Resize(size_t Count)
{
	for (std::vector<float>* Array : {&X, &Y, &Z, &Extent, &RMin}) { Array->resize(Count, 0.0f); }
	RMax.resize(Count, -1.0f);
}

size_t FInstanceStore::FKeyHash::operator()(const FKey& Key) const
{
	uint64_t Hash = 0;
	for (const uint32_t Part : {uint32_t(Key.Cell.x), uint32_t(Key.Cell.y), uint32_t(Key.Cell.z), uint32_t(Key.Level), Key.Group})
	{
		Hash = (Hash ^ Part) * 0x9e3779b97f4a7c15ull;
		Hash ^= Hash >> 29;
	}
	return Hash;
}

FInstanceStore::FInstanceStore() : Groups(1), GroupNames(1, 0) {}
FInstanceStore::~FInstanceStore() = default;

FInstanceStore::FKey FInstanceStore::MakeKey(const FInstanceRecord& Record)
{
	return {Record.Cell, Record.Group > 0 ? GroupLevel : LevelOf(Record.Radius), Record.Group};
}

const float* FInstanceStore::GetTransform(uint32_t Object) const
{
	const FInstanceRecord& Record = Records[Object];
	return Buckets[Record.Bucket]->Transform[Record.Lane];
}

void FInstanceStore::Set(uint32_t Object, const FInstancePlacement& Placement)
{
	++Revision;
	if (Object >= Records.Num()) { Records.Resize(size_t(Object) + 1); }
	FInstanceRecord& Record = Records[Object];
	FInstanceRecord New = Record;
	New.Cell = FindCell(glm::dvec3(Placement.Transform[3]));
	const glm::dvec3 Center = CellCenter(New.Cell);
	const bool bBounded = Placement.Radius >= 0.0 && std::isfinite(glm::dot(Placement.Center, Placement.Center));
	New.Center = bBounded ? Placement.Center : Center;
	New.Radius = bBounded ? std::min(Placement.Radius, UnboundedRadius) : UnboundedRadius;
	New.Mask = Placement.Mask;
	const glm::vec3 At(New.Center - Center);
	float Rows[12];
	MakeRows(Placement.Transform, Center, Rows);
	const bool bSameGroup = Record.bAlive && GroupNames[Record.Group] == Placement.Group;
	if (bSameGroup && StaysInBucket(Record, New, At))
	{
		MarkGroupDirty(New.Group);
		Record = New;
		WriteLane(*Buckets[New.Bucket], New.Lane, Object, Rows, At);
		if (Record.Range != Placement.Range) { SetRange(Object, Placement.Range); }
		return;
	}
	if (Record.bAlive) { Detach(Object); }
	New.Group = FindGroup(Placement.Group);
	New.Range = Placement.Range;
	New.bAlive = true;
	Records[Object] = New;
	++Count;
	if (Placement.Range >= Bindings.size()) { SetBinding(Placement.Range, {}); }
	if (RangeUsers[Placement.Range]++ == 0 && Bindings[Placement.Range].GeometryAddress == 0) { ++MissingBindings; }
	JoinGroup(Object);
	Insert(Object, Rows, At);
}

bool FInstanceStore::StaysInBucket(const FInstanceRecord& Record, const FInstanceRecord& New, const glm::vec3& Place)
{
	if (!(MakeKey(New) == MakeKey(Record))) { return false; }
	const uint32_t Bucket = Record.Bucket;
	if (IsWithinBounds(Bucket, New, Place)) { return true; }
	if (Buckets[Bucket]->Node == None || FindLeaf(MakeKey(New), Place) != Bucket) { return false; }
	MarkDirty(Bucket);
	return true;
}

bool FInstanceStore::IsWithinBounds(uint32_t Bucket, const FInstanceRecord& New, const glm::vec3& Place) const
{
	const glm::vec3 World(CellCenter(New.Cell) + glm::dvec3(Place));
	const glm::vec3 Away = World - glm::vec3(Bounds.X[Bucket], Bounds.Y[Bucket], Bounds.Z[Bucket]);
	const float Radius = static_cast<float>(New.Radius);
	return glm::dot(Away, Away) <= 0.98f * Bounds.Extent[Bucket] * Bounds.Extent[Bucket] && Radius >= Bounds.RMin[Bucket] &&
	       Radius <= Bounds.RMax[Bucket];
}

void FInstanceStore::Detach(uint32_t Object)
{
	FInstanceRecord& Record = Records[Object];
	assert(Record.bAlive);
	Extract(Object);
	LeaveGroup(Object);
	if (--RangeUsers[Record.Range] == 0 && Bindings[Record.Range].GeometryAddress == 0) { --MissingBindings; }
	Record.bAlive = false;
	--Count;
}

void FInstanceStore::Remove(uint32_t Object)
{
	++Revision;
	Detach(Object);
	while (!Records.IsEmpty() && !Records.Last().bAlive) { Records.Resize(Records.Num() - 1); }
}

void FInstanceStore::SetRange(uint32_t Object, uint32_t Range)
{
	++Revision;
	if (Range >= Bindings.size()) { SetBinding(Range, {}); }
	FInstanceRecord& Record = Records[Object];
	if (--RangeUsers[Record.Range] == 0 && Bindings[Record.Range].GeometryAddress == 0) { --MissingBindings; }
	if (RangeUsers[Range]++ == 0 && Bindings[Range].GeometryAddress == 0) { ++MissingBindings; }
	Record.Range = Range;
	Buckets[Record.Bucket]->Range[Record.Lane] = Range;
}

bool FInstanceStore::SetBinding(uint32_t Range, const FInstanceBinding& Binding)
{
	if (Range >= Bindings.size())
	{
		Bindings.resize(Range + 1);
		RangeUsers.resize(Range + 1, 0);
	}
	FInstanceBinding& Old = Bindings[Range];
	if (Old == Binding) { return false; }
	const bool bSeen = RangeUsers[Range] > 0 && (Old.GeometryAddress == 0) != (Binding.GeometryAddress == 0);
	++Revision;
	if (RangeUsers[Range] > 0)
	{
		MissingBindings -= Old.GeometryAddress == 0 ? 1 : 0;
		MissingBindings += Binding.GeometryAddress == 0 ? 1 : 0;
	}
	Old = Binding;
	return bSeen;
}

void FInstanceStore::WriteLane(FInstanceBucket& Bucket, uint32_t Lane, uint32_t Object, const float* Rows, const glm::vec3& Place)
{
	const FInstanceRecord& Record = Records[Object];
	Bucket.X[Lane] = Place.x;
	Bucket.Y[Lane] = Place.y;
	Bucket.Z[Lane] = Place.z;
	Bucket.R[Lane] = static_cast<float>(Record.Radius);
	std::memcpy(Bucket.Transform[Lane], Rows, sizeof(Bucket.Transform[Lane]));
	Bucket.IndexAndMask[Lane] = Object | (uint32_t(Record.Mask) << 24);
	Bucket.Range[Lane] = Record.Range;
	const uint64_t Bit = 1ull << Lane;
	Bucket.SeenByShadow = (Bucket.SeenByShadow & ~Bit) | ((Record.Mask & MASK_CASTERS) ? Bit : 0);
	Bucket.SeenByOthers = (Bucket.SeenByOthers & ~Bit) | ((Record.Mask & ~MASK_CASTERS) ? Bit : 0);
}

void FInstanceStore::Place(uint32_t Object, uint32_t Bucket, const float* Rows, const glm::vec3& Place)
{
	FInstanceBucket& Into = *Buckets[Bucket];
	const uint32_t Lane = Into.Count++;
	Records[Object].Bucket = Bucket;
	Records[Object].Lane = static_cast<uint8_t>(Lane);
	WriteLane(Into, Lane, Object, Rows, Place);
	MarkDirty(Bucket);
}

void FInstanceStore::MoveLane(FInstanceBucket& From, uint32_t FromLane, uint32_t ToBucket)
{
	Place(From.Object(FromLane), ToBucket, From.Transform[FromLane], {From.X[FromLane], From.Y[FromLane], From.Z[FromLane]});
}

void FInstanceStore::Insert(uint32_t Object, const float* Rows, const glm::vec3& At)
{
	const FKey Key = MakeKey(Records[Object]);
	uint32_t Bucket = FindLeaf(Key, At);
	while (Buckets[Bucket]->Count == FInstanceBucket::Capacity)
	{
		Split(Bucket);
		Bucket = FindLeaf(Key, At);
	}
	Place(Object, Bucket, Rows, At);
}

void FInstanceStore::Extract(uint32_t Object)
{
	const uint32_t Index = Records[Object].Bucket, Lane = Records[Object].Lane;
	FInstanceBucket& Bucket = *Buckets[Index];
	const uint32_t Last = --Bucket.Count;
	if (Lane != Last)
	{
		const uint32_t Moved = Bucket.Object(Last);
		WriteLane(Bucket, Lane, Moved, Bucket.Transform[Last], {Bucket.X[Last], Bucket.Y[Last], Bucket.Z[Last]});
		Records[Moved].Lane = static_cast<uint8_t>(Lane);
	}
	MarkDirty(Index);
	Records[Object].Bucket = None;
	if (Bucket.Count == 0)
	{
		if (Bucket.Node != None) { RemoveLeaf(Index); }
		FreeBucket(Index);
	}
	else if (Bucket.Count < FInstanceBucket::Capacity / 4 && Bucket.Node != None) { MergeWithSibling(Index); }
}

uint32_t FInstanceStore::AllocateBucket(const FKey& Key, uint32_t Node)
{
	uint32_t Index = static_cast<uint32_t>(Buckets.size());
	if (FreeBuckets.empty())
	{
		Buckets.emplace_back();
		Bounds.Resize(Buckets.size());
	}
	else
	{
		Index = FreeBuckets.back();
		FreeBuckets.pop_back();
	}
	Buckets[Index] = std::make_unique<FInstanceBucket>();
	FInstanceBucket& Bucket = *Buckets[Index];
	Bucket.Cell = Key.Cell;
	Bucket.Level = Key.Level;
	Bucket.Group = Key.Group;
	Bucket.Node = Node;
	// Kernels compute with the unused lanes, too.
	for (float* Array : {Bucket.X, Bucket.Y, Bucket.Z, Bucket.R}) { std::fill_n(Array, FInstanceBucket::Capacity, 0.0f); }
	return Index;
}

void FInstanceStore::FreeBucket(uint32_t Index)
{
	Buckets[Index].reset();
	Bounds.RMax[Index] = -1.0f;
	FreeBuckets.push_back(Index);
}

void FInstanceStore::MarkDirty(uint32_t Index)
{
	FInstanceBucket& Bucket = *Buckets[Index];
	if (Bucket.bDirty) { return; }
	Bucket.bDirty = true;
	DirtyBuckets.push_back(Index);
}

void FInstanceStore::RefreshBucket(uint32_t Index)
{
	FInstanceBucket& Bucket = *Buckets[Index];
	Bucket.bDirty = false;
	glm::vec3 Min(Bucket.X[0], Bucket.Y[0], Bucket.Z[0]), Max = Min;
	float RMin = Bucket.R[0], RMax = RMin;
	for (uint32_t I = 1; I < Bucket.Count; ++I)
	{
		const glm::vec3 At(Bucket.X[I], Bucket.Y[I], Bucket.Z[I]);
		Min = glm::min(Min, At);
		Max = glm::max(Max, At);
		RMin = std::min(RMin, Bucket.R[I]);
		RMax = std::max(RMax, Bucket.R[I]);
	}
	const glm::vec3 Middle = 0.5f * (Min + Max);
	float Extent2 = 0.0f;
	for (uint32_t I = 0; I < Bucket.Count; ++I)
	{
		const glm::vec3 Away = glm::vec3(Bucket.X[I], Bucket.Y[I], Bucket.Z[I]) - Middle;
		Extent2 = std::max(Extent2, glm::dot(Away, Away));
	}
	const glm::vec3 World(CellCenter(Bucket.Cell) + glm::dvec3(Middle));
	Bounds.X[Index] = World.x;
	Bounds.Y[Index] = World.y;
	Bounds.Z[Index] = World.z;
	Bounds.Extent[Index] = 1.00001f * std::sqrt(Extent2) + 1e-6f * glm::length(Middle);
	Bounds.RMin[Index] = RMin;
	Bounds.RMax[Index] = RMax;
}

void FInstanceStore::Refresh()
{
	std::erase_if(DirtyBuckets, [&](uint32_t Index) { return !Buckets[Index] || !Buckets[Index]->bDirty; });
	// A bucket that was freed and allocated again is listed twice.
	std::sort(DirtyBuckets.begin(), DirtyBuckets.end());
	DirtyBuckets.erase(std::unique(DirtyBuckets.begin(), DirtyBuckets.end()), DirtyBuckets.end());
	ParallelFor(DirtyBuckets.size(), 64, [&](size_t Begin, size_t End) {
		for (size_t I = Begin; I < End; ++I) { RefreshBucket(DirtyBuckets[I]); }
	});
	DirtyBuckets.clear();
	for (const uint32_t Group : DirtyGroups)
	{
		if (Groups[Group].bDirty) { RefreshGroup(Groups[Group]); }
	}
	DirtyGroups.clear();
}

} // namespace Lantern
