// What geometries leave behind when their last owner lets go, on any thread and perhaps after the store is gone.
#pragma once

#include <mutex>
#include <utility>
#include <vector>

#include "LanternRHI/RTInterfaces.h"

namespace Lantern
{

/// Threads: any.
struct FGeometryReleases
{
	struct FItem
	{
		uint32_t Slot = 0;
		bool bDynamic = false;
		TRTRef<IRTGeometry> Structure;
		TRTRef<IRTBuffer> Indices;
	};

	void Add(uint32_t Slot, bool bDynamic, TRTRef<IRTGeometry> Structure, TRTRef<IRTBuffer> Indices)
	{
		std::lock_guard Lock(Mutex);
		Items.push_back({Slot, bDynamic, std::move(Structure), std::move(Indices)});
	}
	std::vector<FItem> Take()
	{
		std::lock_guard Lock(Mutex);
		return std::exchange(Items, {});
	}
	bool IsEmpty() const
	{
		std::lock_guard Lock(Mutex);
		return Items.empty();
	}

private:
	mutable std::mutex Mutex;
	std::vector<FItem> Items;
};

} // namespace Lantern
