// FSectionAllocator gives runs of section numbers out of one growing array, in constant time. Free runs lie in lists by size
// class, and merge with their neighbours as soon as they become free. Source: Masmano et al., "TLSF: a new dynamic memory
// allocator for real-time systems", 2004.
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
	/// Returns the first of Count (> 0) numbers in a row. Grows only if no free run of a fitting size class is long enough.
	uint32_t Allocate(uint32_t Count);
	/// Frees exactly what one Allocate gave.
	void Free(uint32_t First, uint32_t Count);
	uint32_t GetCapacity() const { return static_cast<uint32_t>(Cells.size()); } ///< one past the last ever in use
	uint32_t GetFreeCount() const { return FreeCount; }                          ///< numbers below it that are free

private:
	static constexpr uint32_t ExactSizes = 64;  // sizes below this have a class of their own
	static constexpr uint32_t Subdivisions = 8; // classes for each power of two from there on
	static constexpr uint32_t ClassCount = ExactSizes + (32 - 6) * Subdivisions;
	static constexpr uint32_t WordBits = 64;
	static constexpr uint32_t None = ~0u;

	// The first and the last cell of a free run hold its size; the first also holds its neighbours in the list of its class.
	// All other cells have size 0.
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
