// Geometries that are left out of the scene because they do not fit into memory, until there is room.
#pragma once

#include <cstdint>
#include <vector>

#include "Geometry/GeometryContext.h"

namespace Lantern
{

/// Threads: render thread.
class FGeometryRefusals
{
public:
	explicit FGeometryRefusals(FGeometryContext& Context);

	/// The entry becomes Refused and gives its structure back. Logs one warning for each geometry.
	/// Room: bytes that it could have had.
	void Refuse(FGeometryEntry& Entry, uint64_t Room);
	/// Some refused geometry is worth another try. Does not change anything.
	bool IsAnyWorthAnotherTry() const;
	/// Queues what now fits. What can be made coarser is queued too if there is more than twice the room that it was
	/// refused for.
	void Reconsider();
	uint32_t GetCount() const { return static_cast<uint32_t>(Refused.size()); }

private:
	bool IsWorthAnotherTry(const FGeometryEntry& Entry, uint64_t Room) const;

	FGeometryContext& Context;
	std::vector<FGeometrySlotRef> Refused;
};

} // namespace Lantern
