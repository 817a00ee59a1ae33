// Which instances a frame's acceleration structure is built from, and writing them. FInstanceGather works in two
// phases over an FInstanceStore, each in parallel: Count decides and counts, Write puts the instances where they
// belong. The order of instances follows from the history of the store alone, never from threads.
// GatherStraightforward is the same in one loop: the oracle of the tests and the baseline of `lantern bench gather`.
#pragma once

#include <functional>
#include <vector>

#include "LanternRHI/RTTypes.h"
#include "LanternScene/Instances/InstanceStore.h"

namespace Lantern
{

/// Told of objects that would be seen but whose geometry is missing: its slot, and how many pixels across the object
/// is. From several threads at once; the same slot any number of times.
using FMissingGeometrySink = std::function<void(uint32_t Slot, float ScreenSize)>;

class FInstanceGather
{
public:
	/// Number of instances to write. The store was refreshed, and must not change until Write is done.
	uint32_t Count(const FInstanceStore& Store, const FCullingRule& Rule, const FMissingGeometrySink& Missing = {});
	/// After Count: whether another set of objects or other mask bits came out than from the Count before; true also
	/// wherever the store changed in between.
	bool HasChanged() const { return bChanged; }
	uint32_t GetCount() const { return Total; }
	/// Out: room for GetCount() instances, aligned to 16 bytes; only written, in ascending order (write-combined memory).
	/// Origin: what transforms are relative to.
	void Write(const FInstanceStore& Store, const glm::dvec3& Origin, FRTInstance* Out) const;

private:
	/// Of the objects of one bucket.
	struct FKept
	{
		uint64_t Shadow = 0, Others = 0; ///< what culling leaves
		uint64_t Written = 0;            ///< with bits left, and with geometry
		friend bool operator==(const FKept&, const FKept&) = default;
	};
	struct FPass;
	uint32_t CountBlock(const FPass& Pass, size_t Block, bool& OutChanged);
	FKept CullBucket(const FPass& Pass, size_t Bucket, uint32_t Class) const;
	uint64_t DropMissing(const FPass& Pass, const FInstanceBucket& Bucket, uint64_t Kept) const;
	void WriteBlock(const FInstanceStore& Store, const glm::dvec3& Origin, size_t Block, FRTInstance* Out) const;

	std::vector<FKept> Kept;            // per bucket
	std::vector<uint32_t> BlockOffsets; // first instance of each block of buckets
	std::vector<uint8_t> GroupBits;
	uint64_t SeenRevision = 0;
	uint32_t Total = 0;
	bool bChanged = true;
};

} // namespace Lantern
