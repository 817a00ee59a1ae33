// TGpuTable is an array on the CPU with a copy on the GPU. Only what changed is copied.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstring>
#include <vector>

#include "LanternScene/Memory/Upload.h"

namespace Lantern
{

/// The untyped part of a table. Entries are marked in chunks of ChunkEntries. A flush copies runs of marked chunks, and
/// takes time in proportion to them.
class FGpuTableBase
{
public:
	static constexpr uint32_t ChunkEntries = 8;

	uint64_t GetAddress() const { return Buffer ? Buffer->GetDeviceAddress() : 0; }
	/// Records the copy of what changed. The buffer grows by doubling, and shrinks if it was four times too large for many
	/// flushes. Its address then changes.
	FRTStatus Flush(IRTDevice& Device, IRTCommandList& List, FFrameUploads& Uploads, const void* Data, uint64_t EntryBytes,
	    uint64_t EntryCount, const char* Name);
	bool IsDirty() const { return bDirty; }
	uint64_t GetCopiedBytes() const { return CopiedBytes; } ///< by the last flush

protected:
	void Mark(uint64_t Index);
	void MarkAll(uint64_t Count);

private:
	FRTStatus Resize(IRTDevice& Device, uint64_t Needed, const char* Name, bool& OutNew);
	FRTStatus CopyRuns(IRTCommandList& List, FFrameUploads& Uploads, const uint8_t* Data, uint64_t ChunkBytes, uint64_t Bytes);
	TRTRef<IRTBuffer> Buffer;
	std::vector<bool> IsChunkDirty;
	std::vector<uint32_t> DirtyChunks; // each once; not used while bAllDirty
	bool bAllDirty = false;
	bool bDirty = false;
	uint32_t FlushesTooLarge = 0;
	uint64_t CopiedBytes = 0;
};

template <class T>
class TGpuTable : public FGpuTableBase
{
public:
	explicit TGpuTable(const char* InName) : Name(InName) {}
	uint32_t Num() const { return static_cast<uint32_t>(Entries.size()); }
	const T& operator[](uint32_t Index) const { return Entries[Index]; }
	const std::vector<T>& All() const { return Entries; }
	uint32_t Add(const T& Value)
	{
		Entries.push_back(Value);
		Mark(Entries.size() - 1);
		return Num() - 1;
	}
	void Set(uint32_t Index, const T& Value)
	{
		if (Index >= Entries.size()) { Entries.resize(Index + 1); }
		Entries[Index] = Value;
		Mark(Index);
	}
	/// Marks all entries: the last flush was recorded, but never submitted.
	void Invalidate() { MarkAll(Entries.size()); }
	void Assign(std::vector<T> Values)
	{
		Entries = std::move(Values);
		MarkAll(Entries.size());
	}
	/// Forgets the entries from Count on.
	void Truncate(uint32_t Count)
	{
		if (Count >= Entries.size()) { return; }
		Entries.resize(Count);
		if (Entries.capacity() / 4 > Entries.size() + ChunkEntries) { Entries.shrink_to_fit(); }
	}
	FRTStatus Flush(IRTDevice& Device, IRTCommandList& List, FFrameUploads& Uploads)
	{
		return FGpuTableBase::Flush(Device, List, Uploads, Entries.data(), sizeof(T), Entries.size(), Name);
	}

private:
	std::vector<T> Entries;
	const char* Name;
};

} // namespace Lantern
