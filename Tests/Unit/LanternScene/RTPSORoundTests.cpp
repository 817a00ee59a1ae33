// A round of compiles: its queue, its deadline, and units that outlive it.
#include "Pipelines/RTPSORound.h"

#include <gtest/gtest.h>

namespace Lantern
{
namespace
{

using namespace std::chrono_literals;

class FCompileRoundTest : public ::testing::Test
{
protected:
	static std::vector<FUnitStateRef> MakeUnits(size_t Count)
	{
		std::vector<FUnitStateRef> Units(Count);
		for (FUnitStateRef& Unit : Units) { Unit = std::make_shared<FUnitState>(); }
		return Units;
	}

	FCompileRound Round;
	FTrash Trash;
	const FCompileRound::FTime Start{1h};
};

TEST_F(FCompileRoundTest, UnitsAreTakenInOrderAndTheRoundIsOverWhenTheLastOneEnds)
{
	const auto Units = MakeUnits(2);
	EXPECT_FALSE(Round.IsOpen());
	EXPECT_FALSE(Round.IsOver(Start, true)) << "there is none";
	Round.Add(Units, Start + 1s);
	EXPECT_TRUE(Round.IsOpen());
	for (const FUnitStateRef& Unit : Units)
	{
		EXPECT_EQ(Unit->Work, EUnitWork::Queued);
		ASSERT_TRUE(Round.HasUnit());
		EXPECT_EQ(Round.TakeUnit(), Unit);
		EXPECT_EQ(Unit->Work, EUnitWork::Compiling);
	}
	EXPECT_FALSE(Round.HasUnit());
	Round.EndUnit(*Units[1]);
	EXPECT_EQ(Units[1]->Work, EUnitWork::Idle);
	EXPECT_FALSE(Round.IsOver(Start, true));
	Round.EndUnit(*Units[0]);
	EXPECT_TRUE(Round.IsOver(Start, true));
	EXPECT_TRUE(Round.IsOver(Start, false));
}

TEST_F(FCompileRoundTest, TheDeadlineIsThatOfTheFirstUnits)
{
	Round.Add(MakeUnits(1), Start + 1s);
	Round.Add(MakeUnits(1), Start + 1h);
	EXPECT_FALSE(Round.IsOver(Start + 999ms, true));
	EXPECT_TRUE(Round.IsOver(Start + 1s, true));
	EXPECT_FALSE(Round.IsOver(Start + 2h, false)) << "who waits for all has no deadline";
}

TEST_F(FCompileRoundTest, WhatNobodyHasTakenWaitsForAnotherRound)
{
	const auto Units = MakeUnits(3);
	Round.Add(Units, Start);
	const FUnitStateRef Taken = Round.TakeUnit();
	Round.Close(Trash);
	EXPECT_FALSE(Round.IsOpen());
	EXPECT_FALSE(Round.HasUnit());
	EXPECT_EQ(Units[0]->Work, EUnitWork::Compiling) << "it outlives its round";
	EXPECT_EQ(Units[1]->Work, EUnitWork::Idle);
	EXPECT_EQ(Units[2]->Work, EUnitWork::Idle);
	EXPECT_TRUE(Round.IsAnyRunning());
	Round.Add({Units[2]}, Start);
	EXPECT_EQ(Round.TakeUnit(), Units[2]);
	Round.EndUnit(*Units[2]);
	EXPECT_FALSE(Round.IsOver(Start, false)) << "the one of the round before has not ended";
	Round.EndUnit(*Taken);
	EXPECT_TRUE(Round.IsOver(Start, false));
	EXPECT_FALSE(Round.IsAnyRunning());
}

TEST_F(FCompileRoundTest, EachRoundHasItsOwnSharedShadersAndTheTrashGetsTheOld)
{
	Round.Add(MakeUnits(1), Start);
	const std::weak_ptr<FSharedShaders> First = Round.GetShared();
	ASSERT_FALSE(First.expired());
	Round.Close(Trash);
	EXPECT_FALSE(First.expired());
	Trash.Take();
	EXPECT_TRUE(First.expired());
	Round.Add(MakeUnits(1), Start);
	EXPECT_TRUE(Round.GetShared());
}

TEST_F(FCompileRoundTest, AnAbandonedRoundHandsOutNothing)
{
	Round.Add(MakeUnits(2), Start);
	const FUnitStateRef Taken = Round.TakeUnit();
	Round.Abandon();
	EXPECT_FALSE(Round.HasUnit());
	Round.EndUnit(*Taken);
	EXPECT_TRUE(Round.IsOver(Start, false));
}

} // namespace
} // namespace Lantern
