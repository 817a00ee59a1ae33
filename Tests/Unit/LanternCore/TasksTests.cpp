#include <algorithm>
#include <atomic>
#include <mutex>
#include <numeric>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "LanternCore/Tasks/Tasks.h"

namespace Lantern
{
namespace
{

TEST(ParallelFor, VisitsEveryIndexOnce)
{
	for (const size_t Count : {1u, 2u, 7u, 64u, 1000u, 100'003u})
	{
		for (const size_t Grain : {0u, 1u, 3u, 64u, 5000u})
		{
			std::vector<int> Visits(Count, 0); // not atomic: chunks must not overlap
			ParallelFor(Count, Grain, [&](size_t Begin, size_t End) {
				for (size_t I = Begin; I < End; ++I) ++Visits[I];
			});
			EXPECT_TRUE(std::all_of(Visits.begin(), Visits.end(), [](int N) { return N == 1; })) << Count << " by " << Grain;
		}
	}
}

TEST(ParallelFor, ChunksAreNoSmallerThanTheGrain)
{
	for (const size_t Count : {10u, 99u, 1001u, 4097u})
	{
		for (const size_t Grain : {1u, 10u, 33u, 500u})
		{
			std::mutex Mutex;
			std::vector<size_t> Sizes;
			ParallelFor(Count, Grain, [&](size_t Begin, size_t End) {
				std::lock_guard Lock(Mutex);
				Sizes.push_back(End - Begin);
			});
			EXPECT_GE(*std::min_element(Sizes.begin(), Sizes.end()), std::min(Grain, Count));
			EXPECT_EQ(std::accumulate(Sizes.begin(), Sizes.end(), size_t(0)), Count);
		}
	}
}

TEST(ParallelFor, NothingToDoAndAHugeGrain)
{
	int Calls = 0;
	ParallelFor(0, 1, [&](size_t, size_t) { ++Calls; });
	EXPECT_EQ(Calls, 0);
	ParallelFor(10, ~size_t(0), [&](size_t Begin, size_t End) {
		++Calls;
		EXPECT_EQ(End - Begin, 10u);
	});
	EXPECT_EQ(Calls, 1);
}

TEST(ParallelFor, MayBeNested)
{
	std::atomic<int> Sum{0};
	ParallelFor(16, 1, [&](size_t Begin, size_t End) {
		for (size_t I = Begin; I < End; ++I) ParallelFor(100, 10, [&](size_t B, size_t E) { Sum += static_cast<int>(E - B); });
	});
	EXPECT_EQ(Sum, 1600);
}

TEST(TaskGroup, WaitSeesWhatTasksWrote)
{
	std::vector<int> Results(500, 0); // plain memory: Wait orders it
	FTaskGroup Group;
	for (size_t I = 0; I < Results.size(); ++I) Group.Run([&Results, I] { Results[I] = static_cast<int>(I) + 1; });
	Group.Wait();
	for (size_t I = 0; I < Results.size(); ++I) EXPECT_EQ(Results[I], static_cast<int>(I) + 1);
	// And again with the same group.
	Group.Run([&] { Results[0] = -1; });
	Group.Wait();
	EXPECT_EQ(Results[0], -1);
}

TEST(TaskGroup, ATaskMayStartTasks)
{
	std::atomic<int> Count{0};
	FTaskGroup Group;
	std::function<void(int)> Branch = [&](int Depth) {
		++Count;
		if (Depth == 0) return;
		Group.Run([&, Depth] { Branch(Depth - 1); });
		Group.Run([&, Depth] { Branch(Depth - 1); });
	};
	Group.Run([&] { Branch(6); });
	Group.Wait();
	EXPECT_EQ(Count, 127);
}

TEST(TaskGroup, DestructionWaits)
{
	std::atomic<int> Done{0};
	{
		FTaskGroup Group;
		for (int I = 0; I < 20; ++I)
			Group.Run([&] {
				std::this_thread::sleep_for(std::chrono::milliseconds(1));
				++Done;
			});
	}
	EXPECT_EQ(Done, 20);
	FTaskGroup Unused;
}

TEST(TaskGroup, WhatATaskHoldsIsReleasedByWait)
{
	auto Held = std::make_shared<int>(1);
	FTaskGroup Group;
	Group.Run([Held] {});
	Group.Wait();
	EXPECT_EQ(Held.use_count(), 1);
}

TEST(TaskGroup, TasksMayWaitForGroupsOfTheirOwn)
{
	std::atomic<int> Sum{0};
	FTaskGroup Outer;
	for (int I = 0; I < 8; ++I)
		Outer.Run([&] {
			FTaskGroup Inner;
			for (int J = 0; J < 8; ++J) Inner.Run([&] { ++Sum; });
			Inner.Wait();
		});
	Outer.Wait();
	EXPECT_EQ(Sum, 64);
}

TEST(TasksDeathTest, AnExceptionOutOfATaskEndsTheProgram)
{
	GTEST_FLAG_SET(death_test_style, "threadsafe");
	EXPECT_DEATH(
	    {
		    FTaskGroup Group;
		    Group.Run([] { throw 1; });
		    Group.Wait();
	    },
	    "");
}

TEST(Tasks, ThereIsAWorker) { EXPECT_GE(GetWorkerCount(), 1u); }

} // namespace
} // namespace Lantern
