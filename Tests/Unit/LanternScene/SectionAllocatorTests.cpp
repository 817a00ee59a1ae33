// FSectionAllocator: runs of section numbers.
#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "LanternScene/ShaderTable/SectionAllocator.h"

namespace Lantern
{
namespace
{

TEST(SectionAllocator, NeighboursThatAreFreeBecomeOneRun)
{
	FSectionAllocator Allocator;
	for (uint32_t I = 0; I < 4; ++I) { ASSERT_EQ(Allocator.Allocate(1), I); }
	// In an order that merges with the one before, the one behind, and both.
	Allocator.Free(0, 1);
	Allocator.Free(2, 1);
	EXPECT_EQ(Allocator.Allocate(3), 4u) << "two single holes are no run of three";
	Allocator.Free(1, 1);
	EXPECT_EQ(Allocator.Allocate(3), 0u);
	EXPECT_EQ(Allocator.GetCapacity(), 7u);
	EXPECT_EQ(Allocator.GetFreeCount(), 0u);
}

TEST(SectionAllocator, GrowsOnlyByWhatTheLastFreeRunLacks)
{
	FSectionAllocator Allocator;
	Allocator.Allocate(10);
	const uint32_t Last = Allocator.Allocate(5);
	Allocator.Free(Last, 5);
	EXPECT_EQ(Allocator.Allocate(8), Last);
	EXPECT_EQ(Allocator.GetCapacity(), 18u);
}

TEST(SectionAllocator, LargeRunsAreUsedAgain)
{
	FSectionAllocator Allocator;
	for (const uint32_t Size : {64u, 65u, 100u, 1000u, 4095u, 4096u, 100'000u})
	{
		const uint32_t First = Allocator.Allocate(Size);
		const uint32_t Capacity = Allocator.GetCapacity();
		Allocator.Free(First, Size);
		EXPECT_EQ(Allocator.Allocate(Size), First);
		EXPECT_EQ(Allocator.GetCapacity(), Capacity);
	}
}

struct FRun
{
	uint32_t First, Count;
};

/// Every number is a cell, taken or free.
void WalkRandomly(uint32_t Seed, uint32_t Most, uint32_t Steps, double WorstWaste)
{
	FSectionAllocator Allocator;
	std::mt19937 Random(Seed);
	std::vector<FRun> Runs;
	std::vector<bool> Taken;
	uint32_t Used = 0, PeakUsed = 0;
	for (uint32_t Step = 0; Step < Steps; ++Step)
	{
		if (Runs.empty() || Random() % 100 < (Step / 2000 % 2 ? 40u : 60u))
		{
			const uint32_t Count = 1 + (Random() % 4 ? Random() % 8 : Random() % Most);
			const uint32_t First = Allocator.Allocate(Count);
			Runs.push_back({First, Count});
			Taken.resize(Allocator.GetCapacity(), false);
			for (uint32_t I = First; I < First + Count; ++I)
			{
				ASSERT_FALSE(Taken[I]) << "seed " << Seed << ", step " << Step;
				Taken[I] = true;
			}
			Used += Count;
		}
		else
		{
			std::swap(Runs[Random() % Runs.size()], Runs.back());
			const FRun Run = Runs.back();
			Runs.pop_back();
			Allocator.Free(Run.First, Run.Count);
			std::fill_n(Taken.begin() + Run.First, Run.Count, false);
			Used -= Run.Count;
		}
		PeakUsed = std::max(PeakUsed, Used);
		ASSERT_EQ(Allocator.GetFreeCount(), Allocator.GetCapacity() - Used) << "seed " << Seed << ", step " << Step;
	}
	EXPECT_LE(Allocator.GetCapacity(), PeakUsed * WorstWaste) << "seed " << Seed << ": fragmented";
}

TEST(SectionAllocator, RandomRunsNeverOverlapAndWasteLittle)
{
	for (uint32_t Seed = 1; Seed <= 5; ++Seed)
	{
		ASSERT_NO_FATAL_FAILURE(WalkRandomly(Seed, 16, 20'000, 1.25));
		ASSERT_NO_FATAL_FAILURE(WalkRandomly(Seed, 500, 20'000, 1.35));
	}
}

TEST(SectionAllocator, EmptiedIsOneRunAgain)
{
	FSectionAllocator Allocator;
	std::vector<FRun> Runs;
	std::mt19937 Random(3);
	for (int I = 0; I < 1000; ++I)
	{
		const uint32_t Count = 1 + Random() % 20;
		Runs.push_back({Allocator.Allocate(Count), Count});
	}
	std::shuffle(Runs.begin(), Runs.end(), Random);
	for (const FRun& Run : Runs) { Allocator.Free(Run.First, Run.Count); }
	const uint32_t Capacity = Allocator.GetCapacity();
	EXPECT_EQ(Allocator.Allocate(Capacity), 0u);
	EXPECT_EQ(Allocator.GetCapacity(), Capacity);
}

} // namespace
} // namespace Lantern
