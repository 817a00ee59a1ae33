// FEmissiveTriangles: which triangles are listed, where they lie and how much of the power each has.
#include "ScenePartsTestTools.h"

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
	const FRTObjectId Id = Place(CreatePanel(2), {Dark, Bright}, {5, 0, 0});
	UpdateEmissive();
	ASSERT_EQ(Emissive.GetTable().Num(), 2u);
	EXPECT_FLOAT_EQ(Emissive.GetPower(), 3.0f) << "two triangles of half a square metre";
	for (uint32_t I = 0; I < 2; ++I)
	{
		const FEmissiveTriangle& Triangle = Emissive.GetTable()[I];
		EXPECT_EQ(Triangle.Object, Id.Index);
		EXPECT_EQ(Triangle.Section, Objects.GetFirstSection(Id) + 1);
		EXPECT_EQ(Triangle.Primitive, I);
		EXPECT_EQ(Triangle.P0, glm::vec3(5 + 2 + I, 0, 0)) << "section 1 begins with the third triangle";
		EXPECT_EQ(Triangle.P1, glm::vec3(5 + 3 + I, 0, 0));
		EXPECT_EQ(Triangle.CumulativePower, I == 0 ? 0.5f : 1.0f);
	}
}

TEST_F(FEmissiveTrianglesTest, TrianglesFollowTheirObject)
{
	const FRTObjectId Id = Place(CreatePanel(), {Materials.Add(MakeMaterial(0, 1.0f))});
	UpdateEmissive();
	Objects.SetTransform(Id, MoveTo({CellSize + 7.0, 0, 0}));
	EXPECT_TRUE(Emissive.NeedsUpdate());
	UpdateEmissive();
	ASSERT_EQ(Emissive.GetTable().Num(), 2u);
	EXPECT_EQ(Emissive.GetTable()[0].P0, glm::vec3(7, 0, 0)) << "relative to the centre of the object's cell";
}

TEST_F(FEmissiveTrianglesTest, AMovedObjectCostsItsOwnTriangles)
{
	const uint32_t Bright = Materials.Add(MakeMaterial(0, 1.0f));
	const FRTGeometryRef Panel = CreatePanel();
	std::vector<FRTObjectId> Ids;
	for (int I = 0; I < 100; ++I) { Ids.push_back(Place(Panel, {Bright}, {I, 0, 0})); }
	UpdateEmissive();
	EXPECT_EQ(Emissive.GetVisited(), 200u);
	const float Share = Emissive.GetTable()[61].CumulativePower;
	glm::dmat4 Turned = MoveTo({0, 50, 0});
	Turned[0] = glm::dvec4(0.6, 0.8, 0, 0);
	Turned[1] = glm::dvec4(-0.8, 0.6, 0, 0);
	Objects.SetTransform(Ids[30], Turned);
	Objects.SetTransform(Ids[30], MoveTo({0, 60, 0}));
	Objects.SetTransform(Ids[7], Turned);
	UpdateEmissive();
	EXPECT_EQ(Emissive.GetVisited(), 4u);
	EXPECT_EQ(Emissive.GetTable()[60].P0, glm::vec3(0, 60, 0));
	EXPECT_EQ(Emissive.GetTable()[14].P0, glm::vec3(0, 50, 0));
	EXPECT_EQ(Emissive.GetTable()[61].CumulativePower, Share);
	EXPECT_FALSE(Emissive.NeedsUpdate());

	glm::dmat4 Larger = MoveTo({0, 0, 0});
	Larger[0][0] = 3.0;
	Objects.SetTransform(Ids[30], Larger);
	UpdateEmissive();
	EXPECT_GT(Emissive.GetVisited(), 199u) << "shares of the power change";
	EXPECT_FLOAT_EQ(Emissive.GetPower(), 102.0f);
}

// Small objects have a cluster each, large ones several of one size; none has triangles of two objects.
TEST_F(FEmissiveTrianglesTest, ClustersAreOfOneObject)
{
	const uint32_t Bright = Materials.Add(MakeMaterial(0, 2.0f));
	const FRTGeometryRef Panel = CreatePanel(), Large = Create(1, {.bCpuData = true, .TrianglesPerSection = 3000});
	for (int I = 0; I < 3; ++I) { Place(Panel, {Bright}, {I, 0, 0}); }
	Place(Large, {Bright}, {0, 9, 0});
	Place(Panel, {Bright}, {0, 0, 9});
	UpdateEmissive();
	const auto& Triangles = Emissive.GetTable();
	const auto& Clusters = Emissive.GetClusters();
	ASSERT_EQ(Triangles.Num(), 3008u);
	EXPECT_LE(Clusters.Num(), EMISSIVE_CLUSTERS + 5);
	uint32_t Next = 0;
	double Power = 0.0;
	for (uint32_t Cluster = 0; Cluster < Clusters.Num(); ++Cluster)
	{
		const FEmissiveCluster& Of = Clusters[Cluster];
		ASSERT_EQ(Of.First, Next);
		ASSERT_GT(Of.Count, 0u);
		EXPECT_LE(Of.Count, 6u);
		float Share = 0.0f;
		for (; Next < Of.First + Of.Count; ++Next)
		{
			EXPECT_EQ(Triangles[Next].Cluster, Cluster);
			EXPECT_EQ(Triangles[Next].Object, Triangles[Of.First].Object);
			EXPECT_NEAR(Triangles[Next].ClusterShare - Share, 1.0f / float(Of.Count), 1e-5f);
			Share = Triangles[Next].ClusterShare;
		}
		EXPECT_EQ(Share, 1.0f);
		Power += double(Of.Power);
	}
	EXPECT_EQ(Next, Triangles.Num());
	EXPECT_NEAR(Power / double(Emissive.GetPower()), 1.0, 1e-5);
}

// Beside a floodlight, fp32 shares of the whole power would lose a candle.
TEST_F(FEmissiveTrianglesTest, DimTrianglesKeepTheirShareOfTheirCluster)
{
	Place(CreatePanel(), {Materials.Add(MakeMaterial(0, 1e9f))});
	Place(CreatePanel(), {Materials.Add(MakeMaterial(0, 1e-3f))}, {5, 0, 0});
	UpdateEmissive();
	ASSERT_EQ(Emissive.GetTable().Num(), 4u);
	const FEmissiveCluster Dim = Emissive.GetClusters()[Emissive.GetTable()[2].Cluster];
	EXPECT_GT(Dim.Power, 0.0f);
	EXPECT_GT(Emissive.GetTable()[2].ClusterShare, 0.0f);
	EXPECT_EQ(Emissive.GetTable()[3].ClusterShare, 1.0f);
}

TEST_F(FEmissiveTrianglesTest, WhatDoesNotEmitMarksNothing)
{
	const FRTObjectId Id = Place(CreatePanel(), {Materials.Add(MakeMaterial())});
	UpdateEmissive();
	Objects.SetTransform(Id, MoveTo({1, 2, 3}));
	Objects.Remove(Id);
	EXPECT_FALSE(Emissive.NeedsUpdate());
}

TEST_F(FEmissiveTrianglesTest, TrianglesWithoutAreaAreLeftOut)
{
	const FRTObjectId Flat = Place(CreatePanel(), {Materials.Add(MakeMaterial(0, 1.0f))});
	glm::dmat4 Squeeze(1.0);
	Squeeze[1] = glm::dvec4(0.0);
	Objects.SetTransform(Flat, Squeeze);
	UpdateEmissive();
	EXPECT_EQ(Emissive.GetTable().Num(), 0u);
	EXPECT_EQ(Emissive.GetPower(), 0.0f);
}

TEST_F(FEmissiveTrianglesTest, ObjectsThatCeaseToEmitLeaveTheList)
{
	const uint32_t Dark = Materials.Add(MakeMaterial()), Bright = Materials.Add(MakeMaterial(0, 1.0f));
	const FRTObjectId Changed = Place(CreatePanel(), {Bright});
	const FRTObjectId Removed = Place(CreatePanel(), {Bright});
	UpdateEmissive();
	ASSERT_EQ(Emissive.GetTable().Num(), 4u);
	Objects.SetMaterials(Changed, {Dark});
	EXPECT_TRUE(Emissive.NeedsUpdate());
	UpdateEmissive();
	ASSERT_EQ(Emissive.GetTable().Num(), 2u);
	EXPECT_EQ(Emissive.GetTable()[0].Object, Removed.Index);
	Objects.Remove(Removed);
	EXPECT_TRUE(Emissive.NeedsUpdate());
	UpdateEmissive();
	EXPECT_EQ(Emissive.GetTable().Num(), 0u);
}

} // namespace
} // namespace Lantern
