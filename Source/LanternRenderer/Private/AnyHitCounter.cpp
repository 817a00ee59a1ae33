#include "LanternRenderer/AnyHitCounter.h"

#include <cstring>
#include <iterator>

#include "LanternCore/Config/ConsoleVariables.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<bool> CVarCount("r.RT.Opacity.Count", false,
    "Counts how often alpha tests run under rays. Costs time in each of them: for "
    "measurements only.");
constexpr uint64_t CounterBytes = 4;
} // namespace

bool FAnyHitCounter::IsWanted() { return CVarCount.GetOnRenderThread(); }

std::vector<std::pair<std::string, std::string>> FAnyHitCounter::GetDefines()
{
	return IsWanted() ? std::vector<std::pair<std::string, std::string>>{{"COUNT_ANY_HITS", "1"}}
	                  : std::vector<std::pair<std::string, std::string>>{};
}

FRTStatus FAnyHitCounter::Begin()
{
	Get();
	bActive = false;
	if (!IsWanted()) { return FRTStatus::Success(); }
	if (!Counter)
	{
		const ERTBufferUsage Usage = ERTBufferUsage::Storage | ERTBufferUsage::CopySource | ERTBufferUsage::CopyDest;
		const FRTBufferDesc Desc{CounterBytes, Usage, ERTMemory::Device, "AnyHitCounter"};
		if (FRTStatus S = Device.CreateBuffer(Desc, Counter.ReleaseAndGetAddress()); !S) { return S; }
	}
	Current = (Current + 1) % std::size(Readbacks);
	FReadback& Readback = Readbacks[Current];
	if (!Readback.Buffer)
	{
		const FRTBufferDesc Desc{CounterBytes, ERTBufferUsage::CopyDest, ERTMemory::Readback, "AnyHitReadback"};
		if (FRTStatus S = Device.CreateBuffer(Desc, Readback.Buffer.ReleaseAndGetAddress()); !S) { return S; }
	}
	bActive = !Readback.bPending; // the GPU is further behind than it can be: this frame goes uncounted
	return FRTStatus::Success();
}

void FAnyHitCounter::AddClear(FFrameGraph& Graph)
{
	if (!bActive) { return; }
	Graph.AddPass("ClearAnyHits", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.NeverCull();
		return [Buffer = Counter](FPassContext& Pass) {
			// Passes that trace reach the counter by its address: the graph does not see them.
			constexpr ERTAccess Shaders = ERTAccess::ShaderRead | ERTAccess::StorageWrite;
			const FRTBarrier Before{Buffer.Get(), nullptr, ERTAccess::CopyRead, ERTAccess::CopyWrite};
			const FRTBarrier After{Buffer.Get(), nullptr, ERTAccess::CopyWrite, Shaders};
			Pass.Commands().Barriers(&Before, 1);
			Pass.Commands().FillBuffer(Buffer.Get(), 0, CounterBytes, 0);
			Pass.Commands().Barriers(&After, 1);
		};
	});
}

void FAnyHitCounter::AddRead(FFrameGraph& Graph)
{
	if (!bActive) { return; }
	Graph.AddPass("ReadAnyHits", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.NeverCull();
		return [From = Counter, To = Readbacks[Current].Buffer](FPassContext& Pass) {
			constexpr ERTAccess Shaders = ERTAccess::ShaderRead | ERTAccess::StorageWrite;
			const FRTBarrier Before[] = {
			    {From.Get(), nullptr, Shaders, ERTAccess::CopyRead}, {To.Get(), nullptr, ERTAccess::HostRead, ERTAccess::CopyWrite}};
			const FRTBarrier After{To.Get(), nullptr, ERTAccess::CopyWrite, ERTAccess::HostRead};
			Pass.Commands().Barriers(Before, 2);
			Pass.Commands().CopyBuffer(To.Get(), 0, From.Get(), 0, CounterBytes);
			Pass.Commands().Barriers(&After, 1);
		};
	});
}

void FAnyHitCounter::Submitted(FRTFence Fence)
{
	if (bActive && Fence != 0)
	{
		Readbacks[Current].Fence = Fence;
		Readbacks[Current].bPending = true;
	}
	bActive = false;
}

const FAnyHitCounts& FAnyHitCounter::Get()
{
	const FRTFence Done = Device.GetCompletedFence();
	for (size_t Step = 1; Step <= std::size(Readbacks); ++Step) // oldest first
	{
		FReadback& Readback = Readbacks[(Current + Step) % std::size(Readbacks)];
		if (!Readback.bPending || Readback.Fence > Done) { continue; }
		uint32_t Calls = 0;
		std::memcpy(&Calls, Readback.Buffer->GetMapped(), sizeof(Calls));
		Readback.bPending = false;
		Counts.LastFrame = Calls;
		Counts.Total += Calls;
		++Counts.Frames;
	}
	return Counts;
}

} // namespace Lantern
