// FBuildScratch: growth, reserve and shrinking of the scratch buffer.
#include "Geometry/BuildScratch.h"

#include <algorithm>
#include <utility>

namespace Lantern
{

namespace
{
constexpr uint64_t SmallBytes = 256 << 10; // not worth a new allocation
} // namespace

FBuildScratch::FBuildScratch(IRTDevice& InDevice, const FGeometrySlots& InSlots, FGeometryMemoryBudget& InMemory)
    : Device(InDevice),
      Slots(InSlots),
      Memory(InMemory)
{}

uint64_t FBuildScratch::GetGrowth(uint64_t Bytes) const
{
	Bytes = std::max({Bytes, SceneReserve, Slots.GetDynamicCount() > 0 ? RefitReserve : 0});
	const bool bEnough = Buffer && Buffer->GetDesc().Size >= Bytes;
	return bEnough ? 0 : (std::max<uint64_t>(Bytes, 1) + Step - 1) / Step * Step;
}

FRTStatus FBuildScratch::Grow(uint64_t Bytes)
{
	FrameNeed = std::max(FrameNeed, Bytes);
	const uint64_t Growth = GetGrowth(Bytes);
	if (Growth == 0) { return FRTStatus::Success(); }
	const FRTBufferDesc Desc{Growth, ERTBufferUsage::Scratch | ERTBufferUsage::Storage, ERTMemory::Device, "BuildScratch"};
	TRTRef<IRTBuffer> Larger;
	if (FRTStatus S = Device.CreateBuffer(Desc, Larger.ReleaseAndGetAddress()); !S) { return S; }
	Memory.UpdatePeak();
	if (Buffer) { Memory.NoteRelease(); }
	Buffer = std::move(Larger);
	return FRTStatus::Success();
}

FRTStatus FBuildScratch::Reserve(uint64_t Bytes, IRTBuffer*& Out)
{
	SceneReserve = Bytes;
	const FRTStatus Status = Grow(Bytes);
	Out = Buffer.Get();
	return Status;
}

bool FBuildScratch::IsTooLarge() const
{
	const uint64_t Size = Buffer ? Buffer->GetDesc().Size : 0;
	return Size > SmallBytes && RecentNeed * 2 < Size;
}

void FBuildScratch::EndFrame()
{
	RecentNeed = std::max(RecentNeed, std::exchange(FrameNeed, 0));
	if (!IsTooLarge())
	{
		FramesTooLarge = 0;
		RecentNeed = 0;
		return;
	}
	if (++FramesTooLarge < ShrinkAfterFrames) { return; }
	Buffer = nullptr; // whoever needs it next makes it anew, as small as will do
	Memory.NoteRelease();
	FramesTooLarge = 0;
	RecentNeed = 0;
}

} // namespace Lantern
