// FBuildPriorities: the largest size of each slot, from any thread.
#include "Geometry/BuildPriorities.h"

#include <limits>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace Lantern
{
namespace
{

TEST(BuildPriorities, MaximumCountsUntilItIsTaken)
{
	FBuildPriorities Priorities;
	Priorities.Reset(3);
	EXPECT_EQ(Priorities.Take(3), 0.0f);
	Priorities.Raise(3, 0.25f);
	Priorities.Raise(3, 0.75f);
	Priorities.Raise(3, 0.5f);
	EXPECT_EQ(Priorities.Take(3), 0.75f);
	EXPECT_EQ(Priorities.Take(3), 0.0f);
}

TEST(BuildPriorities, NegativeSizesAndThoseThatAreNoNumberCountAsNone)
{
	constexpr float Infinity = std::numeric_limits<float>::infinity();
	FBuildPriorities Priorities;
	Priorities.Reset(0);
	for (const float Size : {std::numeric_limits<float>::quiet_NaN(), -1.0f, -0.0f, -Infinity})
	{
		Priorities.Raise(0, Size);
		EXPECT_EQ(Priorities.Take(0), 0.0f);
	}
	Priorities.Raise(0, Infinity);
	Priorities.Raise(0, std::numeric_limits<float>::max());
	EXPECT_EQ(Priorities.Take(0), Infinity);
	Priorities.Raise(0, std::numeric_limits<float>::denorm_min());
	EXPECT_EQ(Priorities.Take(0), std::numeric_limits<float>::denorm_min());
}

TEST(BuildPriorities, SlotsOfAllChunksAreIndependent)
{
	constexpr uint32_t Chunk = FBuildPriorities::ChunkSlots;
	const std::vector<uint32_t> Slots = {0, 1, Chunk - 1, Chunk, Chunk * FBuildPriorities::MaxChunks - 1};
	FBuildPriorities Priorities;
	for (const uint32_t Slot : Slots) { Priorities.Reset(Slot); }
	for (size_t I = 0; I < Slots.size(); ++I) { Priorities.Raise(Slots[I], 1.0f + static_cast<float>(I)); }
	for (size_t I = 0; I < Slots.size(); ++I) { EXPECT_EQ(Priorities.Take(Slots[I]), 1.0f + static_cast<float>(I)); }
}

TEST(BuildPriorities, ResetForgetsOneSlot)
{
	FBuildPriorities Priorities;
	Priorities.Reset(7);
	Priorities.Reset(8);
	Priorities.Raise(7, 1.0f);
	Priorities.Raise(8, 2.0f);
	Priorities.Reset(7);
	EXPECT_EQ(Priorities.Take(7), 0.0f);
	EXPECT_EQ(Priorities.Take(8), 2.0f);
}

TEST(BuildPriorities, MaximumOfAllThreadsStays)
{
	constexpr uint32_t ThreadCount = 4, Steps = 20000;
	FBuildPriorities Priorities;
	Priorities.Reset(5);
	std::vector<std::thread> Threads;
	for (uint32_t Thread = 0; Thread < ThreadCount; ++Thread)
	{
		Threads.emplace_back([&Priorities, Thread] {
			for (uint32_t Step = 0; Step < Steps; ++Step) { Priorities.Raise(5, static_cast<float>(Step * ThreadCount + Thread)); }
		});
	}
	for (std::thread& Thread : Threads) { Thread.join(); }
	EXPECT_EQ(Priorities.Take(5), static_cast<float>(Steps * ThreadCount - 1));
}

} // namespace
} // namespace Lantern
