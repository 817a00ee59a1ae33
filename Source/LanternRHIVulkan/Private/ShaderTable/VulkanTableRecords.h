// The records of one kind as the CPU wrote them, in pages that never move, and a bit for each that the GPU lacks.
#pragma once

#include "LanternRHI/RTTypes.h"

#include <atomic>
#include <memory>
#include <vector>

namespace Lantern
{

class FVulkanTableRecords
{
public:
	struct FRun
	{
		uint32_t First = 0;
		uint32_t Count = 0;
	};

	/// Bytes. A record is a handle, DataBytes of data, and zeros up to the stride; here it is its handle's number in an
	/// FVulkanHandleStore, and its data.
	void Initialise(uint64_t InStride, uint32_t InHandleSize, uint32_t InDataBytes);
	/// New records are zeros, and clean: the GPU is to fill its own with zeros.
	void Grow(uint32_t InCount);
	uint32_t GetCount() const { return Count; }
	uint64_t GetStride() const { return Stride; }

	/// SlotsOfGroups: numbers of the pipeline's handles. Data: RecordDataBytes for each record, or null for zeros. From
	/// several threads at once for different records.
	void Set(uint32_t First, uint32_t InCount, const uint32_t* SlotsOfGroups, const uint32_t* Groups, const void* Data);
	/// One record with less data than it has room for.
	void SetOne(uint32_t Index, uint32_t Slot, const void* Data, uint32_t InDataBytes);
	/// The data stays; a record whose handle is what it was stays clean. Where there are many, it is their handles alone
	/// that the GPU lacks afterwards.
	void SetHandles(uint32_t First, uint32_t InCount, const uint32_t* SlotsOfGroups, const uint32_t* Groups);
	/// Which numbers there are, and other ones for them: see FVulkanHandleStore::Prune.
	void MarkUsed(std::vector<bool>& Used) const;
	void Renumber(const std::vector<uint32_t>& NewOf);

	void MarkDirty(FRun Run);
	bool IsDirty() const { return bDirty.load(std::memory_order_relaxed) || bAnyHandlesDirty.load(std::memory_order_relaxed); }
	/// Appends the dirty runs, in order, and makes them clean.
	void TakeDirty(std::vector<FRun>& Out);
	/// The same for runs of which the handles alone are dirty; records between them that are not may be among them.
	void TakeDirtyHandles(std::vector<FRun>& Out);
	/// Count numbers.
	void CopySlotsTo(uint32_t* Dest, FRun Run) const;
	/// Count · stride bytes. Handles: the store's.
	void CopyTo(uint8_t* Dest, FRun Run, const uint8_t* Handles) const;
	static uint64_t CountRecords(const std::vector<FRun>& Runs);

private:
	static constexpr uint32_t WordBits = 64;
	static constexpr uint32_t PageRecords = 1024;
	/// Handles that are set at once are worth a pass over their pages.
	static constexpr uint32_t ManyHandles = 256;
	struct FPage
	{
		std::unique_ptr<uint8_t[]> Data;
		uint32_t Slots[PageRecords] = {};
		std::atomic<uint64_t> Dirty[PageRecords / WordBits] = {};
		std::atomic<bool> bHandlesDirty{false};
	};

	/// Calls Write(page, place in it, offset from First, count) for pieces that share a word of bits; it answers which
	/// changed, from bit 0.
	template <class TWrite>
	void ForEachPiece(uint32_t First, uint32_t InCount, TWrite&& Write);
	template <uint32_t HandleBytes, uint32_t RecordBytes>
	static void ComposeFixed(uint8_t* Dest, const FPage& Page, uint32_t Within, uint32_t InCount, const uint8_t* Handles);
	void Compose(uint8_t* Dest, const FPage& Page, uint32_t Within, uint32_t InCount, const uint8_t* Handles) const;

	uint64_t Stride = 0;
	uint32_t HandleSize = 0;
	uint32_t DataBytes = 0;
	uint32_t Count = 0;
	std::vector<std::unique_ptr<FPage>> Pages;
	std::atomic<bool> bDirty{false};
	std::atomic<bool> bAnyHandlesDirty{false};
};

} // namespace Lantern
