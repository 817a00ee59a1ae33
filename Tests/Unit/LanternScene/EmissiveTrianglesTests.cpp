// FEmissiveTriangles: which triangles are listed, in what clusters, and which of them the GPU has to find anew.
#include <gmock/gmock.h>

#include "LanternCore/Config/ConsoleVariables.h"
#include "ScenePartsTestTools.h"
#include "Support/CoreTestTools.h"

namespace Lantern
{
namespace
{

class FEmissiveTrianglesTest : public FScenePartsTest
{
protected:
	FRTGeometryRef CreatePanel(uint32_t SectionCount = 1) { return Create(SectionCount, {.bCpuData = true, .TrianglesPerSection = 2}); }
	static glm::dmat4 MoveTo(glm::dvec3 Position)
	{
		glm::dmat4 Transform(1.0);
		Transform[3] = glm::dvec4(Position, 1.0);
		return Transform;
	}
};

TEST_F(FEmissiveTrianglesTest, SectionsThatEmitAreListed)
{
	const uint32_t Dark = Materials.Add(MakeMaterial()), Bright = Materials.Add(MakeMaterial(0, 3.0f));
	Place(CreatePanel(), {Dark});
	const FRTObjectId Id = Place(CreatePanel(3), {Bright, Dark, Bright}, {5, 0, 0});
	UpdateEmissive();
	EXPECT_EQ(Emissive.GetTriangleCount(), 4u);
	ASSERT_EQ(Emissive.GetRanges().Num(), 3u);
	for (uint32_t I = 0; I < 2; ++I)
	{
		EXPECT_EQ(Emissive.GetRanges()[I].First, 2 * I);
		EXPECT_EQ(Emissive.GetRanges()[I].Section, Objects.GetFirstSection(Id) + 2 * I);
	}
	EXPECT_EQ(Emissive.GetRanges()[2].First, 4u) << "the end of the list";
	EXPECT_EQ(DoneCount, Emissive.GetClusters().Num());
	EXPECT_TRUE(Done.empty()) << "all";
}

// A panel's two triangles lie in one plane; the next one is parallel. No vertex of a deforming mesh is known.
TEST_F(FEmissiveTrianglesTest, FlatPartsAreOneCluster)
{
	const uint32_t Bright = Materials.Add(MakeMaterial(0, 1.0f));
	const FRTObjectId Rigid = Place(CreatePanel(), {Bright});
	const FRTObjectId Bent = Place(Create(1, {.bDynamic = true, .TrianglesPerSection = 2}), {Bright});
	UpdateEmissive();
	ASSERT_EQ(Emissive.GetClusters().Num(), 3u);
	const uint32_t Counts[] = {2, 1, 1}, Ranges[] = {0, 1, 1};
	for (uint32_t I = 0; I < 3; ++I)
	{
		EXPECT_EQ(Emissive.GetClusters()[I].Count, Counts[I]);
		EXPECT_EQ(Emissive.GetClusters()[I].Range, Ranges[I]);
		EXPECT_EQ(Emissive.GetClusters()[I].Object, I == 0 ? Rigid.Index : Bent.Index);
	}
}

TEST_F(FEmissiveTrianglesTest, AMovedObjectCostsItsOwnClusters)
{
	const uint32_t Bright = Materials.Add(MakeMaterial(0, 1.0f));
	const FRTGeometryRef Panel = CreatePanel();
	std::vector<FRTObjectId> Ids;
	for (int I = 0; I < 100; ++I) { Ids.push_back(Place(Panel, {Bright}, {I, 0, 0})); }
	UpdateEmissive();
	EXPECT_EQ(DoneCount, 100u);
	Objects.SetTransform(Ids[30], MoveTo({0, 50, 0}));
	Objects.SetTransform(Ids[30], MoveTo({0, 60, 0}));
	Objects.SetTransform(Ids[7], MoveTo({0, 50, 0}));
	EXPECT_TRUE(Emissive.NeedsUpdate());
	UpdateEmissive();
	EXPECT_EQ(Done, (std::vector<uint32_t>{7, 30}));
	glm::dmat4 Larger(1.0);
	Larger[0][0] = 3.0;
	Objects.SetTransform(Ids[30], Larger);
	UpdateEmissive();
	EXPECT_EQ(Done, (std::vector<uint32_t>{30})) << "shares of the power are the GPU's";
}

// A host may move everything for an hour while nobody samples lights.
TEST_F(FEmissiveTrianglesTest, MarksThatNobodyTakesAreBounded)
{
	const FRTObjectId Id = Place(CreatePanel(), {Materials.Add(MakeMaterial(0, 1.0f))});
	UpdateEmissive();
	for (int I = 0; I < 10'000; ++I) { Objects.SetTransform(Id, MoveTo({I, 0, 0})); }
	UpdateEmissive();
	EXPECT_EQ(DoneCount, 1u);
}

TEST_F(FEmissiveTrianglesTest, DeformedMeshesAreDoneAgain)
{
	const uint32_t Bright = Materials.Add(MakeMaterial(0, 1.0f)), Dark = Materials.Add(MakeMaterial());
	const FRTGeometryRef Bent = Create(1, {.bDynamic = true, .TrianglesPerSection = 4});
	Place(CreatePanel(), {Bright});
	Place(Bent, {Dark});
	Place(Bent, {Bright});
	Place(Bent, {Bright});
	UpdateEmissive();
	EXPECT_EQ(Emissive.GetTriangleCount(), 10u);
	Objects.MarkDeformed(Bent);
	UpdateEmissive();
	EXPECT_EQ(Done, (std::vector<uint32_t>{1, 2, 3, 4, 5, 6, 7, 8}));
}

TEST_F(FEmissiveTrianglesTest, AMaterialThatFlickersListsNothingAnew)
{
	const uint32_t Steady = Materials.Add(MakeMaterial(0, 1.0f)), Flame = Materials.Add(MakeMaterial(0, 1.0f));
	for (int I = 0; I < 9; ++I) { Place(CreatePanel(), {I % 3 == 0 ? Flame : Steady}, {I, 0, 0}); }
	UpdateEmissive();
	Materials.Set(Flame, MakeMaterial(0, 2.0f));
	UpdateEmissive();
	EXPECT_EQ(Done, (std::vector<uint32_t>{0, 3, 6}));
	FMaterialData Green = MakeMaterial(0, 2.0f);
	Green.BaseColor = glm::vec4(0, 1, 0, 1);
	Materials.Set(Flame, Green);
	EXPECT_FALSE(Emissive.NeedsUpdate()) << "that is no emission";
	for (const float Blink : {0.0f, 3.0f})
	{
		Materials.Set(Flame, MakeMaterial(0, Blink));
		UpdateEmissive();
		EXPECT_EQ(Emissive.GetTriangleCount(), 18u) << "what is dark for now stays listed";
		EXPECT_EQ(Done, (std::vector<uint32_t>{0, 3, 6}));
	}
}

// A material may begin to shine while objects have it, and they may get it while it is dark.
TEST_F(FEmissiveTrianglesTest, MaterialsMayBeginToShineAtAnyTime)
{
	const uint32_t Sign = Materials.Add(MakeMaterial());
	Place(CreatePanel(), {Sign});
	Materials.Set(Sign, MakeMaterial(0, 1.0f));
	UpdateEmissive();
	EXPECT_EQ(Emissive.GetTriangleCount(), 2u);
	Materials.Set(Sign, MakeMaterial());
	const FRTObjectId Late = Place(CreatePanel(), {Sign});
	Materials.Set(Sign, MakeMaterial(0, 1.0f));
	UpdateEmissive();
	EXPECT_EQ(Emissive.GetTriangleCount(), 4u);
	const uint32_t Dark = Materials.Add(MakeMaterial());
	Objects.SetMaterials(Late, {Dark});
	UpdateEmissive();
	EXPECT_EQ(Emissive.GetTriangleCount(), 2u);
	Materials.Set(Dark, MakeMaterial(0, 1.0f));
	UpdateEmissive();
	EXPECT_EQ(Emissive.GetTriangleCount(), 4u);
}

// An index is used again by another material, which never shone.
TEST_F(FEmissiveTrianglesTest, WhatHasTheIndexOfAnEmitterIsNone)
{
	const uint32_t Gone = Materials.Add(MakeMaterial(0, 1.0f));
	Materials.Remove(Gone);
	const uint32_t Dark = Materials.Add(MakeMaterial());
	ASSERT_EQ(Dark, Gone);
	Place(CreatePanel(), {Dark});
	UpdateEmissive();
	EXPECT_EQ(Emissive.GetTriangleCount(), 0u);
}

// Engines set all transforms in each frame.
TEST_F(FEmissiveTrianglesTest, WhatIsSetToItsPlaceHasNotMoved)
{
	const FRTObjectId Id = Place(CreatePanel(), {Materials.Add(MakeMaterial(0, 1.0f))}, {1, 2, 3});
	UpdateEmissive();
	Objects.SetTransform(Id, MoveTo({1, 2, 3}));
	EXPECT_FALSE(Emissive.NeedsUpdate());
}

// Lists that are not up to date may name sections and vertices that are gone: shaders see none.
TEST_F(FEmissiveTrianglesTest, ListsThatAreStaleAreNotPublished)
{
	const uint32_t Bright = Materials.Add(MakeMaterial(0, 1.0f));
	const FRTObjectId Id = Place(CreatePanel(), {Bright});
	Place(CreatePanel(), {Bright});
	const auto CountPublished = [&] {
		FSceneConstants Constants{};
		Emissive.FillConstants(Constants);
		EXPECT_EQ(Constants.EmissiveTriangleCount > 0, Constants.EmissiveTriangles != 0);
		EXPECT_EQ(Constants.EmissiveClusterCount > 0, Constants.EmissiveTriangleCount > 0);
		return Constants.EmissiveTriangleCount;
	};
	UpdateEmissive();
	EXPECT_EQ(CountPublished(), 4u);
	Objects.SetTransform(Id, MoveTo({1, 0, 0}));
	EXPECT_EQ(CountPublished(), 4u) << "where they were is no harm";
	Objects.Remove(Id);
	EXPECT_EQ(CountPublished(), 0u);
	Emissive.EndFrame(true); // of a frame whose shaders are not ready
	EXPECT_EQ(CountPublished(), 0u);
	ASSERT_TRUE(Emissive.Update(*Device, Objects, Materials));
	EXPECT_EQ(CountPublished(), 2u) << "this frame's GPU does them";
	Emissive.EndFrame(false);
	EXPECT_EQ(CountPublished(), 0u) << "it never did";
}

// A light's number has no room for more. What is listed does not depend on the order in which objects came.
TEST_F(FEmissiveTrianglesTest, WhatHasNoRoomIsLeftOutAndNamed)
{
	FLogCapture Log;
	ASSERT_FALSE(FConsoleVariables::Get().Set("r.RT.Lights.EmissiveTriangles", "7", ERTSetBy::Console, "test"));
	FConsoleVariables::Get().BeginFrame();
	const uint32_t Bright = Materials.Add(MakeMaterial(0, 1.0f)), Other = Materials.Add(MakeMaterial(0, 1.0f));
	for (const uint32_t Sections : {2u, 3u, 1u}) { Place(CreatePanel(Sections), std::vector(Sections, Sections == 3 ? Other : Bright)); }
	UpdateEmissive();
	EXPECT_EQ(Emissive.GetTriangleCount(), 6u);
	EXPECT_EQ(Emissive.GetRanges().Num(), 4u);
	EXPECT_THAT(Log.GetTexts(), ::testing::Contains(::testing::HasSubstr("more than 7 emissive triangles")));
	Materials.Set(Other, MakeMaterial(0, 2.0f));
	UpdateEmissive();
	EXPECT_EQ(DoneCount, 0u);
	FConsoleVariables::Get().ResetAll();
	FConsoleVariables::Get().BeginFrame();
}

// What the GPU did not get to do is wanted again.
TEST_F(FEmissiveTrianglesTest, LostFramesAreDoneAgain)
{
	const FRTObjectId Id = Place(CreatePanel(), {Materials.Add(MakeMaterial(0, 1.0f))});
	Place(CreatePanel(), {Materials.Add(MakeMaterial(0, 1.0f))});
	const auto Lose = [&] {
		ASSERT_TRUE(Emissive.Update(*Device, Objects, Materials));
		Emissive.EndFrame(false);
		EXPECT_TRUE(Emissive.NeedsUpdate());
		EXPECT_EQ(Emissive.GetWork().Count, 0u) << "no frame";
	};
	Lose();
	UpdateEmissive();
	EXPECT_EQ(DoneCount, 2u);
	Objects.SetTransform(Id, MoveTo({1, 0, 0}));
	Lose();
	UpdateEmissive();
	EXPECT_EQ(Done, (std::vector<uint32_t>{0}));
}

// Small objects have a cluster each, large ones several of one size; none has triangles of two objects.
TEST_F(FEmissiveTrianglesTest, ClustersAreOfOneObject)
{
	const uint32_t Bright = Materials.Add(MakeMaterial(0, 2.0f));
	const FRTGeometryRef Panel = CreatePanel(), Large = Create(2, {.bCpuData = true, .TrianglesPerSection = 1500});
	for (int I = 0; I < 3; ++I) { Place(Panel, {Bright}, {I, 0, 0}); }
	Place(Large, {Bright, Bright}, {0, 9, 0});
	Place(Panel, {Bright}, {0, 0, 9});
	UpdateEmissive();
	const auto& Clusters = Emissive.GetClusters();
	const auto& Ranges = Emissive.GetRanges();
	ASSERT_EQ(Emissive.GetTriangleCount(), 3008u);
	EXPECT_LE(Clusters.Num(), EMISSIVE_CLUSTERS + 5);
	uint32_t Next = 0;
	for (uint32_t Cluster = 0; Cluster < Clusters.Num(); ++Cluster)
	{
		const FEmissiveCluster& Of = Clusters[Cluster];
		ASSERT_EQ(Of.First, Next);
		ASSERT_GT(Of.Count, 0u);
		EXPECT_LE(Of.Count, 6u);
		EXPECT_LE(Ranges[Of.Range].First, Of.First);
		EXPECT_GT(Ranges[Of.Range + 1].First, Of.First);
		Next += Of.Count;
	}
	EXPECT_EQ(Next, 3008u);
}

TEST_F(FEmissiveTrianglesTest, WhatDoesNotEmitMarksNothing)
{
	const FRTObjectId Id = Place(CreatePanel(), {Materials.Add(MakeMaterial())});
	const FRTGeometryRef Bent = Create(1, {.bDynamic = true});
	Place(Bent, {Materials.Add(MakeMaterial())});
	UpdateEmissive();
	Objects.SetTransform(Id, MoveTo({1, 2, 3}));
	Objects.MarkDeformed(Bent);
	Objects.Remove(Id);
	EXPECT_FALSE(Emissive.NeedsUpdate());
	EXPECT_EQ(Emissive.GetWork().Count, 0u);
}

TEST_F(FEmissiveTrianglesTest, ObjectsThatCeaseToEmitLeaveTheList)
{
	const uint32_t Dark = Materials.Add(MakeMaterial()), Bright = Materials.Add(MakeMaterial(0, 1.0f));
	const FRTObjectId Changed = Place(CreatePanel(), {Bright});
	const FRTObjectId Removed = Place(CreatePanel(), {Bright});
	UpdateEmissive();
	ASSERT_EQ(Emissive.GetTriangleCount(), 4u);
	Objects.SetMaterials(Changed, {Dark});
	EXPECT_TRUE(Emissive.NeedsUpdate());
	UpdateEmissive();
	ASSERT_EQ(Emissive.GetTriangleCount(), 2u);
	EXPECT_EQ(Emissive.GetClusters()[0].Object, Removed.Index);
	Objects.Remove(Removed);
	EXPECT_TRUE(Emissive.NeedsUpdate());
	UpdateEmissive();
	EXPECT_EQ(Emissive.GetTriangleCount(), 0u);
	EXPECT_EQ(Emissive.GetClusters().Num(), 0u);
}

} // namespace
} // namespace Lantern
