// How large each geometry was seen on the screen, raised by any thread while the render thread chooses builds.
#pragma once

#include <array>
#include <atomic>
#include <bit>
#include <cassert>
#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace Lantern
{

class FBuildPriorities
{
public:
	static constexpr uint32_t ChunkSlots = 4096, MaxChunks = 4096;

	/// Makes Slot known and sets its priority to 0. Render thread; no other thread may name the slot at that time.
	void Reset(uint32_t Slot)
	{
		assert(Slot < ChunkSlots * MaxChunks);
		std::unique_ptr<std::atomic<uint32_t>[]>& Chunk = Chunks[Slot / ChunkSlots];
		if (!Chunk) { Chunk = std::make_unique<std::atomic<uint32_t>[]>(ChunkSlots); }
		Chunk[Slot % ChunkSlots].store(0, std::memory_order_relaxed);
	}
	/// Keeps the largest ScreenSize (heights of the picture). What is negative or no number counts as 0.
	/// Slot must be known. Waits for no lock but that of the list of slots, which is held for moments. Any thread.
	void Raise(uint32_t Slot, float ScreenSize)
	{
		// Floats that are not negative are ordered as their bits are.
		const uint32_t Bits = std::bit_cast<uint32_t>(ScreenSize > 0.0f ? ScreenSize : 0.0f);
		std::atomic<uint32_t>& Priority = Chunks[Slot / ChunkSlots][Slot % ChunkSlots];
		uint32_t Before = Priority.load(std::memory_order_relaxed);
		while (Before < Bits && !Priority.compare_exchange_weak(Before, Bits, std::memory_order_relaxed)) {}
		if (Before != 0 || Bits == 0) { return; } // another call has listed it
		std::lock_guard Lock(Mutex);
		Raised.push_back(Slot);
	}
	/// Returns the slots whose priority rose from 0 since the last call; a slot may be there twice. Any thread.
	std::vector<uint32_t> TakeRaised()
	{
		std::lock_guard Lock(Mutex);
		return std::exchange(Raised, {});
	}
	/// The largest size since the last call; 0: none. Any thread.
	float Take(uint32_t Slot)
	{
		return std::bit_cast<float>(Chunks[Slot / ChunkSlots][Slot % ChunkSlots].exchange(0, std::memory_order_relaxed));
	}

private:
	/// Bits of floats, in chunks that never move because any thread writes to them.
	std::array<std::unique_ptr<std::atomic<uint32_t>[]>, MaxChunks> Chunks;
	std::mutex Mutex;
	std::vector<uint32_t> Raised;
};

} // namespace Lantern
