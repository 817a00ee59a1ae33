// FGpuTableBase: dirty chunks, the size of the buffer, and the copies of a flush.
#include "LanternScene/Memory/GpuTable.h"

#include <utility>

namespace Lantern
{

namespace
{
constexpr uint64_t LeastBytes = 4096;
/// Flushes through which a buffer may be four times too large.
constexpr uint32_t ShrinkFlushes = 256;
} // namespace

void FGpuTableBase::Mark(uint64_t Index)
{
	bDirty = true;
	if (bAllDirty) { return; }
	const uint64_t Chunk = Index / ChunkEntries;
	if (Chunk >= IsChunkDirty.size()) { IsChunkDirty.resize(Chunk + 1, false); }
	if (IsChunkDirty[Chunk]) { return; }
	IsChunkDirty[Chunk] = true;
	DirtyChunks.push_back(static_cast<uint32_t>(Chunk));
}

void FGpuTableBase::MarkAll(uint64_t Count)
{
	for (const uint32_t Chunk : DirtyChunks) { IsChunkDirty[Chunk] = false; }
	DirtyChunks.clear();
	bDirty = bAllDirty = Count > 0;
}

FRTStatus FGpuTableBase::Resize(IRTDevice& Device, uint64_t Needed, const char* Name, TRTRef<IRTBuffer>& OutOld)
{
	const uint64_t Size = Buffer ? Buffer->GetDesc().Size : 0;
	FlushesTooLarge = Size / 4 > std::max(Needed, LeastBytes) ? FlushesTooLarge + 1 : 0;
	if (Size >= Needed && FlushesTooLarge <= ShrinkFlushes) { return FRTStatus::Success(); }
	const uint64_t NewSize = Size < Needed ? std::max(Needed, Size > 0 ? 2 * Size : LeastBytes) : 2 * std::max(Needed, LeastBytes);
	TRTRef<IRTBuffer> New;
	constexpr ERTBufferUsage Usage = ERTBufferUsage::Storage | ERTBufferUsage::CopyDest | ERTBufferUsage::CopySource;
	const FRTStatus Status = Device.CreateBuffer({NewSize, Usage, ERTMemory::Device, Name}, New.ReleaseAndGetAddress());
	FlushesTooLarge = 0;
	if (Status)
	{
		OutOld = std::exchange(Buffer, std::move(New));
		return Status;
	}
	// If memory is short, the buffer that is too large stays in use.
	return Status.Code == ERTResult::OutOfDeviceMemory && Size >= Needed ? FRTStatus::Success() : Status;
}

FRTStatus FGpuTableBase::CopyAll(IRTCommandList& List, FFrameUploads& Uploads, const FSource& Source)
{
	FUploadSlice Slice;
	MarkAll(Source.EntryCount);
	CopiedBytes = Source.EntryCount * Source.EntryBytes;
	if (FRTStatus S = Uploads.Allocate(CopiedBytes, Slice); !S) { return S; }
	Source.Copy(Source.Table, 0, Source.EntryCount, Slice.Data);
	List.CopyBuffer(Buffer.Get(), 0, Slice.Buffer, Slice.Offset, CopiedBytes);
	return FRTStatus::Success();
}

FRTStatus FGpuTableBase::CopyRuns(IRTCommandList& List, FFrameUploads& Uploads, const FSource& Source)
{
	std::sort(DirtyChunks.begin(), DirtyChunks.end());
	// Chunks behind the end are dropped: the table has become shorter since.
	const uint64_t Chunks = (Source.EntryCount + ChunkEntries - 1) / ChunkEntries;
	const auto End = std::lower_bound(DirtyChunks.begin(), DirtyChunks.end(), Chunks);
	if (End == DirtyChunks.begin()) { return FRTStatus::Success(); }
	FUploadSlice Slice;
	const auto Count = static_cast<uint64_t>(End - DirtyChunks.begin());
	if (FRTStatus S = Uploads.Allocate(Count * ChunkEntries * Source.EntryBytes, Slice); !S) { return S; }
	std::vector<FRTBufferRegion> Regions;
	for (auto Run = DirtyChunks.begin(); Run != End;)
	{
		auto Next = Run + 1;
		while (Next != End && *Next == *(Next - 1) + 1) { ++Next; }
		const uint64_t First = uint64_t(*Run) * ChunkEntries;
		const uint64_t Entries = std::min((uint64_t(*(Next - 1)) + 1) * ChunkEntries, Source.EntryCount) - First;
		Source.Copy(Source.Table, First, Entries, static_cast<uint8_t*>(Slice.Data) + CopiedBytes);
		Regions.push_back({First * Source.EntryBytes, Slice.Offset + CopiedBytes, Entries * Source.EntryBytes});
		CopiedBytes += Entries * Source.EntryBytes;
		Run = Next;
	}
	List.CopyBufferRegions(Buffer.Get(), Slice.Buffer, Regions.data(), static_cast<uint32_t>(Regions.size()));
	return FRTStatus::Success();
}

FRTStatus FGpuTableBase::Flush(IRTDevice& Device, IRTCommandList& List, FFrameUploads& Uploads, const FSource& Source, const char* Name)
{
	CopiedBytes = 0;
	const uint64_t Needed = Source.EntryBytes * Source.EntryCount;
	if (Source.EntryCount == 0)
	{
		MarkAll(0); // whatever was marked is gone
	}
	if ((!bDirty && FlushesTooLarge == 0) || Source.EntryCount == 0) { return FRTStatus::Success(); }
	TRTRef<IRTBuffer> Old;
	if (FRTStatus S = Resize(Device, Needed, Name, Old); !S) { return S; }
	const uint64_t Kept = std::min(HeldBytes, Needed);
	if (Old && !bAllDirty && Kept > 0)
	{
		// A table of a million entries would take many frames' time on the way through the CPU.
		const FRTBarrier Readable{Old.Get(), nullptr, ERTAccess::CopyWrite | UploadedAccess, ERTAccess::CopyRead};
		const FRTBarrier Written{Buffer.Get(), nullptr, ERTAccess::CopyWrite, ERTAccess::CopyWrite};
		List.Barriers(&Readable, 1);
		List.CopyBuffer(Buffer.Get(), 0, Old.Get(), 0, Kept);
		List.Barriers(&Written, 1);
	}
	HeldBytes = 0; // until all is recorded
	const FRTStatus Status = bAllDirty ? CopyAll(List, Uploads, Source) : CopyRuns(List, Uploads, Source);
	if (!Status)
	{
		MarkAll(Source.EntryCount);
		return Status;
	}
	HeldBytes = Needed;
	MarkAll(0);
	return FRTStatus::Success();
}

} // namespace Lantern
