// FGeometryCoarsener: coarser levels are started, taken and given up.
#include "GeometryMisfitTestTools.h"

namespace Lantern
{
namespace
{

using FGeometryCoarsenerTest = FGeometryMisfitTest;

TEST_F(FGeometryCoarsenerTest, OnlyStaticTrianglesThatTheCpuHasCanBeCoarser)
{
	const FRTGeometryRef Terrain = AddTerrain("Terrain");
	EXPECT_TRUE(FGeometryCoarsener::CanCoarsen(Entry(Terrain)));
	Entry(Terrain).Coarsenings = 3;
	EXPECT_TRUE(FGeometryCoarsener::CanCoarsen(Entry(Terrain)));
	Entry(Terrain).Coarsenings = 4;
	EXPECT_FALSE(FGeometryCoarsener::CanCoarsen(Entry(Terrain)));
	Entry(Terrain).Coarsenings = 0;
	Set("r.RT.Build.CoarserLevels", "0");
	EXPECT_FALSE(FGeometryCoarsener::CanCoarsen(Entry(Terrain)));
	Set("r.RT.Build.CoarserLevels", "1");

	FRTGeometryInfo Info = MakeTerrain("Moving", 4);
	Info.bDynamic = true;
	const FRTGeometryRef Moving = Add(Info);
	Info = MakeTerrain("Boxes", 4);
	Info.Aabbs = Shared;
	Info.Sections[1] = {0, 1, true, true};
	const FRTGeometryRef Boxes = Add(Info);
	Info = MakeTerrain("NoIndices", 4);
	Info.CpuIndices = nullptr;
	const FRTGeometryRef NoIndices = Add(Info), Rock = Add("Rock", 100);
	for (const FRTGeometryRef& Geometry : {Moving, Boxes, NoIndices, Rock})
	{
		EXPECT_FALSE(FGeometryCoarsener::CanCoarsen(Entry(Geometry))) << Geometry->GetInfo().Name;
		EXPECT_FALSE(Coarsener->Start(Entry(Geometry), 1 << 20));
	}
	EXPECT_EQ(Coarsener->GetCount(), 0u);
}

TEST_F(FGeometryCoarsenerTest, LevelFitsAndIsQueued)
{
	const FRTGeometryRef Terrain = AddTerrain("Terrain");
	FGeometryEntry& Item = Entry(Terrain);
	const uint64_t Before = Item.Triangles, Room = GetBuildBytes(Terrain) / 2;
	ASSERT_EQ(Before, 3200u);
	ASSERT_TRUE(Coarsener->Start(Item, Room));
	EXPECT_EQ(Item.State, EGeometryState::Coarsening);
	EXPECT_EQ(Item.Coarsenings, 1u);
	EXPECT_EQ(Coarsener->GetCount(), 1u);
	EXPECT_FALSE(Terrain->IsCoarse());
	ASSERT_TRUE(Coarsener->Finish(Item));
	EXPECT_EQ(Item.State, EGeometryState::Pending);
	EXPECT_EQ(Coarsener->GetCount(), 0u);
	EXPECT_FALSE(Coarsener->IsAnyDone());
	EXPECT_EQ(Context->Queue.GetCount(), 1u);
	EXPECT_EQ(Context->Stats.Coarse, 1u);
	EXPECT_TRUE(Terrain->IsCoarse());
	EXPECT_LT(Item.Triangles, Before / 2);
	EXPECT_GT(Item.Triangles, Before / 20);
	EXPECT_EQ(Item.Triangles, Terrain->GetPrimitiveCount());
	EXPECT_LE(GetBuildBytes(Terrain), Room);
	ASSERT_TRUE(Item.Staging);
	EXPECT_EQ(Item.Staging->GetDesc().Size, Item.Triangles * 12);
	EXPECT_EQ(Terrain->GetIndices()->GetDesc().Size, Item.Triangles * 12);
	EXPECT_EQ(Terrain->GetIndicesOffset(), 0u);
	EXPECT_EQ(Terrain->GetParts().size(), 2u);
	EXPECT_EQ(Slots().TakeChanged(), std::vector<uint32_t>({Terrain->GetSlot()}));
}

TEST_F(FGeometryCoarsenerTest, LevelThatWouldBeNoPictureIsNotStarted)
{
	const FRTGeometryRef Terrain = AddTerrain("Terrain");
	EXPECT_FALSE(Coarsener->Start(Entry(Terrain), 1000));
	EXPECT_EQ(Entry(Terrain).Coarsenings, 0u);
	EXPECT_EQ(Entry(Terrain).State, EGeometryState::Free);
	EXPECT_EQ(Entry(Terrain).GetCoarserLevel(), nullptr);
	EXPECT_EQ(Coarsener->GetCount(), 0u);
}

TEST_F(FGeometryCoarsenerTest, MuchRoomStillMakesItCoarser)
{
	const FRTGeometryRef Terrain = AddTerrain("Terrain");
	ASSERT_TRUE(Coarsener->Start(Entry(Terrain), 1ull << 40)) << "the device had less memory than the budget";
	ASSERT_TRUE(Coarsener->Finish(Entry(Terrain)));
	EXPECT_LT(Entry(Terrain).Triangles, 3200u * 4 / 5);
	EXPECT_GT(Entry(Terrain).Triangles, 3200u / 2);
}

TEST_F(FGeometryCoarsenerTest, SecondLevelIsCoarserThanTheFirst)
{
	const FRTGeometryRef Terrain = AddTerrain("Terrain");
	FGeometryEntry& Item = Entry(Terrain);
	ASSERT_TRUE(Coarsener->Start(Item, GetBuildBytes(Terrain) / 2));
	ASSERT_TRUE(Coarsener->Finish(Item));
	const uint64_t First = Item.Triangles;
	ASSERT_TRUE(Coarsener->Start(Item, GetBuildBytes(Terrain) / 2));
	ASSERT_TRUE(Coarsener->Finish(Item));
	EXPECT_LT(Item.Triangles, First);
	EXPECT_EQ(Item.Coarsenings, 2u);
	EXPECT_EQ(Context->Stats.Coarse, 1u) << "one geometry, however often";
}

TEST_F(FGeometryCoarsenerTest, OutOfDeviceMemoryTakesTheLevelLater)
{
	const FRTGeometryRef Terrain = AddTerrain("Terrain");
	FGeometryEntry& Item = Entry(Terrain);
	ASSERT_TRUE(Coarsener->Start(Item, GetBuildBytes(Terrain) / 2));
	for (const uint32_t N : {1u, 2u}) // indices, staging
	{
		Mock().FailAllocation(N);
		EXPECT_TRUE(Coarsener->Finish(Item)) << N;
		EXPECT_EQ(Item.State, EGeometryState::Coarsening);
		EXPECT_EQ(Coarsener->GetCount(), 1u);
		EXPECT_TRUE(Coarsener->IsAnyDone());
		EXPECT_FALSE(Terrain->IsCoarse() || Item.Staging);
	}
	EXPECT_TRUE(Coarsener->TakeDone());
	EXPECT_EQ(Item.State, EGeometryState::Pending);
}

TEST_F(FGeometryCoarsenerTest, LostDeviceIsAnErrorAndKeepsTheLevel)
{
	const FRTGeometryRef Terrain = AddTerrain("Terrain");
	ASSERT_TRUE(Coarsener->Start(Entry(Terrain), GetBuildBytes(Terrain) / 2));
	Mock().LoseDeviceAt(ERTMockCall::CreateBuffer);
	EXPECT_EQ(Coarsener->Finish(Entry(Terrain)).Code, ERTResult::DeviceLost);
	EXPECT_EQ(Entry(Terrain).State, EGeometryState::Coarsening);
	EXPECT_EQ(Coarsener->GetCount(), 1u);
}

TEST_F(FGeometryCoarsenerTest, ReleasedGeometryIsForgotten)
{
	FRTGeometryRef Terrain = AddTerrain("Terrain");
	ASSERT_TRUE(Coarsener->Start(Entry(Terrain), GetBuildBytes(Terrain) / 2));
	Terrain.reset();
	EXPECT_FALSE(Coarsener->IsAnyDone());
	EXPECT_TRUE(Coarsener->TakeDone());
	EXPECT_EQ(Coarsener->GetCount(), 0u);
	EXPECT_EQ(Context->Stats.Coarse, 0u);
	EXPECT_TRUE(Context->Queue.IsEmpty());
}

} // namespace
} // namespace Lantern
