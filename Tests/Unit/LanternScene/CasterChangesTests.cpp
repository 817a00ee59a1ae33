// FCasterChanges, and what of a scene it is told.
#include "LanternScene/Scene/CasterChanges.h"

#include <limits>

#include "Support/SceneTestTools.h"

namespace Lantern
{
namespace
{

TEST(FCasterChangesTest, KeepsTheLastOnes)
{
	FCasterChanges Changes;
	std::vector<FCasterChange> Found(3);
	EXPECT_TRUE(Changes.Find(0, Found));
	EXPECT_TRUE(Found.empty());
	for (uint32_t I = 0; I < FCasterChanges::MostKept; ++I) { Changes.Add({{I, 0, 0}, {I, 1, 0}, 2.0}); }
	ASSERT_TRUE(Changes.Find(0, Found));
	ASSERT_EQ(Found.size(), FCasterChanges::MostKept);
	EXPECT_EQ(Found[7].From.x, 7.0);
	EXPECT_EQ(Found[7].To.y, 1.0);
	Changes.Add({{1000, 0, 0}, {1000, 1, 0}, 2.0});
	EXPECT_FALSE(Changes.Find(0, Found)) << "the first is forgotten";
	ASSERT_TRUE(Changes.Find(FCasterChanges::MostKept, Found));
	ASSERT_EQ(Found.size(), 1u);
	EXPECT_EQ(Found[0].From.x, 1000.0);
}

TEST(FCasterChangesTest, AnywhereHoldsForThoseBeforeIt)
{
	FCasterChanges Changes;
	std::vector<FCasterChange> Found;
	Changes.AddAnywhere();
	EXPECT_FALSE(Changes.Find(0, Found));
	EXPECT_TRUE(Changes.Find(1, Found));
	const double NaN = std::numeric_limits<double>::quiet_NaN();
	Changes.Add({{0, NaN, 0}, {0, 0, 0}, 1.0});
	EXPECT_FALSE(Changes.Find(1, Found)) << "a place that is no number may be any";
	Changes.Add({{0, 0, 0}, {0, 0, 0}, std::numeric_limits<double>::infinity()});
	EXPECT_FALSE(Changes.Find(2, Found));
	EXPECT_TRUE(Changes.Find(3, Found));
}

class FCasterChangesSceneTest : public FSceneTest
{
protected:
	void SetUp() override
	{
		FSceneTest::SetUp();
		Material = Scene->AddMaterial(MakeMaterial());
		FGeometryOptions Options;
		Options.bCpuData = true;
		Rock = MakeGeometry("rock", 1, Options);
		Object = Add(Rock, {Material});
		Settle();
		Since = Scene->GetCasterChanges().GetCount();
	}
	static constexpr int Anywhere = -1;
	/// Number of changes since the last call, or Anywhere. Their places are in Found.
	int Count()
	{
		Frame();
		const bool bPlaced = Scene->GetCasterChanges().Find(Since, Found);
		Since = Scene->GetCasterChanges().GetCount();
		return bPlaced ? static_cast<int>(Found.size()) : Anywhere;
	}

	uint32_t Material = 0;
	FRTGeometryRef Rock;
	FRTObjectId Object;
	uint64_t Since = 0;
	std::vector<FCasterChange> Found;
};

TEST_F(FCasterChangesSceneTest, ChannelsChangeLightAnywhere)
{
	Scene->SetChannels(Object, CHANNELS_DEFAULT);
	EXPECT_EQ(Count(), 0) << "as they were";
	EXPECT_EQ(Scene->GetConstants().ObjectChannels, 0u) << "nothing needs the table";
	Scene->SetChannels(Object, 6);
	EXPECT_EQ(Count(), Anywhere);
	EXPECT_EQ(Read<uint32_t>(Scene->GetConstants().ObjectChannels, Object.Index), 6u ^ CHANNELS_DEFAULT);
	// Objects that come later are in the table as well, and one whose slot is used again has its own.
	const FRTObjectId Later = Add(Rock, {Material});
	Frame();
	EXPECT_EQ(Read<uint32_t>(Scene->GetConstants().ObjectChannels, Later.Index), 0u);
	Scene->RemoveObject(Object);
	const FRTObjectId Again = Add(Rock, {Material});
	Frame();
	EXPECT_EQ(Again.Index, Object.Index);
	EXPECT_EQ(Read<uint32_t>(Scene->GetConstants().ObjectChannels, Again.Index), 0u);
	EXPECT_FALSE(Scene->GetFacts().bLightChannels) << "there is no light";
}

TEST_F(FCasterChangesSceneTest, StylesThatTurnNormalsAreChanges)
{
	FToonStyle Style;
	const auto Set = [&] { Scene->SetToon(Object, std::make_shared<const FToonStyle>(Style)); };
	Set();
	EXPECT_EQ(Count(), 1);
	Style.Center.y = 1.0f;
	Style.MaxValue = 0.1f;
	Set();
	EXPECT_EQ(Count(), 0) << "a head that moves, and limits, which act behind filters";
	Style.Bend = 0.5f;
	Set();
	EXPECT_EQ(Count(), 1);
	Style.SphereWeight = 1.0f;
	Set();
	EXPECT_EQ(Count(), 1);
	Scene->SetToon(Object, nullptr);
	EXPECT_EQ(Count(), 1);
}

TEST_F(FCasterChangesSceneTest, TellsWhereAnObjectWasAndIs)
{
	EXPECT_EQ(Count(), 0) << "nothing moved";
	glm::dmat4 Transform(1.0);
	Scene->SetTransform(Object, Transform);
	EXPECT_EQ(Count(), 0) << "set to where it is";
	Transform[3] = {10, 0, 0, 1};
	Scene->SetTransform(Object, Transform);
	ASSERT_EQ(Count(), 1);
	EXPECT_NEAR(Found[0].To.x - Found[0].From.x, 10.0, 1e-9);
	EXPECT_GE(Found[0].Radius, 0.7) << "the triangle's corners are 1.4 m apart";
	EXPECT_EQ(Found[0].Object, Object.Index);
	EXPECT_EQ(Found[0].Changed, 1.0) << "it lies where nothing of it was";
	EXPECT_EQ(Found[0].Emission, 0.0);
	Transform[3].x += Found[0].Radius;
	Scene->SetTransform(Object, Transform);
	ASSERT_EQ(Count(), 1);
	EXPECT_NEAR(Found[0].Changed, 0.5, 1e-6) << "by half of its width";
	Transform = glm::dmat4(2.0);
	Transform[3] = {10, 0, 0, 1};
	Scene->SetTransform(Object, Transform);
	ASSERT_EQ(Count(), 1);
	EXPECT_GE(Found[0].Radius, 1.4) << "it grew";
	Transform = Transform * glm::dmat4(glm::dmat3(glm::dvec3(0, 1, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 0, 1)));
	Scene->SetTransform(Object, Transform);
	ASSERT_EQ(Count(), 1);
	EXPECT_GT(Found[0].Changed, 0.0);
	EXPECT_LT(Found[0].Changed, 1.0) << "it turned in its place";
}

TEST_F(FCasterChangesSceneTest, TellsWhatComesAndGoes)
{
	const FRTObjectId Other = Add(Rock, {Material}, {5, 0, 0});
	ASSERT_EQ(Count(), 1);
	EXPECT_NEAR(Found[0].From.x, 5.0, 1.0);
	Scene->SetMask(Other, MaskVisible);
	EXPECT_EQ(Count(), 1) << "casts no longer";
	Scene->SetMask(Other, MaskVisible);
	Scene->RemoveObject(Other);
	EXPECT_EQ(Count(), 0) << "cast nothing any more";
	Scene->RemoveObject(Object);
	EXPECT_EQ(Count(), 1);
	FGeometryOptions Options;
	Options.bCpuData = true;
	Add(MakeGeometry("stone", 1, Options), {Material});
	EXPECT_EQ(Count(), 1);
	EXPECT_EQ(Count(), 0) << "its geometry was there at once";
	FRTObjectInfo Unbounded;
	Unbounded.Geometry = MakeGeometry("unbounded", 1);
	Unbounded.Materials = {Material};
	Scene->AddObject(Unbounded);
	EXPECT_EQ(Count(), Anywhere);
}

TEST_F(FCasterChangesSceneTest, TellsWhatShinesAndWhatDidSo)
{
	FMaterialData Glow = MakeMaterial();
	Glow.Emissive = glm::vec3(2.0f);
	Glow.EmissiveWeight = 2.0f;
	const uint32_t Glowing = Scene->AddMaterial(Glow);
	const FRTObjectId Other = Add(Rock, {Glowing}); // both materials stay bound: else anything may have changed
	Settle();
	Count();
	Scene->SetMaterials(Object, {Glowing});
	ASSERT_EQ(Count(), 1);
	EXPECT_EQ(Found[0].Emission, 128.0);
	EXPECT_EQ(Found[0].Changed, 1.0);
	Scene->SetMaterials(Other, {Material});
	ASSERT_EQ(Count(), 2) << "as it was, and as it is";
	EXPECT_EQ(Found[0].Emission, 128.0);
	EXPECT_EQ(Found[1].Emission, 0.0);
	EXPECT_EQ(Found[1].Object, Other.Index);
}

TEST_F(FCasterChangesSceneTest, TellsShapes)
{
	FMaterialData Other = MakeMaterial();
	Other.Roughness = 0.3f;
	Other.EmissiveWeight = 2.0f;
	Scene->SetMaterial(Material, Other);
	EXPECT_EQ(Count(), 0) << "a lamp that flickers casts what it did";
	Other.Flags = MATERIAL_MASKED;
	Scene->SetMaterial(Material, Other);
	EXPECT_EQ(Count(), Anywhere);
	Other.AlphaCutoff = 0.7f;
	Scene->SetMaterial(Material, Other);
	EXPECT_EQ(Count(), Anywhere);
	Scene->SetAlphaTest(true);
	EXPECT_EQ(Count(), 0) << "as before";
	Scene->SetAlphaTest(false);
	EXPECT_EQ(Count(), Anywhere);
	Scene->SetMaterials(Object, {Scene->AddMaterial(MakeMaterial())});
	Count();
	FGeometryOptions Options;
	Options.bDynamic = true;
	FRTGeometryInfo Info = MakeInfo("cloth", 1, Options);
	Info.BoundsRadius = 3.0f;
	FRTGeometryRef Cloth;
	ASSERT_TRUE(Scene->CreateGeometry(std::move(Info), Cloth));
	Add(Cloth, {Material}, {7, 0, 0});
	Add(Cloth, {Material}, {9, 0, 0});
	Settle();
	Count();
	Scene->MarkDeformed(Cloth);
	ASSERT_EQ(Count(), 2) << "each of its objects";
	EXPECT_EQ(Found[0].Radius, 3.0);
	Scene->SetBounds(Cloth, {glm::vec3(0), 4.0f});
	ASSERT_EQ(Count(), 2);
	EXPECT_EQ(Found[0].Radius, 4.0);
}

} // namespace
} // namespace Lantern
