// FGeometryBuildQueue: the order of builds and their limits. No device.
#include "Geometry/GeometryBuildQueue.h"

#include <string>

#include <gtest/gtest.h>

#include "LanternCore/Config/ConsoleVariables.h"

namespace Lantern
{
namespace
{

class FGeometryBuildQueueTest : public ::testing::Test
{
protected:
	void SetUp() override
	{
		FConsoleVariables::Get().ResetAll();
		SetLimit(0);
	}
	void TearDown() override
	{
		FConsoleVariables::Get().ResetAll();
		FConsoleVariables::Get().BeginFrame();
	}
	static void SetVariable(const char* Name, uint32_t Value)
	{
		EXPECT_EQ(FConsoleVariables::Get().Set(Name, std::to_string(Value), ERTSetBy::Console, "test"), std::nullopt);
		FConsoleVariables::Get().BeginFrame();
	}
	static void SetLimit(uint32_t Triangles) { SetVariable("r.RT.Build.TrianglesPerFrame", Triangles); }
	/// Queues a geometry. Its slot is the number of those before it. The result is valid until the next call.
	FGeometryEntry& Add(uint64_t Triangles = 100, float ScreenSize = 0.0f)
	{
		FRTGeometryInfo Info;
		Info.Sections = {{0, 3}};
		Owners.push_back(Slots.Create(std::move(Info)));
		FGeometryEntry& Entry = Slots[Owners.back()->GetSlot()];
		Queue.ResetPriority(Slots.GetSlot(Entry));
		Entry.Triangles = Triangles;
		Entry.QueuedFrame = Frame;
		if (ScreenSize > 0.0f) { Queue.RaisePriority(Slots.GetSlot(Entry), ScreenSize); }
		Queue.Add(Entry);
		return Entry;
	}
	/// The entry's frame was lost: it waits again.
	void Lose(FGeometryEntry& Entry)
	{
		Entry.bLost = true;
		Queue.Add(Entry);
	}
	/// Starts all that the queue offers. Returns their slots as digits.
	std::string Run(bool bAll = false, bool bSmallestFirst = false)
	{
		Stats.Built = 0;
		Stats.TrianglesBuilt = 0;
		std::string Order;
		const FRTStatus Status = Queue.Run({Frame, bAll, bSmallestFirst}, [&](FGeometryEntry& Entry, size_t, bool&) {
			Build(Entry);
			Order += std::to_string(Slots.GetSlot(Entry));
			return FRTStatus::Success();
		});
		EXPECT_TRUE(Status);
		return Order;
	}
	void Build(FGeometryEntry& Entry)
	{
		Entry.State = EGeometryState::Building;
		++Stats.Built;
		Stats.TrianglesBuilt += Entry.Triangles;
	}

	std::vector<uint64_t> Addresses;
	FGeometrySlots Slots{Addresses};
	FGeometryStoreStats Stats;
	FGeometryBuildQueue Queue{Slots, Stats};
	std::vector<FRTGeometryRef> Owners;
	uint64_t Frame = 1;
};

TEST_F(FGeometryBuildQueueTest, BigOnScreenComesFirstThenTheOldest)
{
	Add();
	Add(100, 0.2f);
	Add();
	Add(100, 0.9f);
	EXPECT_EQ(Queue.GetCount(), 4u);
	EXPECT_EQ(Run(), "3102");
	EXPECT_TRUE(Queue.IsEmpty());
	EXPECT_EQ(Run(), "");
}

TEST_F(FGeometryBuildQueueTest, SizeOnScreenIsRememberedUntilItIsSeenAnew)
{
	SetLimit(100);
	Add(100, 0.5f);
	Add(100, 0.4f);
	Add(100, 0.3f);
	EXPECT_EQ(Run(), "0");
	EXPECT_EQ(Slots[2].ScreenSize, 0.3f);
	Queue.RaisePriority(2, 0.1f);
	EXPECT_EQ(Run(), "1") << "0.4 is what was seen of it last";
	EXPECT_EQ(Slots[2].ScreenSize, 0.1f);
}

TEST_F(FGeometryBuildQueueTest, ARoundVisitsWhatChangedAndWhatItBuilds)
{
	SetLimit(100);
	for (int I = 0; I < 1000; ++I) { Add(100, 0.001f * static_cast<float>(I)); }
	EXPECT_EQ(Run(), "999");
	EXPECT_EQ(Run(), "998");
	EXPECT_EQ(Queue.GetVisited(), 1u) << "the others wait unseen";
	Queue.RaisePriority(5, 0.5f);
	Queue.RaisePriority(6, 3.0f);
	Queue.RaisePriority(7, 0.00701f); // about as large as it was
	EXPECT_EQ(Run(), "6");
	EXPECT_EQ(Queue.GetVisited(), 3u);
	EXPECT_EQ(Queue.GetCount(), 997u);
}

TEST_F(FGeometryBuildQueueTest, SmallestFirstGoesByBytes)
{
	Add(100, 9.0f).Sizes.StructureBytes = 3000;
	Add().Sizes.StructureBytes = 1000;
	Add().Sizes.StructureBytes = 2000;
	EXPECT_EQ(Run(true, true), "120");
}

TEST_F(FGeometryBuildQueueTest, LostBuildsComeFirstInAnyOrder)
{
	Add(100, 5.0f).Sizes.StructureBytes = 1;
	Add().Sizes.StructureBytes = 100;
	Lose(Slots[1]);
	EXPECT_EQ(Run(), "10");
	Queue.Add(Slots[0]);
	Queue.Add(Slots[1]);
	EXPECT_EQ(Run(true, true), "10");
}

TEST_F(FGeometryBuildQueueTest, WaitingGainsTwoHundredthOfAHeightInAFrame)
{
	SetLimit(100);
	for (const uint64_t Waited : {190u, 210u})
	{
		Owners.clear();
		uint32_t Coarse = 0;
		Slots.FreeReleased(Coarse);
		while (!Queue.IsEmpty()) { Run(true); }
		const uint32_t Old = Slots.GetSlot(Add());
		Frame += Waited;
		const uint32_t New = Slots.GetSlot(Add(100, 1.0f));
		Run();
		EXPECT_EQ(Slots[Old].State == EGeometryState::Building, Waited == 210u);
		EXPECT_EQ(Slots[New].State == EGeometryState::Building, Waited == 190u);
	}
}

TEST_F(FGeometryBuildQueueTest, LimitEndsTheRoundAtTheFirstThatExceedsIt)
{
	SetLimit(250);
	Add(100);
	Add(100);
	Add(100);
	Add(10);
	EXPECT_EQ(Run(), "01") << "what is behind does not overtake";
	EXPECT_EQ(Queue.GetCount(), 2u);
	EXPECT_EQ(Run(), "23");
}

TEST_F(FGeometryBuildQueueTest, FirstBuildOfAFrameMayExceedTheLimit)
{
	SetLimit(50);
	Add(1000);
	Add(1);
	EXPECT_EQ(Run(), "0");
	EXPECT_EQ(Run(), "1");
}

TEST_F(FGeometryBuildQueueTest, LostBuildsAndFullRoundsIgnoreTheLimit)
{
	SetLimit(100);
	for (int I = 0; I < 3; ++I) { Lose(Add(100)); }
	Add(100);
	EXPECT_EQ(Run(), "012");
	Add(100);
	EXPECT_EQ(Run(true), "34");
}

TEST_F(FGeometryBuildQueueTest, AFrameBuildsSoManyHoweverSmall)
{
	SetVariable("r.RT.Build.StructuresPerFrame", 2);
	for (int I = 0; I < 5; ++I) { Add(1); }
	EXPECT_EQ(Run(), "01");
	Lose(Slots[0]);
	Lose(Slots[1]);
	Add(1);
	EXPECT_EQ(Run(), "01") << "what was in the picture counts";
	Lose(Slots[0]);
	Lose(Slots[1]);
	Lose(Add(1)); // the seventh
	EXPECT_EQ(Run(), "016") << "and does not wait";
	EXPECT_EQ(Run(true), "2345") << "a picture that waits for all has no limit";
}

TEST_F(FGeometryBuildQueueTest, StopAndErrorKeepTheRestInOrder)
{
	for (const bool bError : {false, true})
	{
		std::vector<size_t> Left;
		for (int I = 0; I < 4; ++I) { Add(); }
		const uint32_t First = Slots.GetCount() - 4;
		const FRTStatus Status = Queue.Run({Frame}, [&](FGeometryEntry& Entry, size_t InLeft, bool& bOutStop) {
			Left.push_back(InLeft);
			const bool bSecond = Slots.GetSlot(Entry) == First + 1;
			if (!bSecond) { Build(Entry); }
			bOutStop = bSecond && !bError;
			return bSecond && bError ? FRTStatus::Error(ERTResult::DeviceLost, "gone") : FRTStatus::Success();
		});
		EXPECT_EQ(Status.Code, bError ? ERTResult::DeviceLost : ERTResult::Ok);
		EXPECT_EQ(Left, std::vector<size_t>({4, 3}));
		EXPECT_EQ(Queue.GetCount(), 3u) << "the one that waits stays too";
		const std::string Rest = std::to_string(First + 1) + std::to_string(First + 2) + std::to_string(First + 3);
		EXPECT_EQ(Run(), Rest);
	}
}

TEST_F(FGeometryBuildQueueTest, WhatStartAddsWaitsForTheNextRound)
{
	Add();
	Add();
	Slots[1].State = EGeometryState::Refused;
	uint32_t Calls = 0;
	const FRTStatus Status = Queue.Run({Frame}, [&](FGeometryEntry& Entry, size_t, bool&) {
		++Calls;
		Build(Entry);
		Queue.Add(Slots[1]);
		return FRTStatus::Success();
	});
	EXPECT_TRUE(Status);
	EXPECT_EQ(Calls, 1u) << "what is no longer pending is not offered";
	EXPECT_EQ(Run(), "1");
}

TEST_F(FGeometryBuildQueueTest, GoneAndRemovedAreNotOffered)
{
	Add();
	Add();
	Add();
	Owners[1].reset();
	Queue.Remove(2);
	EXPECT_EQ(Queue.GetCount(), 2u);
	EXPECT_EQ(Run(), "0");
	EXPECT_TRUE(Queue.IsEmpty());
}

} // namespace
} // namespace Lantern
