// FGeometryRefusals: what is left out, and when it is tried again.
#include "GeometryMisfitTestTools.h"
#include "Support/CoreTestTools.h"

namespace Lantern
{
namespace
{

class FGeometryRefusalsTest : public FGeometryMisfitTest
{
protected:
	/// Whether the only refused geometry is tried again with Room bytes.
	bool IsTriedAgain(uint64_t Room)
	{
		EmptyBudget();
		FillBudget(8, Room);
		const bool bWorth = Refusals->IsAnyWorthAnotherTry();
		const uint32_t Before = Context->Queue.GetCount();
		Refusals->Reconsider();
		EXPECT_EQ(Refusals->GetCount(), bWorth ? 0u : 1u);
		EXPECT_EQ(Context->Queue.GetCount(), Before + (bWorth ? 1 : 0));
		return bWorth;
	}
};

TEST_F(FGeometryRefusalsTest, RefusedGeometryGivesItsStructureBack)
{
	const FRTGeometryRef Rock = Add("Rock", 1000);
	ASSERT_TRUE(Builder->AddBuild(Entry(Rock)));
	ASSERT_TRUE(RunCommands(false)); // lost, but its structure is there
	ASSERT_NE(Rock->GetStructure(), nullptr);
	Refusals->Refuse(Entry(Rock), 123);
	EXPECT_EQ(Entry(Rock).State, EGeometryState::Refused);
	EXPECT_EQ(Entry(Rock).RefusedRoom, 123u);
	EXPECT_EQ(Rock->GetStructure(), nullptr);
	EXPECT_EQ(Device->GetMemoryStats().Geometry, 0u);
	EXPECT_EQ(Refusals->GetCount(), 1u);
}

TEST_F(FGeometryRefusalsTest, ItComesBackWhenItFits)
{
	const FRTGeometryRef Rock = Add("Rock", 1000);
	const uint64_t Bytes = GetBuildBytes(Rock);
	Refusals->Refuse(Entry(Rock), 0);
	EXPECT_FALSE(IsTriedAgain(Bytes - 1));
	EXPECT_EQ(Entry(Rock).State, EGeometryState::Refused);
	EXPECT_TRUE(IsTriedAgain(Bytes));
	EXPECT_EQ(Entry(Rock).State, EGeometryState::Pending);
}

TEST_F(FGeometryRefusalsTest, WhatCanBeCoarserComesBackWithMoreThanTwiceTheRoom)
{
	const FRTGeometryRef Terrain = AddTerrain("Terrain");
	ASSERT_GT(GetBuildBytes(Terrain), 400000u);
	Refusals->Refuse(Entry(Terrain), 150000);
	EXPECT_FALSE(IsTriedAgain(300001));
	Set("r.RT.Build.CoarserLevels", "0");
	EXPECT_FALSE(IsTriedAgain(300002));
	Set("r.RT.Build.CoarserLevels", "1");
	EXPECT_TRUE(IsTriedAgain(300002));
}

TEST_F(FGeometryRefusalsTest, NextToNoRoomIsNotTwiceAsMuch)
{
	const FRTGeometryRef Terrain = AddTerrain("Terrain");
	Refusals->Refuse(Entry(Terrain), 0);
	EXPECT_FALSE(IsTriedAgain(2 * FBuildScratch::Step + 1));
	EXPECT_TRUE(IsTriedAgain(2 * FBuildScratch::Step + 2));
}

TEST_F(FGeometryRefusalsTest, WithoutABudgetEverythingComesBackExceptWhatIsGone)
{
	FRTGeometryRef A = Add("A", 1000);
	const FRTGeometryRef B = Add("B", 1000);
	Refusals->Refuse(Entry(A), 0);
	A.reset();
	EXPECT_FALSE(Refusals->IsAnyWorthAnotherTry());
	Refusals->Refuse(Entry(B), 0);
	EXPECT_TRUE(Refusals->IsAnyWorthAnotherTry());
	Refusals->Reconsider();
	EXPECT_EQ(Refusals->GetCount(), 0u);
	EXPECT_EQ(Context->Queue.GetCount(), 1u);
}

TEST_F(FGeometryRefusalsTest, EachGeometryIsNamedInTheLogOnce)
{
	FLogCapture Log;
	const FRTGeometryRef Rock = Add("Rock\nthat is refused", 1000), Stone = Add("Stone that is refused", 1000);
	Refusals->Refuse(Entry(Rock), 0);
	Set("r.RT.Build.MemoryMB", "5"); // the line would be another
	Refusals->Refuse(Entry(Rock), 0);
	Refusals->Refuse(Entry(Stone), 0);
	ASSERT_EQ(Log.Count(ERTLogLevel::Warning), 2u);
	EXPECT_EQ(Log.GetTexts()[0].find('\n'), std::string::npos);
	EXPECT_NE(Log.GetTexts()[0].find("that is refused\" (1000 triangles) is left out"), std::string::npos);
	EXPECT_NE(Log.GetTexts()[1].find("geometry \"Stone that is refused\" (1000 triangles) is left out"), std::string::npos);
	EXPECT_NE(Log.GetTexts()[1].find("r.RT.Build.MemoryMB 5,"), std::string::npos);
}

} // namespace
} // namespace Lantern
