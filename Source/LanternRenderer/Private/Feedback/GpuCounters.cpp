// Counters on the GPU: cleared before the frame traces, copied to the readback ring behind it.
#include "Feedback/GpuCounters.h"

#include <algorithm>

namespace Lantern
{

namespace
{
constexpr ERTAccess ShaderAccess = ERTAccess::ShaderRead | ERTAccess::StorageWrite;

std::span<const uint32_t> GetCounts(const TReadbackRing<uint32_t>::FEntry& Entry)
{
	return {static_cast<const uint32_t*>(Entry.Buffer->GetMapped()), Entry.Notes};
}
} // namespace

FGpuCounters::FGpuCounters(IRTDevice& InDevice, const char* InName)
    : Device(InDevice),
      Name(InName),
      Ring(InDevice, InName, ERTBufferUsage::CopyDest)
{}

void FGpuCounters::BeginFrame(uint32_t FlightIndex, const FTake& Take)
{
	Ring.BeginFrame(FlightIndex, [&](const FRing::FEntry& Old) { Take(GetCounts(Old)); });
}

void FGpuCounters::TakeAll(const FTake& Take)
{
	Ring.TakeAll([&](const FRing::FEntry& Old) { Take(GetCounts(Old)); });
}

FRTStatus FGpuCounters::Start(uint32_t Count)
{
	if (!Counters || Counters->GetDesc().Size < Count * 4ull)
	{
		// Half as much again: scenes that grow allocate rarely.
		const uint64_t Bytes = Counters ? std::max(1024ull, (Count + Count / 2) * 4ull) : Count * 4ull;
		const ERTBufferUsage Usage = ERTBufferUsage::Storage | ERTBufferUsage::CopySource | ERTBufferUsage::CopyDest;
		if (FRTStatus S = Device.CreateBuffer({Bytes, Usage, ERTMemory::Device, Name.c_str()}, Counters.ReleaseAndGetAddress()); !S)
		{
			return S;
		}
	}
	FRTStatus Status;
	FRing::FEntry* const Entry = Ring.Write(Counters->GetDesc().Size, Status);
	if (!Entry) { return Status; }
	Entry->Notes = Count;
	bActive = true;
	return FRTStatus::Success();
}

void FGpuCounters::AddClear(FFrameGraph& Graph)
{
	if (!bActive) { return; }
	Graph.AddPass(("Clear" + Name).c_str(), [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.NeverCull();
		return [Buffer = Counters, Bytes = Ring.GetCurrent()->Notes * 4ull](FPassContext& Pass) {
			// Passes that trace reach the counters by their address: the graph does not see them.
			const FRTBarrier Before{Buffer.Get(), nullptr, ERTAccess::CopyRead, ERTAccess::CopyWrite};
			const FRTBarrier After{Buffer.Get(), nullptr, ERTAccess::CopyWrite, ShaderAccess};
			Pass.Commands().Barriers(&Before, 1);
			Pass.Commands().FillBuffer(Buffer.Get(), 0, Bytes, 0);
			Pass.Commands().Barriers(&After, 1);
		};
	});
}

void FGpuCounters::AddRead(FFrameGraph& Graph)
{
	if (!bActive) { return; }
	Graph.AddPass(("Read" + Name).c_str(), [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.NeverCull();
		const FRing::FEntry& Entry = *Ring.GetCurrent();
		return [From = Counters, To = Entry.Buffer, Bytes = Entry.Notes * 4ull](FPassContext& Pass) {
			const FRTBarrier Before[] = {
			    {From.Get(), nullptr, ShaderAccess, ERTAccess::CopyRead}, {To.Get(), nullptr, ERTAccess::HostRead, ERTAccess::CopyWrite}};
			const FRTBarrier After{To.Get(), nullptr, ERTAccess::CopyWrite, ERTAccess::HostRead};
			Pass.Commands().Barriers(Before, 2);
			Pass.Commands().CopyBuffer(To.Get(), 0, From.Get(), 0, Bytes);
			Pass.Commands().Barriers(&After, 1);
		};
	});
}

void FGpuCounters::EndFrame(bool bSubmitted)
{
	Ring.EndFrame(bSubmitted);
	bActive = false;
}

} // namespace Lantern
