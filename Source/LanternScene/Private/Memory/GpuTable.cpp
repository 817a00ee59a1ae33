// FGpuTableBase: dirty chunks, the size of the buffer, and the copies of a flush.
#include "LanternScene/Memory/GpuTable.h"

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

FRTStatus FGpuTableBase::Resize(IRTDevice& Device, uint64_t Needed, const char* Name, bool& OutNew)
{
	const uint64_t Size = Buffer ? Buffer->GetDesc().Size : 0;
	FlushesTooLarge = Size / 4 > std::max(Needed, LeastBytes) ? FlushesTooLarge + 1 : 0;
	OutNew = Size < Needed || FlushesTooLarge > ShrinkFlushes;
	if (!OutNew) { return FRTStatus::Success(); }
	const uint64_t NewSize = Size < Needed ? std::max(Needed, Size > 0 ? 2 * Size : LeastBytes) : 2 * std::max(Needed, LeastBytes);
	TRTRef<IRTBuffer> New;
	const FRTBufferDesc Desc{NewSize, ERTBufferUsage::Storage | ERTBufferUsage::CopyDest, ERTMemory::Device, Name};
	const FRTStatus Status = Device.CreateBuffer(Desc, New.ReleaseAndGetAddress());
	FlushesTooLarge = 0;
	if (Status)
	{
		Buffer = std::move(New);
		return Status;
	}
	OutNew = false;
	// If memory is short, the buffer that is too large stays in use.
	return Status.Code == ERTResult::OutOfDeviceMemory && Size >= Needed ? FRTStatus::Success() : Status;
}

FRTStatus FGpuTableBase::CopyRuns(IRTCommandList& List, FFrameUploads& Uploads, const uint8_t* Data, uint64_t ChunkBytes, uint64_t Bytes)
{
	std::sort(DirtyChunks.begin(), DirtyChunks.end());
	// Chunks behind the end are dropped: the table has become shorter since.
	const uint64_t Chunks = (Bytes + ChunkBytes - 1) / ChunkBytes;
	const auto End = std::lower_bound(DirtyChunks.begin(), DirtyChunks.end(), Chunks);
	if (End == DirtyChunks.begin()) { return FRTStatus::Success(); }
	FUploadSlice Slice;
	if (FRTStatus S = Uploads.Allocate(static_cast<uint64_t>(End - DirtyChunks.begin()) * ChunkBytes, Slice); !S) { return S; }
	std::vector<FRTBufferRegion> Regions;
	for (auto Run = DirtyChunks.begin(); Run != End;)
	{
		auto Next = Run + 1;
		while (Next != End && *Next == *(Next - 1) + 1) { ++Next; }
		const uint64_t First = *Run * ChunkBytes, Size = std::min((*(Next - 1) + 1) * ChunkBytes, Bytes) - First;
		std::memcpy(static_cast<uint8_t*>(Slice.Data) + CopiedBytes, Data + First, Size);
		Regions.push_back({First, Slice.Offset + CopiedBytes, Size});
		CopiedBytes += Size;
		Run = Next;
	}
	List.CopyBufferRegions(Buffer.Get(), Slice.Buffer, Regions.data(), static_cast<uint32_t>(Regions.size()));
	return FRTStatus::Success();
}

FRTStatus FGpuTableBase::Flush(IRTDevice& Device, IRTCommandList& List, FFrameUploads& Uploads, const void* Data, uint64_t EntryBytes,
    uint64_t EntryCount, const char* Name)
{
	CopiedBytes = 0;
	const uint64_t Needed = EntryBytes * EntryCount;
	if (EntryCount == 0)
	{
		MarkAll(0); // whatever was marked is gone
	}
	if ((!bDirty && FlushesTooLarge == 0) || EntryCount == 0) { return FRTStatus::Success(); }
	bool bNew = false;
	if (FRTStatus S = Resize(Device, Needed, Name, bNew); !S) { return S; }
	if (bNew || bAllDirty)
	{
		FUploadSlice Slice;
		MarkAll(EntryCount);
		if (FRTStatus S = Uploads.Push(Data, Needed, Slice); !S) { return S; }
		List.CopyBuffer(Buffer.Get(), 0, Slice.Buffer, Slice.Offset, Needed);
		CopiedBytes = Needed;
	}
	else if (FRTStatus S = CopyRuns(List, Uploads, static_cast<const uint8_t*>(Data), ChunkEntries * EntryBytes, Needed); !S) { return S; }
	MarkAll(0);
	return FRTStatus::Success();
}

} // namespace Lantern
