#include "LanternScene/GpuTable.h"

namespace Lantern
{

void FGpuTableBase::Mark(uint64_t Index)
{
	const uint64_t Chunk = Index / ChunkEntries;
	if (Chunk >= DirtyChunks.size()) { DirtyChunks.resize(Chunk + 1, false); }
	DirtyChunks[Chunk] = true;
	bDirty = true;
}

void FGpuTableBase::MarkAll(uint64_t Count)
{
	DirtyChunks.assign((Count + ChunkEntries - 1) / ChunkEntries, true);
	bDirty = Count > 0;
}

FRTStatus FGpuTableBase::Flush(IRTDevice& Device, IRTCommandList& List, FFrameUploads& Uploads, const void* Data, uint64_t EntryBytes,
                               uint64_t EntryCount, const char* Name)
{
	CopiedBytes = 0;
	if (!bDirty || EntryCount == 0) { return FRTStatus::Success(); }
	const uint64_t Needed = EntryBytes * EntryCount;
	if (!Buffer || Buffer->GetDesc().Size < Needed)
	{
		const uint64_t Size = std::max<uint64_t>(Needed, Buffer ? 2 * Buffer->GetDesc().Size : 4096);
		const FRTBufferDesc Desc{Size, ERTBufferUsage::Storage | ERTBufferUsage::CopyDest, ERTMemory::Device, Name};
		if (FRTStatus S = Device.CreateBuffer(Desc, Buffer.ReleaseAndGetAddress()); !S) { return S; }
		MarkAll(EntryCount);
	}
	for (uint64_t Chunk = 0; Chunk < DirtyChunks.size(); ++Chunk)
	{
		if (!DirtyChunks[Chunk]) { continue; }
		uint64_t End = Chunk;
		while (End < DirtyChunks.size() && DirtyChunks[End]) { ++End; }
		const uint64_t First = Chunk * ChunkEntries * EntryBytes;
		const uint64_t Last = std::min(End * ChunkEntries * EntryBytes, Needed);
		if (First >= Last) { break; }
		FUploadSlice Slice;
		if (FRTStatus S = Uploads.Push(static_cast<const uint8_t*>(Data) + First, Last - First, Slice); !S) { return S; }
		List.CopyBuffer(Buffer.Get(), First, Slice.Buffer, Slice.Offset, Last - First);
		CopiedBytes += Last - First;
		Chunk = End;
	}
	std::fill(DirtyChunks.begin(), DirtyChunks.end(), false);
	bDirty = false;
	return FRTStatus::Success();
}

} // namespace Lantern
