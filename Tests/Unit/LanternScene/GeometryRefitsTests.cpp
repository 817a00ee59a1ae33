// FGeometryRefits: which deformed geometries are refitted and which are rebuilt.
#include "GeometryContextTestTools.h"

namespace Lantern
{
namespace
{

class FGeometryRefitsTest : public FGeometryContextTest
{
protected:
	void SetUp() override
	{
		FGeometryContextTest::SetUp();
		Set("r.RT.Skinning.RebuildInterval", "1000");
		Set("r.RT.Skinning.RebuildQuality", "2");
	}
	void AddBodies(uint32_t Count)
	{
		for (uint32_t I = 0; I < Count; ++I) { Bodies.push_back(AddBuilt("Body", 100, true)); }
		for (const FRTGeometryRef& Body : Bodies) { Refits->Add(Entry(Body)); }
	}
	/// Slots of what is rebuilt.
	std::vector<uint32_t> Choose()
	{
		Work.clear();
		Status = Refits->Choose(Work);
		std::vector<uint32_t> Rebuilt;
		for (const FGeometryEntry* Item : Work)
		{
			if (!Item->bUpdate) { Rebuilt.push_back(Slots().GetSlot(*Item)); }
		}
		EXPECT_EQ(Context->Stats.Rebuilt, Rebuilt.size());
		EXPECT_EQ(Context->Stats.Refitted + Context->Stats.Rebuilt, Work.size());
		return Rebuilt;
	}

	std::vector<FRTGeometryRef> Bodies;
	std::vector<FGeometryEntry*> Work;
	FRTStatus Status;
};

TEST_F(FGeometryRefitsTest, EachIsRefittedOnceInTheOrderOfItsDeformation)
{
	AddBodies(2);
	Refits->Add(Entry(Bodies[0]));
	EXPECT_FALSE(Refits->IsEmpty());
	EXPECT_EQ(Choose(), std::vector<uint32_t>());
	EXPECT_TRUE(Status);
	EXPECT_EQ(Work, std::vector<FGeometryEntry*>({&Entry(Bodies[0]), &Entry(Bodies[1])}));
	EXPECT_EQ(Context->Stats.TrianglesBuilt, 0u);
	EXPECT_TRUE(Refits->IsEmpty());
	Refits->Add(Entry(Bodies[0]));
	EXPECT_FALSE(Refits->IsEmpty()) << "the next frame may deform it again";
}

TEST_F(FGeometryRefitsTest, WhatIsGoneOrNotBuiltIsPassedOver)
{
	AddBodies(3);
	Entry(Bodies[1]).State = EGeometryState::Pending;
	Bodies[2].reset();
	Choose();
	EXPECT_EQ(Work.size(), 1u);
}

TEST_F(FGeometryRefitsTest, RebuildsAfterTheIntervalAreSpread)
{
	Set("r.RT.Skinning.RebuildInterval", "4");
	AddBodies(8);
	for (uint32_t I = 0; I < 8; ++I) { Entry(Bodies[I]).RefitsSinceBuild = I; }
	EXPECT_EQ(Choose(), std::vector<uint32_t>({6, 7})) << "a quarter of eight, those that waited longest";
	EXPECT_EQ(Context->Stats.TrianglesBuilt, 200u);
}

TEST_F(FGeometryRefitsTest, NothingIsRebuiltBeforeTheInterval)
{
	Set("r.RT.Skinning.RebuildInterval", "4");
	AddBodies(2);
	Entry(Bodies[0]).RefitsSinceBuild = 2;
	Entry(Bodies[1]).RefitsSinceBuild = 3;
	EXPECT_EQ(Choose(), std::vector<uint32_t>({1}));
}

TEST_F(FGeometryRefitsTest, LoosestComesFirst)
{
	AddBodies(3);
	Entry(Bodies[0]).RefitRatio = 2.0f; // not above it
	Entry(Bodies[1]).RefitRatio = 2.5f;
	Entry(Bodies[2]).RefitRatio = 3.0f;
	EXPECT_EQ(Choose(), std::vector<uint32_t>({2}));
	NextFrame();
	for (const FRTGeometryRef& Body : Bodies) { Refits->Add(Entry(Body)); }
	Set("r.RT.Skinning.RebuildQuality", "0");
	EXPECT_FALSE(FGeometryRefits::IsQualityWanted());
	EXPECT_EQ(Choose(), std::vector<uint32_t>());
}

TEST_F(FGeometryRefitsTest, LostRebuildsIgnoreTheLimitAndTheBudget)
{
	AddBodies(3);
	for (const FRTGeometryRef& Body : Bodies) { Entry(Body).bRebuild = true; }
	Entry(Bodies[0]).Sizes.BuildScratchBytes = 10 << 20;
	FillBudget(8, 0);
	EXPECT_EQ(Choose(), std::vector<uint32_t>({0, 1, 2}));
	EXPECT_GE(Context->Scratch.Get()->GetDesc().Size, 10u << 20);
}

TEST_F(FGeometryRefitsTest, RebuildThatDoesNotFitStaysARefit)
{
	Set("r.RT.Skinning.RebuildInterval", "1");
	AddBodies(2);
	Entry(Bodies[0]).Sizes.BuildScratchBytes = 10 << 20;
	FillBudget(8, 0);
	EXPECT_EQ(Choose(), std::vector<uint32_t>({1}));
	EXPECT_TRUE(Status);
}

TEST_F(FGeometryRefitsTest, ScratchHoldsTheLargestAloneAndIsReserved)
{
	AddBodies(2);
	Entry(Bodies[1]).Sizes.UpdateScratchBytes = 3 * FBuildScratch::Step;
	Choose();
	EXPECT_EQ(Context->Scratch.Get()->GetDesc().Size, 3 * FBuildScratch::Step);
	Refits->Add(Entry(Bodies[0]));
	Choose();
	Entry(Bodies[1]).Sizes.UpdateScratchBytes = 5 * FBuildScratch::Step;
	Refits->Add(Entry(Bodies[1]));
	Mock().FailAllocation(1);
	Choose();
	EXPECT_EQ(Status.Code, ERTResult::OutOfDeviceMemory);
	EXPECT_EQ(Work.size(), 1u) << "the caller must know what to record again";
	EXPECT_EQ(Context->Scratch.GetGrowth(1), 5 * FBuildScratch::Step);
}

} // namespace
} // namespace Lantern
