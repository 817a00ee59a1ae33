// Values named by handles. A slot is used again; a handle is not.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace Lantern
{

/// THandle: an enum over uint64_t whose None is 0. Bits 0 … 31 are the slot, from 1, the next 20 count the slot's uses, and the
/// upper 12 are the owner's tag. A slot whose uses are counted out rests for ever, so that no handle ever names another value.
template <class T, class THandle>
class TSlotTable
{
public:
	static constexpr uint32_t MaxTag = (1u << 12) - 1, MaxGeneration = (1u << 20) - 1;

	/// Tag: at most MaxTag. Handles of tables with other tags are not found here.
	explicit TSlotTable(uint32_t InTag) : Tag(InTag) {}
	THandle Add(T Value)
	{
		if (Free.empty())
		{
			Free.push_back(static_cast<uint32_t>(Slots.size()));
			Slots.emplace_back();
		}
		const uint32_t Index = Free.back();
		Free.pop_back();
		Slots[Index].Value = std::move(Value);
		return GetHandle(Index);
	}
	/// Returns null if the handle is None, was removed, never was, or is another table's. The pointer is valid until the next Add.
	T* Find(THandle Handle)
	{
		const uint64_t Bits = static_cast<uint64_t>(Handle);
		const uint32_t Index = static_cast<uint32_t>(Bits) - 1; // None becomes an index past any end
		const bool bKnown = Index < Slots.size() && GetUpper(Slots[Index]) == Bits >> 32 && Slots[Index].Value;
		return bKnown ? &*Slots[Index].Value : nullptr;
	}
	/// Returns the slot of a handle that Find finds now or found once.
	static uint32_t GetSlot(THandle Handle) { return static_cast<uint32_t>(static_cast<uint64_t>(Handle)) - 1; }
	/// Handle: one that Find finds now.
	void Remove(THandle Handle)
	{
		const uint32_t Index = GetSlot(Handle);
		Slots[Index].Value.reset();
		if (Slots[Index].Generation < MaxGeneration)
		{
			++Slots[Index].Generation;
			Free.push_back(Index);
		}
	}
	/// Function: (THandle, T&), in the order of slots.
	template <class TFunction>
	void ForEach(TFunction&& Function)
	{
		for (uint32_t Index = 0; Index < Slots.size(); ++Index)
		{
			if (Slots[Index].Value) { Function(GetHandle(Index), *Slots[Index].Value); }
		}
	}

private:
	struct FSlot
	{
		std::optional<T> Value;
		uint32_t Generation = 0;
	};
	THandle GetHandle(uint32_t Index) const { return static_cast<THandle>(GetUpper(Slots[Index]) << 32 | (Index + 1)); }
	uint64_t GetUpper(const FSlot& Slot) const { return uint64_t(Tag) << 20 | Slot.Generation; }

	uint32_t Tag;
	std::vector<FSlot> Slots;
	std::vector<uint32_t> Free;
};

} // namespace Lantern
