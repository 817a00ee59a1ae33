// Indices of a bindless array.
#pragma once

#include <cstdint>
#include <vector>

namespace Lantern
{

/// Gives out indices below a capacity. Those that came back are given out again, the latest first. Not thread-safe.
class FIndexAllocator
{
public:
	static constexpr uint32_t None = ~0u;

	/// Call before the first Allocate.
	void SetCapacity(uint32_t InCapacity) { Capacity = InCapacity; }
	/// None where all are in use.
	uint32_t Allocate();
	/// Index: one that is in use. The GPU must have finished with its last user.
	void Free(uint32_t Index);

private:
	uint32_t Capacity = 0;
	uint32_t Used = 0; ///< indices ever given out
	std::vector<uint32_t> Freed;
};

} // namespace Lantern
