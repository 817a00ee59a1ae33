// FInstanceGather selects and writes the instances from which a frame's acceleration structure is built. It works in two
// phases over an FInstanceStore, each in parallel: Count culls and counts, Write writes the instances to their places.
// The order of instances follows from the history of the store alone, never from threads.
#pragma once

#include <functional>
#include <vector>

#include "LanternRHI/RTTypes.h"
#include "LanternScene/Instances/InstanceStore.h"

namespace Lantern
{

/// Receives the geometry slot and the size, pixels across, of each object that is seen but whose geometry is missing.
/// Called from several threads at once, any number of times for a slot.
using FMissingGeometrySink = std::function<void(uint32_t Slot, float ScreenSize)>;

class FInstanceGather
{
public:
	/// Returns the number of instances to write. The store must have been refreshed, and must not change until Write returns.
	uint32_t Count(const FInstanceStore& Store, const FCullingRule& Rule, const FMissingGeometrySink& Missing = {});
	/// Tells, after Count, whether other objects or mask bits were kept than by the previous Count. It is true, too, if the
	/// store changed in between.
	bool HasChanged() const { return bChanged; }
	uint32_t GetCount() const { return Total; }
	/// Writes GetCount() instances to Out, whose transforms are relative to Origin. Out is aligned to 16 bytes. It is only
	/// written, never read, each task's part in ascending order: the memory may be write-combined.
	void Write(const FInstanceStore& Store, const glm::dvec3& Origin, FRTInstance* Out) const;

private:
	/// One bit for each object of a bucket.
	struct FKept
	{
		uint64_t Shadow = 0, Others = 0; ///< culling keeps it for shadow rays, for all other rays
		uint64_t Written = 0;            ///< it has mask bits left, and its geometry is there
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
