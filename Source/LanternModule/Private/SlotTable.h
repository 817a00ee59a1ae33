// Values named by handles. A slot is used again; a handle is not.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace Lantern
{

/// THandle: an enum over uint64_t whose None is 0. The low half is the slot, from 1; the high half counts the slot's uses.
template <class T, class THandle>
class TSlotTable
{
public:
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
		return static_cast<THandle>(uint64_t(Slots[Index].Generation) << 32 | (Index + 1));
	}
	/// Returns null if the handle is None, was removed, or never was. The pointer is valid until the next Add.
	T* Find(THandle Handle)
	{
		const uint64_t Bits = static_cast<uint64_t>(Handle);
		const uint32_t Index = static_cast<uint32_t>(Bits) - 1; // None becomes an index past any end
		const bool bKnown = Index < Slots.size() && Slots[Index].Generation == Bits >> 32 && Slots[Index].Value;
		return bKnown ? &*Slots[Index].Value : nullptr;
	}
	/// Returns the slot of a handle that Find finds now or found once.
	static uint32_t GetSlot(THandle Handle) { return static_cast<uint32_t>(static_cast<uint64_t>(Handle)) - 1; }
	/// Handle: one that Find finds now.
	void Remove(THandle Handle)
	{
		const uint32_t Index = GetSlot(Handle);
		Slots[Index].Value.reset();
		++Slots[Index].Generation;
		Free.push_back(Index);
	}
	template <class TFunction>
	void ForEach(TFunction&& Function)
	{
		for (FSlot& Slot : Slots)
		{
			if (Slot.Value) { Function(*Slot.Value); }
		}
	}

private:
	struct FSlot
	{
		std::optional<T> Value;
		uint32_t Generation = 0;
	};
	std::vector<FSlot> Slots;
	std::vector<uint32_t> Free;
};

} // namespace Lantern
