// FSceneObjects: the handle table, and what an object leaves in the tables that follow from it.
#include <set>

#include "ScenePartsTestTools.h"

namespace Lantern
{
namespace
{

class FSceneObjectsTest : public FScenePartsTest
{
protected:
	void SetUp() override
	{
		FScenePartsTest::SetUp();
		Material = Materials.Add(MakeMaterial());
		Tree = Create(1);
	}
	FRTObjectId PlaceTree(glm::dvec3 Position = {}) { return Place(Tree, {Material}, Position); }
	uint32_t Material = 0;
	FRTGeometryRef Tree;
};

TEST_F(FSceneObjectsTest, LowestFreeSlotIsUsedFirst)
{
	const FRTObjectId First = PlaceTree(), Second = PlaceTree();
	PlaceTree();
	Objects.Remove(Second);
	Objects.Remove(First);
	EXPECT_EQ(Objects.Find(First.Index), nullptr);
	EXPECT_EQ(Objects.GetSlotCount(), 3u);
	const FRTObjectId Again = PlaceTree({4, 5, 6});
	EXPECT_EQ(Again.Index, First.Index);
	EXPECT_NE(Again.Generation, First.Generation);
	ASSERT_NE(Objects.Find(Again.Index), nullptr);
	EXPECT_EQ(Objects.Get(Again).Transform[3].y, 5.0);
}

TEST_F(FSceneObjectsTest, FreeSlotsAtTheEndAreGivenBackAndIdsStayUnique)
{
	std::set<std::pair<uint32_t, uint32_t>> Seen;
	for (int Round = 0; Round < 4; ++Round)
	{
		std::vector<FRTObjectId> Ids;
		for (int I = 0; I < 5; ++I)
		{
			Ids.push_back(PlaceTree());
			EXPECT_TRUE(Seen.insert({Ids.back().Index, Ids.back().Generation}).second) << "an id was given twice";
		}
		EXPECT_EQ(Objects.GetSlotCount(), 5u);
		Objects.Remove(Ids[4]);
		EXPECT_EQ(Objects.GetSlotCount(), 4u);
		for (int I = 0; I < 4; ++I) { Objects.Remove(Ids[I]); }
		EXPECT_EQ(Objects.GetSlotCount(), 0u);
		EXPECT_EQ(Objects.GetTable().Num(), 0u);
		EXPECT_EQ(Objects.GetInstances().GetCount(), 0u);
	}
}

TEST_F(FSceneObjectsTest, ObjectIsWrittenToTableAndStore)
{
	FRTGeometryInfo Info = MakeInfo("Ball", 1);
	Info.BoundsCenter = {1, 0, 0};
	Info.BoundsRadius = 2.0f;
	FRTGeometryRef Ball;
	ASSERT_TRUE(Geometries->Create(std::move(Info), Ball));
	PlaceTree();
	const FRTObjectId Id = Place(Ball, {Material});
	glm::dmat4 Transform(3.0);
	Transform[2][2] = -3.0;
	Transform[3] = {CellSize + 10.0, 0, 0, 1};
	Objects.SetTransform(Id, Transform);
	const FObjectData& Data = Objects.GetTable()[Id.Index];
	EXPECT_EQ(Data.FirstSection, Objects.GetFirstSection(Id));
	EXPECT_EQ(Data.Cell, glm::ivec3(1, 0, 0));
	EXPECT_EQ(Data.ObjectToWorld[0], glm::vec4(3, 0, 0, 10));
	EXPECT_EQ(Data.ObjectToWorld[2], glm::vec4(0, 0, -3, 0));
	EXPECT_EQ(Data.Flags, OBJECT_MIRRORED) << "and rounding took nothing";
	const FInstanceRecord& Record = Objects.GetInstances().GetRecord(Id.Index);
	EXPECT_EQ(Record.Center, glm::dvec3(CellSize + 13.0, 0, 0));
	EXPECT_EQ(Record.Radius, 6.0);
	EXPECT_EQ(Record.Range, Objects.GetRange(Id.Index));
}

TEST_F(FSceneObjectsTest, OtherMaterialsAreAnotherRange)
{
	const FSectionTable& Sections = Materials.GetSections();
	const FRTObjectId Id = PlaceTree(), Other = PlaceTree();
	EXPECT_EQ(Objects.GetRange(Id.Index), Objects.GetRange(Other.Index));
	const uint32_t Red = Materials.Add(MakeMaterial());
	Objects.SetMaterials(Id, {Red});
	EXPECT_NE(Objects.GetRange(Id.Index), Objects.GetRange(Other.Index));
	EXPECT_EQ(Sections.Get(Objects.GetFirstSection(Id)).Material, Red);
	EXPECT_EQ(Objects.GetTable()[Id.Index].FirstSection, Objects.GetFirstSection(Id));
	EXPECT_EQ(Sections.GetRangeCount(), 2u);
	Objects.SetMaterials(Other, {Red});
	EXPECT_EQ(Sections.GetRangeCount(), 1u) << "nobody uses the first range any more";
}

TEST_F(FSceneObjectsTest, GeometryOfARemovedObjectLivesForTwoSubmittedFrames)
{
	FRTGeometryRef Rock = Create(1);
	const std::weak_ptr<FRTGeometry> Life = Rock;
	const FRTObjectId Id = Place(std::move(Rock), {Material});
	Objects.EndFrame(true);
	Objects.EndFrame(true);
	EXPECT_FALSE(Life.expired()) << "the object has it";
	Objects.Remove(Id);
	Objects.EndFrame(false);
	Objects.EndFrame(true);
	EXPECT_FALSE(Life.expired()) << "the frame before may still read it";
	Objects.EndFrame(true);
	EXPECT_TRUE(Life.expired());
}

} // namespace
} // namespace Lantern
