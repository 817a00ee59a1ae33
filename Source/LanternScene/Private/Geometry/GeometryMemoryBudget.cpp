// FGeometryMemoryBudget: the limit, the device's count of bytes, and the last release.
#include "Geometry/GeometryMemoryBudget.h"

#include <algorithm>

#include "LanternCore/Config/ConsoleVariables.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<int32_t> CVarMemory("r.RT.Build.MemoryMB", 0,
    "Limits the peak memory of acceleration structures and their builds, in MiB. The limit counts structures that live, are "
    "being built or are being compacted, scratch, and released memory that the GPU still uses. 0: no limit.",
    {0, 1 << 20});

// The GPU lets go of released memory within the frames that are in flight.
constexpr uint64_t FramesUntilReleased = 8;
} // namespace

FGeometryMemoryBudget::FGeometryMemoryBudget(IRTDevice& InDevice, FGeometryStoreStats& InStats) : Device(InDevice), Stats(InStats) {}

uint64_t FGeometryMemoryBudget::GetLimit() const { return static_cast<uint64_t>(CVarMemory.GetOnRenderThread()) << 20; }

uint64_t FGeometryMemoryBudget::GetUsed() const
{
	const FRTMemoryStats Memory = Device.GetMemoryStats();
	return Memory.Geometry + Memory.Scene + Memory.Scratch;
}

uint64_t FGeometryMemoryBudget::GetRoom() const
{
	const uint64_t Limit = GetLimit();
	const uint64_t Used = Limit > 0 ? GetUsed() : 0;
	return Limit == 0 ? Unlimited : Limit > Used ? Limit - Used : 0;
}

bool FGeometryMemoryBudget::IsReleasing() const { return LastReleaseFrame > 0 && Frame - LastReleaseFrame < FramesUntilReleased; }

void FGeometryMemoryBudget::UpdatePeak() { Stats.PeakBytes = std::max(Stats.PeakBytes, GetUsed()); }

void FGeometryMemoryBudget::UpdateStats()
{
	const FRTMemoryStats Memory = Device.GetMemoryStats();
	Stats.LiveBytes = Memory.Geometry;
	Stats.ScratchBytes = Memory.Scratch;
	Stats.PeakBytes = std::max(Stats.PeakBytes, Memory.Geometry + Memory.Scene + Memory.Scratch);
}

} // namespace Lantern
