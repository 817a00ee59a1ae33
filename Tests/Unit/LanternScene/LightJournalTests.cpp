// FLightJournal, and what a store of lights writes into it.
#include <gtest/gtest.h>

#include "LanternScene/Lights/LightStore.h"

namespace Lantern
{
namespace
{

FSceneLight MakeLampAt(double X, float Range)
{
	FSceneLight Light;
	Light.Position = {X, 0, 0};
	Light.Range = Range;
	return Light;
}

std::vector<FLightReach> GetSince(const FLightJournal& Journal, uint64_t First)
{
	std::vector<FLightReach> Out;
	EXPECT_TRUE(Journal.GetSince(First, Out));
	return Out;
}

TEST(FLightJournalTest, ConsumersReadFromTheirOwnPlaces)
{
	FLightJournal Journal;
	for (int I = 0; I < 3; ++I) { Journal.Add({{I, 0, 0}, 1.0f}); }
	EXPECT_EQ(Journal.GetCount(), 3u);
	EXPECT_EQ(GetSince(Journal, 0).size(), 3u);
	ASSERT_EQ(GetSince(Journal, 2).size(), 1u);
	EXPECT_EQ(GetSince(Journal, 2)[0].Position.x, 2);
	EXPECT_TRUE(GetSince(Journal, 3).empty());
}

TEST(FLightJournalTest, OldChangesAreForgottenAndItSaysSo)
{
	FLightJournal Journal;
	for (uint32_t I = 0; I < FLightJournal::MostChanges + 10; ++I) { Journal.Add({{int(I), 0, 0}, 1.0f}); }
	std::vector<FLightReach> Out = {{}};
	EXPECT_FALSE(Journal.GetSince(9, Out));
	EXPECT_EQ(Out.size(), 1u) << "as it was";
	ASSERT_TRUE(Journal.GetSince(10, Out));
	ASSERT_EQ(Out.size(), FLightJournal::MostChanges + 1u);
	EXPECT_EQ(Out[1].Position.x, 10);
	EXPECT_EQ(Out.back().Position.x, int(FLightJournal::MostChanges + 9));
}

TEST(FLightJournalTest, StoresWriteWhereLightsWereAndAre)
{
	FLightStore Store;
	const FLightJournal& Journal = Store.GetJournal();
	const FLightId Id = Store.Add(MakeLampAt(1, 5)), Far = Store.Add(MakeLampAt(0, 0));
	EXPECT_EQ(Store.GetFiniteCount(), 1u);
	EXPECT_EQ(Journal.GetCount(), 2u);
	EXPECT_EQ(GetSince(Journal, 1)[0].Radius, 0.0f) << "everywhere";
	Store.Set(Id, MakeLampAt(2, 6));
	std::vector<FLightReach> Moved = GetSince(Journal, 2);
	ASSERT_EQ(Moved.size(), 2u);
	EXPECT_EQ(Moved[0].Position.x, 1 * int(LIGHT_POSITION_STEPS));
	EXPECT_EQ(Moved[0].Radius, 5.0f);
	EXPECT_EQ(Moved[1].Position.x, 2 * int(LIGHT_POSITION_STEPS));
	EXPECT_EQ(Moved[1].Radius, 6.0f);
	FSceneLight Red = MakeLampAt(2, 6);
	Red.Color = {1, 0, 0};
	Red.bCastsShadow = false;
	Store.Set(Id, Red);
	EXPECT_EQ(Journal.GetCount(), 4u) << "it reaches what it did";
	Red.OuterCone = 1.0f;
	Store.Set(Id, Red);
	EXPECT_EQ(Journal.GetCount(), 6u);
	Store.Set(Far, MakeLampAt(9, 1));
	EXPECT_EQ(Journal.GetCount(), 8u);
	EXPECT_EQ(Store.GetFiniteCount(), 2u);
	Store.Remove(Id);
	EXPECT_EQ(GetSince(Journal, 8)[0].Radius, 6.0f);
	EXPECT_EQ(Store.GetFiniteCount(), 1u);
}

// Positions wrap around as those of FLightData do.
TEST(FLightJournalTest, ReachesAreThoseOfLightsOnTheGpu)
{
	for (const double X : {0.0, -3.25, 250'000.0, 300'000.0, -1e9})
	{
		FSceneLight Light = MakeLampAt(X, 2);
		EXPECT_EQ(GetReach(Light).Position, PackLight(Light).Position) << X;
	}
}

TEST(FLightChangesTest, StoresWriteWhatCameAndWent)
{
	FLightStore Store;
	auto Take = [&, Seen = uint64_t(0)]() mutable {
		std::vector<FLightChange> Out;
		EXPECT_TRUE(Store.GetStrengthChanges().GetSince(Seen, Out));
		Seen = Store.GetStrengthChanges().GetCount();
		return Out;
	};
	FSceneLight Lamp = MakeLampAt(0, 5);
	Lamp.Color = glm::vec3(8.0f);
	const FLightId Id = Store.Add(Lamp);
	std::vector<FLightChange> Changes = Take();
	ASSERT_EQ(Changes.size(), 1u);
	EXPECT_NEAR(Changes[0].Strength, 8.0, 1e-6);
	EXPECT_EQ(Changes[0].Part, 1.0);
	EXPECT_EQ(Changes[0].Range, 5.0);
	Store.Set(Id, Lamp);
	EXPECT_TRUE(Take().empty()) << "as it was";
	Lamp.Color = glm::vec3(6.0f);
	Store.Set(Id, Lamp);
	Changes = Take();
	ASSERT_EQ(Changes.size(), 1u);
	EXPECT_NEAR(Changes[0].Strength, 2.0, 1e-6);
	EXPECT_NEAR(Changes[0].Part, 0.25, 1e-6);
	EXPECT_EQ(Changes[0].Moved, 0.0);
	Lamp.Position.x = 0.5;
	Store.Set(Id, Lamp);
	Changes = Take();
	ASSERT_EQ(Changes.size(), 1u);
	EXPECT_EQ(Changes[0].Strength, 0.0);
	EXPECT_NEAR(Changes[0].Moved, 3.0, 1e-6) << "half a metre of 6 cd";
	Lamp.Direction = {1, 0, 0};
	Store.Set(Id, Lamp);
	EXPECT_TRUE(Take().empty()) << "it shines everywhere";
	Lamp.OuterCone = 1.0f;
	Store.Set(Id, Lamp);
	Changes = Take();
	ASSERT_EQ(Changes.size(), 1u);
	EXPECT_NEAR(Changes[0].Strength, 6.0, 1e-6) << "it may shine elsewhere";
	Lamp.Direction = {1, 0.1f, 0};
	Store.Set(Id, Lamp);
	Changes = Take();
	ASSERT_EQ(Changes.size(), 1u);
	EXPECT_NEAR(Changes[0].Strength, 0.6, 0.01) << "a tenth of its cone";
	Lamp.Range = 2.0f;
	Store.Set(Id, Lamp);
	Changes = Take();
	ASSERT_EQ(Changes.size(), 1u);
	EXPECT_EQ(Changes[0].Range, 5.0) << "where it reached";
	EXPECT_EQ(Changes[0].Part, 1.0);
	Lamp.Position.x = 9.0;
	Store.Set(Id, Lamp);
	Changes = Take();
	ASSERT_EQ(Changes.size(), 2u);
	EXPECT_EQ(Changes[0].Position.x, 0.5);
	EXPECT_EQ(Changes[1].Position.x, 9.0);
	Store.Remove(Id);
	Changes = Take();
	ASSERT_EQ(Changes.size(), 1u);
	EXPECT_EQ(Changes[0].Part, 1.0);
}

TEST(FLightChangesTest, DirectionalLightsHaveNoPlace)
{
	FLightStore Store;
	FSceneLight Moon;
	Moon.Type = LIGHT_DIRECTIONAL;
	Moon.Color = glm::vec3(2.0f);
	const FLightId Id = Store.Add(Moon);
	const uint64_t Before = Store.GetStrengthChanges().GetCount();
	Moon.Position = {100, 0, 0};
	Store.Set(Id, Moon);
	EXPECT_EQ(Store.GetStrengthChanges().GetCount(), Before) << "it follows the camera";
	Moon.Direction = {0.01f, -1, 0};
	Store.Set(Id, Moon);
	std::vector<FLightChange> Changes;
	ASSERT_TRUE(Store.GetStrengthChanges().GetSince(Before, Changes));
	ASSERT_EQ(Changes.size(), 1u);
	EXPECT_TRUE(Changes[0].bDirectional);
	EXPECT_NEAR(Changes[0].Part, 0.57, 0.01) << "of a degree";
}

TEST(FLightChangesTest, IntensityIsThatFromFarAway)
{
	FSceneLight Lamp;
	Lamp.Color = glm::vec3(2.0f);
	Lamp.Size = {3.0f, 5.0f};
	Lamp.Type = LIGHT_RECTANGLE;
	EXPECT_NEAR(GetPeakIntensity(Lamp), 30.0, 1e-5);
	Lamp.Type = LIGHT_SPHERE;
	EXPECT_NEAR(GetPeakIntensity(Lamp), 2.0 * 9.0 * 3.14159265358979, 1e-5);
	Lamp.Type = LIGHT_DIRECTIONAL;
	EXPECT_NEAR(GetPeakIntensity(Lamp), 2.0, 1e-6);
}

} // namespace
} // namespace Lantern
