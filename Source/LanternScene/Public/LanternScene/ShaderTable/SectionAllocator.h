// Runs of section numbers out of one growing array, in constant time. Free runs lie in lists by size class (as in
// Masmano et al., "TLSF: a new dynamic memory allocator for real-time systems", 2004), and merge with their neighbours
// the moment they become free.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace Lantern
{

class FSectionAllocator
{
public:
	FSectionAllocator();
	/// First of Count (> 0) numbers in a row. Grows only where no free run of the size's class is long enough.
	uint32_t Allocate(uint32_t Count);
	/// Exactly what one Allocate gave.
	void Free(uint32_t First, uint32_t Count);
	uint32_t GetCapacity() const { return static_cast<uint32_t>(Cells.size()); } ///< one past the last ever in use
	uint32_t GetFreeCount() const { return FreeCount; }                          ///< numbers below it that are free

private:
	static constexpr uint32_t ExactSizes = 64;  // sizes below have a class of their own …
	static constexpr uint32_t Subdivisions = 8; // … above, so many share each power of two
	static constexpr uint32_t ClassCount = ExactSizes + (32 - 6) * Subdivisions;
	static constexpr uint32_t WordBits = 64;
	static constexpr uint32_t None = ~0u;

	// Of a free run, the first and the last cell hold its size, the first also its place in the list of its class. All
	// other cells have size 0.
	struct FCell
	{
		uint32_t Size = 0, Previous = None, Next = None;
	};
	static uint32_t ClassOf(uint32_t Size);
	uint32_t FindClass(uint32_t AtLeast) const;
	void Insert(uint32_t First, uint32_t Size);
	void Remove(uint32_t First);
	uint32_t Grow(uint32_t Count);

	std::vector<FCell> Cells;
	std::array<uint32_t, ClassCount> Heads;
	std::array<uint64_t, (ClassCount + WordBits - 1) / WordBits> Occupied = {};
	uint32_t FreeCount = 0;
};

} // namespace Lantern
