// FGeometryBuilder: structures, scratch and commands of a frame.
#include <algorithm>
#include <cstring>

#include "GeometryContextTestTools.h"

namespace Lantern
{
namespace
{

class FGeometryBuilderTest : public FGeometryContextTest
{
protected:
	/// Adds builds of 600 triangles. Each needs 38,656 bytes of scratch: a buffer of one step holds one, not two.
	void AddBuilds(uint32_t Count)
	{
		for (uint32_t I = 0; I < Count; ++I)
		{
			Rocks.push_back(Add("Rock", 600));
			ASSERT_EQ(Entry(Rocks.back()).Sizes.BuildScratchBytes, BuildScratch);
			ASSERT_TRUE(Builder->AddBuild(Entry(Rocks.back())));
		}
	}
	std::vector<uint64_t> GetScratchOffsets()
	{
		std::vector<uint64_t> Offsets;
		for (const FRTMockCall& Call : Mock().FindCalls(ERTMockCall::BuildGeometry)) { Offsets.push_back(Call.Numbers[2]); }
		return Offsets;
	}
	size_t FindFirst(ERTMockCall Kind)
	{
		const std::vector<FRTMockCall> Calls = Mock().GetCalls();
		const auto Is = [=](const FRTMockCall& Call) { return Call.Kind == Kind; };
		return static_cast<size_t>(std::find_if(Calls.begin(), Calls.end(), Is) - Calls.begin());
	}

	static constexpr uint64_t BuildScratch = 38656;
	std::vector<FRTGeometryRef> Rocks;
};

TEST_F(FGeometryBuilderTest, BuildMakesAStructureAndItsAddress)
{
	const FRTGeometryRef Rock = Add("Rock", 100);
	Context->Queue.Add(Entry(Rock));
	EXPECT_FALSE(Builder->HasBuilds());
	ASSERT_TRUE(Builder->AddBuild(Entry(Rock)));
	EXPECT_TRUE(Builder->HasBuilds());
	EXPECT_EQ(Entry(Rock).State, EGeometryState::Building);
	ASSERT_NE(Rock->GetStructure(), nullptr);
	EXPECT_EQ(AddressOf(Rock), Rock->GetStructure()->GetDeviceAddress());
	EXPECT_TRUE(Rock->IsBuilt());
	EXPECT_EQ(Context->Stats.Built, 1u);
	EXPECT_EQ(Context->Stats.TrianglesBuilt, 100u);
	EXPECT_EQ(Context->Stats.PeakBytes, GetUsed());
	ASSERT_TRUE(RunCommands());
	EXPECT_FALSE(Builder->HasBuilds());
	EXPECT_EQ(Entry(Rock).State, EGeometryState::Built);
	EXPECT_EQ(Entry(Rock).Builds, 1u);
	EXPECT_EQ(Mock().GetGeometry(Rock->GetStructure()).BuildCount, 1u);
	EXPECT_EQ(Rock.use_count(), 1) << "still held";
}

TEST_F(FGeometryBuilderTest, FailureLeavesTheEntryPending)
{
	for (const uint32_t N : {1u, 2u}) // the scratch buffer, the structure
	{
		const FRTGeometryRef Rock = Add("Rock", 1000 * N);
		Context->Queue.Add(Entry(Rock));
		Mock().FailAllocation(N);
		EXPECT_EQ(Builder->AddBuild(Entry(Rock)).Code, ERTResult::OutOfDeviceMemory) << N;
		EXPECT_EQ(Entry(Rock).State, EGeometryState::Pending);
		EXPECT_EQ(Rock->GetStructure(), nullptr);
		EXPECT_EQ(AddressOf(Rock), 0u);
		EXPECT_FALSE(Builder->HasBuilds() || Compactor->HasCommands() || Rock->IsBuilt());
		EXPECT_EQ(Rock.use_count(), 1);
	}
	EXPECT_EQ(Context->Stats.Built, 0u);
}

TEST_F(FGeometryBuilderTest, LostBuildIsQueuedAndKeepsItsStructure)
{
	const FRTGeometryRef Rock = Add("Rock", 100);
	ASSERT_TRUE(Builder->AddBuild(Entry(Rock)));
	ASSERT_TRUE(RunCommands(false));
	EXPECT_EQ(Entry(Rock).State, EGeometryState::Pending);
	EXPECT_TRUE(Entry(Rock).bLost);
	EXPECT_EQ(Entry(Rock).Builds, 0u);
	EXPECT_FALSE(Rock->IsBuilt());
	EXPECT_EQ(AddressOf(Rock), 0u);
	EXPECT_EQ(Context->Queue.GetCount(), 1u);
	ASSERT_TRUE(Builder->AddBuild(Entry(Rock)));
	EXPECT_FALSE(Entry(Rock).bLost);
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::CreateGeometry, "Rock"), 1u);
	ASSERT_TRUE(RunCommands());
	EXPECT_EQ(Mock().GetGeometry(Rock->GetStructure()).BuildCount, 1u);
}

TEST_F(FGeometryBuilderTest, RefitsAreCountedUntilARebuild)
{
	const FRTGeometryRef Body = AddBuilt("Body", 100, true);
	FGeometryEntry& Item = Entry(Body);
	Item.RefitRatio = 3.0f;
	Item.bUpdate = true;
	Builder->AddRefit(Item);
	ASSERT_TRUE(RunCommands());
	EXPECT_EQ(Item.RefitsSinceBuild, 1u);
	EXPECT_EQ(Item.RefitRatio, 3.0f);
	EXPECT_EQ(Item.Builds, 1u);
	Item.bUpdate = false;
	Builder->AddRefit(Item);
	ASSERT_TRUE(RunCommands());
	EXPECT_EQ(Item.RefitsSinceBuild, 0u);
	EXPECT_EQ(Item.RefitRatio, 1.0f) << "it was measured of the structure before";
	EXPECT_EQ(Item.Builds, 2u);
	const FRTMockGeometry Built = Mock().GetGeometry(Body->GetStructure());
	EXPECT_EQ(Built.UpdateCount, 1u);
	EXPECT_EQ(Built.BuildCount, 2u);
}

TEST_F(FGeometryBuilderTest, LostRefitsAreDeformedAnewAndLostRebuildsStayRebuilds)
{
	const FRTGeometryRef A = AddBuilt("A", 100, true), B = AddBuilt("B", 100, true);
	const uint64_t Address = AddressOf(A);
	Entry(A).bUpdate = true;
	Entry(B).bUpdate = false;
	Builder->AddRefit(Entry(A));
	Builder->AddRefit(Entry(B));
	ASSERT_TRUE(RunCommands(false));
	EXPECT_EQ(AddressOf(A), Address) << "it is as it was, and may be traced";
	EXPECT_FALSE(Entry(A).bRebuild);
	EXPECT_TRUE(Entry(B).bRebuild);
	std::vector<FGeometryEntry*> Work;
	ASSERT_TRUE(Refits->Choose(Work));
	EXPECT_EQ(Work, std::vector<FGeometryEntry*>({&Entry(A), &Entry(B)}));
	EXPECT_TRUE(Entry(A).bUpdate);
	EXPECT_FALSE(Entry(B).bUpdate);
	for (FGeometryEntry* const Item : Work) { Builder->AddRefit(*Item); }
	ASSERT_TRUE(RunCommands());
	EXPECT_FALSE(Entry(B).bRebuild);
}

TEST_F(FGeometryBuilderTest, BuildsThatDoNotFitTogetherHaveABarrierBetween)
{
	AddBuilds(2);
	Mock().ClearCalls();
	ASSERT_TRUE(RunCommands());
	EXPECT_EQ(GetScratchOffsets(), std::vector<uint64_t>({0, 0}));
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::Barrier), 2u);
}

TEST_F(FGeometryBuilderTest, LargerScratchMakesOneBatch)
{
	AddBuilds(3);
	ASSERT_TRUE(Builder->GrowForBatches());
	Mock().ClearCalls();
	ASSERT_TRUE(RunCommands());
	EXPECT_EQ(GetScratchOffsets(), std::vector<uint64_t>({0, BuildScratch, 2 * BuildScratch}));
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::Barrier), 1u);
}

TEST_F(FGeometryBuilderTest, BatchesTakeAQuarterOfTheRoomAtMost)
{
	AddBuilds(2);
	constexpr uint64_t Growth = 2 * FBuildScratch::Step;
	FillBudget(4, 4 * Growth - 1);
	ASSERT_TRUE(Builder->GrowForBatches());
	EXPECT_EQ(Context->Scratch.Get()->GetDesc().Size, FBuildScratch::Step);
	EmptyBudget();
	FillBudget(4, 4 * Growth);
	Mock().FailAllocation(1);
	EXPECT_TRUE(Builder->GrowForBatches()) << "what there is will do";
	EXPECT_EQ(Context->Scratch.Get()->GetDesc().Size, FBuildScratch::Step);
	ASSERT_TRUE(Builder->GrowForBatches());
	EXPECT_EQ(Context->Scratch.Get()->GetDesc().Size, Growth);
	ASSERT_TRUE(RunCommands());
}

TEST_F(FGeometryBuilderTest, NothingToBuildNeedsNoScratch)
{
	ASSERT_TRUE(Builder->GrowForBatches());
	EXPECT_EQ(Context->Scratch.Get(), nullptr);
}

TEST_F(FGeometryBuilderTest, StagedIndicesAreCopiedBeforeTheBuildUntilAFrameRuns)
{
	constexpr uint32_t Indices[] = {3, 1, 4, 1, 5, 9};
	FRTGeometryInfo Info = MakeInfo("Rock", 2);
	const ERTBufferUsage Usage = ERTBufferUsage::Storage | ERTBufferUsage::GeometryInput | ERTBufferUsage::CopyDest;
	ASSERT_TRUE(Device->CreateBuffer({sizeof(Indices), Usage, ERTMemory::Device, "Indices"}, Info.Indices.ReleaseAndGetAddress()));
	const FRTGeometryRef Rock = Add(Info);
	FGeometryEntry& Item = Entry(Rock);
	const FRTBufferDesc Desc{sizeof(Indices), ERTBufferUsage::CopySource, ERTMemory::Upload, "Staging"};
	ASSERT_TRUE(Device->CreateBuffer(Desc, Item.Staging.ReleaseAndGetAddress()));
	std::memcpy(Item.Staging->GetMapped(), Indices, sizeof(Indices));
	ASSERT_TRUE(Builder->AddBuild(Item));
	ASSERT_TRUE(RunCommands(false));
	EXPECT_TRUE(Item.Staging) << "the copy never ran";
	ASSERT_TRUE(Builder->AddBuild(Item));
	Mock().ClearCalls();
	ASSERT_TRUE(RunCommands());
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::CopyBuffer), 1u);
	EXPECT_LT(FindFirst(ERTMockCall::CopyBuffer), FindFirst(ERTMockCall::BuildGeometry));
	EXPECT_EQ(std::memcmp(Mock().GetBytes(Info.Indices.Get()), Indices, sizeof(Indices)), 0);
	EXPECT_FALSE(Item.Staging);
}

} // namespace
} // namespace Lantern
