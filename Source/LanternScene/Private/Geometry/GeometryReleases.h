// Geometries without owners, on their way back to the store. The last owner may let go on any thread, while the store reads the
// geometry, and perhaps after the store is gone.
#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "LanternScene/Geometry/Geometry.h"

namespace Lantern
{

/// Threads: any.
class FGeometryReleases
{
public:
	/// Keeps the geometry until the store takes it, or destroys it if there is no store any more.
	void Add(std::unique_ptr<FRTGeometry> Geometry)
	{
		std::lock_guard Lock(Mutex);
		if (!bClosed) { Items.push_back(std::move(Geometry)); }
	}
	std::vector<std::unique_ptr<FRTGeometry>> Take()
	{
		std::lock_guard Lock(Mutex);
		return std::exchange(Items, {});
	}
	bool IsEmpty() const
	{
		std::lock_guard Lock(Mutex);
		return Items.empty();
	}
	/// The store goes.
	void Close()
	{
		const std::vector<std::unique_ptr<FRTGeometry>> Rest = Take(); // destroyed without the lock
		std::lock_guard Lock(Mutex);
		bClosed = true;
	}

private:
	mutable std::mutex Mutex;
	std::vector<std::unique_ptr<FRTGeometry>> Items;
	bool bClosed = false;
};

} // namespace Lantern
