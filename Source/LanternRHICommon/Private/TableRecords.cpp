// FTableRecords: the shader records of one kind on the CPU, and which of them the GPU lacks.
#include "LanternRHICommon/TableRecords.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>

namespace Lantern
{

namespace
{

constexpr uint64_t FullMask(uint32_t Bits) { return Bits >= 64 ? ~uint64_t(0) : (uint64_t(1) << Bits) - 1; }

} // namespace

void FTableRecords::Initialise(uint64_t InStride, uint32_t InHandleSize, uint32_t InDataBytes, EHandleUpdates InHandleUpdates)
{
	Stride = InStride;
	HandleSize = InHandleSize;
	DataBytes = InDataBytes;
	HandleUpdates = InHandleUpdates;
	assert(Stride >= HandleSize + DataBytes);
}

void FTableRecords::Grow(uint32_t InCount)
{
	const size_t PageCount = (size_t(InCount) + PageRecords - 1) / PageRecords;
	while (Pages.size() < PageCount)
	{
		auto Page = std::make_unique<FPage>();
		Page->Data = std::make_unique<uint8_t[]>(size_t(DataBytes) * PageRecords);
		Pages.push_back(std::move(Page));
	}
	Count = std::max(Count, InCount);
}

template <class TWrite>
void FTableRecords::ForEachPiece(uint32_t First, uint32_t InCount, TWrite&& Write)
{
	assert(uint64_t(First) + InCount <= Count);
	bool bAny = false;
	for (uint32_t Done = 0; Done < InCount;)
	{
		const uint32_t Within = (First + Done) % PageRecords;
		const uint32_t Bit = Within % WordBits;
		const uint32_t Piece = std::min(WordBits - Bit, InCount - Done);
		FPage& Page = *Pages[(First + Done) / PageRecords];
		const uint64_t Mask = Write(Page, Within, Done, Piece) << Bit;
		std::atomic<uint64_t>& Word = Page.Dirty[Within / WordBits];
		if (Mask == ~uint64_t(0))
		{
			Word.store(Mask, std::memory_order_relaxed); // no other thread names a record of this word
		}
		else if (Mask & ~Word.load(std::memory_order_relaxed)) { Word.fetch_or(Mask, std::memory_order_relaxed); }
		bAny = bAny || Mask;
		Done += Piece;
	}
	if (bAny && !bDirty.load(std::memory_order_relaxed)) { bDirty.store(true, std::memory_order_relaxed); }
}

void FTableRecords::Set(uint32_t First, uint32_t InCount, const uint32_t* SlotsOfGroups, const uint32_t* Groups, const void* Data)
{
	const uint8_t* Source = static_cast<const uint8_t*>(Data);
	ForEachPiece(First, InCount, [&](FPage& Page, uint32_t Within, uint32_t Done, uint32_t Piece) {
		for (uint32_t Index = 0; Index < Piece; ++Index) { Page.Slots[Within + Index] = SlotsOfGroups[Groups[Done + Index]]; }
		uint8_t* Dest = Page.Data.get() + size_t(DataBytes) * Within;
		if (Source) { memcpy(Dest, Source + size_t(DataBytes) * Done, size_t(DataBytes) * Piece); }
		else { memset(Dest, 0, size_t(DataBytes) * Piece); }
		return FullMask(Piece);
	});
}

void FTableRecords::SetOne(uint32_t Index, uint32_t Slot, const void* Data, uint32_t InDataBytes)
{
	assert(InDataBytes <= DataBytes);
	ForEachPiece(Index, 1, [&](FPage& Page, uint32_t Within, uint32_t, uint32_t) {
		Page.Slots[Within] = Slot;
		uint8_t* Dest = Page.Data.get() + size_t(DataBytes) * Within;
		const uint32_t Given = Data ? InDataBytes : 0;
		if (Given) { memcpy(Dest, Data, Given); }
		if (Given < DataBytes) { memset(Dest + Given, 0, DataBytes - Given); }
		return uint64_t(1);
	});
}

void FTableRecords::SetHandles(uint32_t First, uint32_t InCount, const uint32_t* SlotsOfGroups, const uint32_t* Groups)
{
	const bool bMany = HandleUpdates == EHandleUpdates::Apart && InCount >= ManyHandles;
	bool bAny = false;
	ForEachPiece(First, InCount, [&](FPage& Page, uint32_t Within, uint32_t Done, uint32_t Piece) {
		uint64_t Changed = 0;
		for (uint32_t Index = 0; Index < Piece; ++Index)
		{
			const uint32_t Slot = SlotsOfGroups[Groups[Done + Index]];
			Changed |= uint64_t(Page.Slots[Within + Index] != Slot) << Index;
			Page.Slots[Within + Index] = Slot;
		}
		if (bMany && Changed && !Page.bHandlesDirty.load(std::memory_order_relaxed))
		{
			Page.bHandlesDirty.store(true, std::memory_order_relaxed);
		}
		bAny = bAny || Changed;
		return bMany ? uint64_t(0) : Changed;
	});
	if (bMany && bAny) { bAnyHandlesDirty.store(true, std::memory_order_relaxed); }
}

void FTableRecords::TakeDirtyHandles(std::vector<FRun>& Out)
{
	if (!bAnyHandlesDirty.exchange(false, std::memory_order_relaxed)) { return; }
	for (uint32_t First = 0; First < Count; First += PageRecords)
	{
		if (!Pages[First / PageRecords]->bHandlesDirty.exchange(false, std::memory_order_relaxed)) { continue; }
		const uint32_t Length = std::min(PageRecords, Count - First);
		if (!Out.empty() && Out.back().First + Out.back().Count == First) { Out.back().Count += Length; }
		else { Out.push_back({First, Length}); }
	}
}

void FTableRecords::CopySlotsTo(uint32_t* Dest, FRun Run) const
{
	while (Run.Count > 0)
	{
		const uint32_t Within = Run.First % PageRecords;
		const uint32_t Piece = std::min(PageRecords - Within, Run.Count);
		memcpy(Dest, Pages[Run.First / PageRecords]->Slots + Within, sizeof(uint32_t) * Piece);
		Dest += Piece;
		Run.First += Piece;
		Run.Count -= Piece;
	}
}

void FTableRecords::MarkUsed(std::vector<bool>& Used) const
{
	for (const std::unique_ptr<FPage>& Page : Pages)
	{
		for (const uint32_t Slot : Page->Slots) { Used[Slot] = true; }
	}
}

void FTableRecords::Renumber(const std::vector<uint32_t>& NewOf)
{
	for (const std::unique_ptr<FPage>& Page : Pages)
	{
		for (uint32_t& Slot : Page->Slots) { Slot = NewOf[Slot]; }
	}
}

void FTableRecords::MarkDirty(FRun Run)
{
	ForEachPiece(Run.First, Run.Count, [](FPage&, uint32_t, uint32_t, uint32_t Piece) { return FullMask(Piece); });
}

void FTableRecords::TakeDirty(std::vector<FRun>& Out)
{
	if (!bDirty.exchange(false, std::memory_order_relaxed)) { return; }
	const size_t Start = Out.size();
	for (uint32_t First = 0; First < Count; First += WordBits)
	{
		std::atomic<uint64_t>& Dirty = Pages[First / PageRecords]->Dirty[First % PageRecords / WordBits];
		uint64_t Word = Dirty.load(std::memory_order_relaxed);
		if (Word == 0) { continue; }
		Dirty.store(0, std::memory_order_relaxed);
		while (Word)
		{
			const uint32_t Begin = static_cast<uint32_t>(std::countr_zero(Word));
			const uint32_t Length = static_cast<uint32_t>(std::countr_one(Word >> Begin));
			if (Out.size() > Start && Out.back().First + Out.back().Count == First + Begin) { Out.back().Count += Length; }
			else { Out.push_back({First + Begin, Length}); }
			Word &= ~(FullMask(Length) << Begin);
		}
	}
}

uint64_t FTableRecords::CountRecords(const std::vector<FRun>& Runs)
{
	uint64_t Sum = 0;
	for (const FRun& Run : Runs) { Sum += Run.Count; }
	return Sum;
}

template <uint32_t HandleBytes, uint32_t RecordBytes>
void FTableRecords::ComposeFixed(uint8_t* Dest, const FPage& Page, uint32_t Within, uint32_t InCount, const uint8_t* Handles)
{
	const uint8_t* Data = Page.Data.get() + size_t(RecordBytes) * Within;
	for (uint32_t Index = 0; Index < InCount; ++Index, Dest += HandleBytes + RecordBytes, Data += RecordBytes)
	{
		memcpy(Dest, Handles + size_t(Page.Slots[Within + Index]) * HandleBytes, HandleBytes);
		memcpy(Dest + HandleBytes, Data, RecordBytes);
	}
}

void FTableRecords::Compose(uint8_t* Dest, const FPage& Page, uint32_t Within, uint32_t InCount, const uint8_t* Handles) const
{
	// Sizes known at compile time make a record a few vector moves.
	if (HandleSize == 32 && DataBytes == 32 && Stride == 64) { return ComposeFixed<32, 32>(Dest, Page, Within, InCount, Handles); }
	const uint8_t* Data = Page.Data.get() + size_t(DataBytes) * Within;
	for (uint32_t Index = 0; Index < InCount; ++Index, Dest += Stride, Data += DataBytes)
	{
		memcpy(Dest, Handles + size_t(Page.Slots[Within + Index]) * HandleSize, HandleSize);
		memcpy(Dest + HandleSize, Data, DataBytes);
		memset(Dest + HandleSize + DataBytes, 0, Stride - HandleSize - DataBytes);
	}
}

void FTableRecords::CopyTo(uint8_t* Dest, FRun Run, const uint8_t* Handles) const
{
	while (Run.Count > 0)
	{
		const uint32_t Within = Run.First % PageRecords;
		const uint32_t Piece = std::min(PageRecords - Within, Run.Count);
		Compose(Dest, *Pages[Run.First / PageRecords], Within, Piece, Handles);
		Dest += Stride * Piece;
		Run.First += Piece;
		Run.Count -= Piece;
	}
}

} // namespace Lantern
