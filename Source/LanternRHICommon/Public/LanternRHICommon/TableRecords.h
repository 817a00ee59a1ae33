// The shader records of one kind as the CPU wrote them, and a bit for each that the GPU lacks.
#pragma once

#include "LanternRHI/RTTypes.h"

#include <atomic>
#include <memory>
#include <vector>

namespace Lantern
{

/// How handles travel to the GPU when they change without their records' data.
enum class EHandleUpdates : uint8_t
{
	WithRecords, ///< as whole records
	Apart,       ///< alone, if many change at once: TakeDirtyHandles names them
};

/// A record on the GPU is a handle, data, and zeros up to the stride. Here it is the number of its handle in an FHandleStore,
/// and its data. Records stand in pages that never move.
/// Threads: Set, SetOne, SetHandles and MarkDirty may run at once for different records; everything else excludes them.
class FTableRecords
{
public:
	/// Neighbouring records.
	struct FRun
	{
		uint32_t First = 0;
		uint32_t Count = 0;
	};

	/// All sizes are in bytes; InStride is at least InHandleSize + InDataBytes.
	void Initialise(uint64_t InStride, uint32_t InHandleSize, uint32_t InDataBytes, EHandleUpdates InHandleUpdates);
	/// Never shrinks. New records are zeros, and clean: the GPU is to fill its own with zeros.
	void Grow(uint32_t InCount);
	uint32_t GetCount() const { return Count; }
	uint64_t GetStride() const { return Stride; }

	/// SlotsOfGroups: numbers of the pipeline's handles. Groups: one for each record. Data: DataBytes for each record, tightly
	/// packed, or null for zeros.
	void Set(uint32_t First, uint32_t InCount, const uint32_t* SlotsOfGroups, const uint32_t* Groups, const void* Data);
	/// Sets one record; bytes behind InDataBytes become zeros. Data may be null for zeros.
	void SetOne(uint32_t Index, uint32_t Slot, const void* Data, uint32_t InDataBytes);
	/// Sets handles; the data stays. A record that has the handle already stays as clean as it was.
	void SetHandles(uint32_t First, uint32_t InCount, const uint32_t* SlotsOfGroups, const uint32_t* Groups);
	/// Marks in Used, by number, the handles that records name.
	void MarkUsed(std::vector<bool>& Used) const;
	/// Gives records the new numbers of their handles, as FHandleStore::Prune returned them.
	void Renumber(const std::vector<uint32_t>& NewOf);

	void MarkDirty(FRun Run);
	bool IsDirty() const { return bDirty.load(std::memory_order_relaxed) || bAnyHandlesDirty.load(std::memory_order_relaxed); }
	/// Appends the runs that are dirty as whole records, in order, and makes them clean.
	void TakeDirty(std::vector<FRun>& Out);
	/// Appends the runs whose handles alone are dirty, in order, and makes them clean. They may hold clean records as well.
	void TakeDirtyHandles(std::vector<FRun>& Out);
	/// Writes Run.Count numbers of handles.
	void CopySlotsTo(uint32_t* Dest, FRun Run) const;
	/// Writes Run.Count records of a stride each. Handles: FHandleStore::GetHandles().
	void CopyTo(uint8_t* Dest, FRun Run, const uint8_t* Handles) const;
	static uint64_t CountRecords(const std::vector<FRun>& Runs);

private:
	static constexpr uint32_t WordBits = 64;
	static constexpr uint32_t PageRecords = 1024;
	/// So many handles that are set at once are worth a pass over their pages.
	static constexpr uint32_t ManyHandles = 256;
	struct FPage
	{
		std::unique_ptr<uint8_t[]> Data;
		uint32_t Slots[PageRecords] = {};
		std::atomic<uint64_t> Dirty[PageRecords / WordBits] = {};
		std::atomic<bool> bHandlesDirty{false};
	};

	/// Calls Write(page, place in it, offset from First, count) for pieces that share a word of bits. Write returns which
	/// records changed, from bit 0.
	template <class TWrite>
	void ForEachPiece(uint32_t First, uint32_t InCount, TWrite&& Write);
	template <uint32_t HandleBytes, uint32_t RecordBytes>
	static void ComposeFixed(uint8_t* Dest, const FPage& Page, uint32_t Within, uint32_t InCount, const uint8_t* Handles);
	void Compose(uint8_t* Dest, const FPage& Page, uint32_t Within, uint32_t InCount, const uint8_t* Handles) const;

	uint64_t Stride = 0;
	uint32_t HandleSize = 0;
	uint32_t DataBytes = 0;
	uint32_t Count = 0;
	EHandleUpdates HandleUpdates = EHandleUpdates::WithRecords;
	std::vector<std::unique_ptr<FPage>> Pages;
	std::atomic<bool> bDirty{false};
	std::atomic<bool> bAnyHandlesDirty{false};
};

} // namespace Lantern
