// TGpuTable is an array on the CPU with a copy on the GPU. Only what changed is copied.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstring>
#include <vector>

#include "LanternScene/Memory/PagedArray.h"
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
	/// Where a flush reads entries: Copy writes Count of them, from First on, to Out.
	struct FSource
	{
		const void* Table = nullptr;
		void (*Copy)(const void* Table, uint64_t First, uint64_t Count, void* Out) = nullptr;
		uint64_t EntryBytes = 0, EntryCount = 0;
	};
	/// Records the copy of what changed. The buffer grows by doubling, and shrinks if it was four times too large for many
	/// flushes. Its address then changes, and the device copies what the old one holds.
	FRTStatus Flush(IRTDevice& Device, IRTCommandList& List, FFrameUploads& Uploads, const FSource& Source, const char* Name);
	bool IsDirty() const { return bDirty; }
	uint64_t GetCopiedBytes() const { return CopiedBytes; } ///< by the last flush

protected:
	void Mark(uint64_t Index);
	void MarkAll(uint64_t Count);

private:
	/// OutOld: what the buffer was before; null if it still is.
	FRTStatus Resize(IRTDevice& Device, uint64_t Needed, const char* Name, TRTRef<IRTBuffer>& OutOld);
	FRTStatus CopyAll(IRTCommandList& List, FFrameUploads& Uploads, const FSource& Source);
	FRTStatus CopyRuns(IRTCommandList& List, FFrameUploads& Uploads, const FSource& Source);
	uint64_t HeldBytes = 0; // of the buffer, that are as the last flush left them
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
	uint32_t Num() const { return static_cast<uint32_t>(Entries.Num()); }
	const T& operator[](uint32_t Index) const { return Entries[Index]; }
	const TPagedArray<T>& All() const { return Entries; }
	uint32_t Add(const T& Value)
	{
		Entries.Add(Value);
		Mark(Entries.Num() - 1);
		return Num() - 1;
	}
	void Set(uint32_t Index, const T& Value)
	{
		for (uint64_t New = Entries.Num(); New < Index; ++New) { Mark(New); }
		if (Index >= Entries.Num()) { Entries.Resize(size_t(Index) + 1); }
		Entries[Index] = Value;
		Mark(Index);
	}
	/// Marks all entries: the last flush was recorded, but never submitted.
	void Invalidate() { MarkAll(Entries.Num()); }
	void Assign(const std::vector<T>& Values)
	{
		Entries.Resize(Values.size());
		for (size_t Index = 0; Index < Values.size(); ++Index) { Entries[Index] = Values[Index]; }
		MarkAll(Entries.Num());
	}
	/// Forgets the entries from Count on.
	void Truncate(uint32_t Count)
	{
		if (Count >= Entries.Num()) { return; }
		Entries.Resize(Count);
	}
	FRTStatus Flush(IRTDevice& Device, IRTCommandList& List, FFrameUploads& Uploads)
	{
		const auto Copy = [](const void* Table, uint64_t First, uint64_t Count, void* Out) {
			static_cast<const TPagedArray<T>*>(Table)->CopyTo(static_cast<T*>(Out), First, Count);
		};
		return FGpuTableBase::Flush(Device, List, Uploads, {&Entries, Copy, sizeof(T), Entries.Num()}, Name);
	}

private:
	TPagedArray<T> Entries;
	const char* Name;
};

} // namespace Lantern
