// Things that wait for the GPU: released objects, and references that a submission holds.
#pragma once

#include "LanternRHI/RTInterfaces.h"

#include <deque>
#include <optional>
#include <utility>

namespace Lantern
{

/// First in, first out, each item with the fence that it waits for. An item with a lower fence than the one before it waits
/// for both. Not thread-safe.
template <class T>
class TFenceQueue
{
public:
	void Push(FRTFence Fence, T Item) { Items.emplace_back(Fence, std::move(Item)); }
	/// Takes the oldest item if its fence is at most Done.
	std::optional<T> Pop(FRTFence Done)
	{
		if (Items.empty() || Items.front().first > Done) { return std::nullopt; }
		std::optional<T> Item(std::move(Items.front().second));
		Items.pop_front();
		return Item;
	}
	bool IsEmpty() const { return Items.empty(); }

private:
	std::deque<std::pair<FRTFence, T>> Items;
};

} // namespace Lantern
