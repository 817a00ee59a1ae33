// FInstanceUploads: which buffer is free, and which is too large.
#include "LanternScene/Instances/InstanceUploads.h"

#include <algorithm>
#include <utility>

namespace Lantern
{

namespace
{
constexpr uint64_t LeastBytes = 1024 * sizeof(FRTInstance);
constexpr uint32_t MostIdleFrames = 120;
/// RecentBytes falls by half in about 90 frames.
constexpr uint64_t FadeShift = 7;
} // namespace

bool FInstanceUploads::IsTooLarge(const FPage& Page) const { return Page.Buffer->GetDesc().Size > 4 * std::max(RecentBytes, LeastBytes); }

FRTStatus FInstanceUploads::Reserve(uint32_t Count, IRTBuffer*& OutBuffer)
{
	const uint64_t Bytes = std::max<uint64_t>(1, Count) * sizeof(FRTInstance);
	RecentBytes = std::max(RecentBytes, Bytes);
	if (Current.Buffer) { Pages.push_back(std::exchange(Current, {})); }
	const FRTFence Completed = Device.GetCompletedFence();
	auto Best = Pages.end();
	for (auto Page = Pages.begin(); Page != Pages.end(); ++Page)
	{
		const bool bFree = !Page->bUsed && !Page->bLost && Page->Fence <= Completed;
		const bool bFits = Page->Buffer->GetDesc().Size >= Bytes && !IsTooLarge(*Page);
		if (bFree && bFits && (Best == Pages.end() || Page->Buffer->GetDesc().Size < Best->Buffer->GetDesc().Size)) { Best = Page; }
	}
	if (Best != Pages.end())
	{
		Current = std::move(*Best);
		Pages.erase(Best);
	}
	else
	{
		const FRTBufferDesc Desc{std::max(LeastBytes, Bytes + Bytes / 2), ERTBufferUsage::GeometryInput | ERTBufferUsage::Storage,
		    ERTMemory::Upload, "Instances"};
		if (FRTStatus S = Device.CreateBuffer(Desc, Current.Buffer.ReleaseAndGetAddress()); !S) { return S; }
	}
	Current.IdleFrames = 0;
	OutBuffer = Current.Buffer.Get();
	return FRTStatus::Success();
}

IRTBuffer* FInstanceUploads::Use()
{
	Current.bUsed = true;
	return Current.Buffer.Get();
}

void FInstanceUploads::EndFrame(bool bSubmitted, FRTFence Fence)
{
	RecentBytes -= RecentBytes >> FadeShift;
	const auto End = [&](FPage& Page) {
		if (!std::exchange(Page.bUsed, false) || !bSubmitted) { return; }
		Page.Fence = std::max(Page.Fence, Fence);
		Page.bLost |= Fence == 0;
	};
	End(Current);
	const FRTFence Completed = Device.GetCompletedFence();
	std::erase_if(Pages, [&](FPage& Page) {
		End(Page);
		// The command list that reads a lost page keeps its buffer alive.
		return Page.bLost || (Page.Fence <= Completed && (++Page.IdleFrames > MostIdleFrames || IsTooLarge(Page)));
	});
}

} // namespace Lantern
