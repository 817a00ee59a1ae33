// FLightStore: slots that stay, costs that follow changes; and lights as shaders see them.
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <glm/gtc/packing.hpp>
#include <gtest/gtest.h>

#include "LanternRHIMock/MockDevice.h"
#include "LanternScene/Lights/LightStore.h"

namespace Lantern
{
namespace
{

FSceneLight MakeLight(glm::dvec3 Position, uint32_t Type = LIGHT_POINT)
{
	FSceneLight Light;
	Light.Position = Position;
	Light.Type = Type;
	Light.Size = {2, 3};
	return Light;
}

uint32_t GetType(const FLightStore& Store, uint32_t Slot) { return Store.GetTable()[Slot].Flags & LIGHT_TYPE_MASK; }

TEST(FLightStoreTest, LightsKeepTheirSlots)
{
	FLightStore Store;
	const FLightId A = Store.Add(MakeLight({1, 0, 0})), B = Store.Add(MakeLight({2, 0, 0})), C = Store.Add(MakeLight({3, 0, 0}));
	Store.Remove(B);
	EXPECT_EQ(Store.GetCount(), 2u);
	EXPECT_EQ(Store.GetSlotCount(), 3u);
	EXPECT_EQ(GetType(Store, B.Index), LIGHT_NONE);
	EXPECT_EQ(Store.Find(B.Index), nullptr);
	EXPECT_EQ(Store.Get(C).Position, glm::dvec3(3, 0, 0));
	const FLightId D = Store.Add(MakeLight({4, 0, 0}));
	EXPECT_EQ(D.Index, B.Index);
	EXPECT_NE(D.Generation, B.Generation) << "what remembers B must not take D for it";
	Store.Remove(C);
	EXPECT_EQ(Store.GetSlotCount(), 2u) << "walks end with the last light";
	Store.Remove(A);
	Store.Remove(D);
	EXPECT_EQ(Store.GetSlotCount(), 0u);
	EXPECT_EQ(Store.GetTable().Num(), 0u);
	EXPECT_NE(Store.Add(MakeLight({})), A);
}

TEST(FLightStoreTest, ChangesCostWhatChanged)
{
	TRTRef<IRTDevice> Device;
	ASSERT_TRUE(CreateMockDevice({}, Device.ReleaseAndGetAddress()));
	FFrameUploads Uploads(*Device);
	FLightStore Store;
	std::vector<FLightId> Ids;
	for (int I = 0; I < 10'000; ++I) { Ids.push_back(Store.Add(MakeLight({I, 0, 0}))); }
	const auto Flush = [&] {
		TRTRef<IRTCommandList> List;
		EXPECT_TRUE(Device->CreateCommandList("Lights", List.ReleaseAndGetAddress()));
		EXPECT_TRUE(List->Begin());
		EXPECT_TRUE(Store.GetTable().Flush(*Device, *List, Uploads));
		EXPECT_TRUE(List->End());
		Uploads.EndFrame(0);
		return Store.GetTable().GetCopiedBytes();
	};
	EXPECT_GE(Flush(), 10'000 * sizeof(FLightData));
	EXPECT_FALSE(Store.GetTable().IsDirty());
	for (int I = 0; I < 100; ++I) { Store.Set(Ids[I * 97], MakeLight({I, 1, 0})); }
	EXPECT_LE(Flush(), 100 * FGpuTableBase::ChunkEntries * sizeof(FLightData));
	Store.Remove(Ids[5'000]);
	EXPECT_LE(Flush(), FGpuTableBase::ChunkEntries * sizeof(FLightData));
	EXPECT_FALSE(Store.GetTable().IsDirty());
}

TEST(FLightStoreTest, LightsWithAnExtentAreCounted)
{
	FLightStore Store;
	FSceneLight Sunlike = MakeLight({}, LIGHT_DIRECTIONAL);
	Sunlike.Size = {0, 0};
	const FLightId Id = Store.Add(Sunlike);
	(void)Store.Add(MakeLight({}));
	EXPECT_EQ(Store.GetExtendedCount(), 0u);
	Sunlike.Size.x = 0.01f;
	Store.Set(Id, Sunlike);
	const FLightId Tube = Store.Add(MakeLight({}, LIGHT_TUBE));
	EXPECT_EQ(Store.GetExtendedCount(), 2u);
	Store.Remove(Tube);
	Store.Remove(Id);
	EXPECT_EQ(Store.GetExtendedCount(), 0u);
}

TEST(FLightStoreTest, KindsOfLightsLoseTheirShadows)
{
	FSceneLight Spot = MakeLight({});
	Spot.OuterCone = 1.0f;
	FSceneLight Fill = MakeLight({});
	Fill.bCastsShadow = false;
	FSceneLight Beam = MakeLight({}, LIGHT_TUBE);
	Beam.OuterCone = 1.0f;
	FSceneLight Lens = MakeLight({}, LIGHT_DISK);
	Lens.OuterCone = 1.0f;
	const std::pair<FSceneLight, ELightKind> Lights[] = {{MakeLight({}), ELightKind::Point}, {Fill, ELightKind::Point},
	    {MakeLight({}, LIGHT_SPHERE), ELightKind::Point}, {MakeLight({}, LIGHT_TUBE), ELightKind::Point}, {Spot, ELightKind::Spot},
	    {Beam, ELightKind::Spot}, {MakeLight({}, LIGHT_RECTANGLE), ELightKind::Rect}, {Lens, ELightKind::Rect},
	    {MakeLight({}, LIGHT_DIRECTIONAL), ELightKind::Directional}};
	FLightStore Store;
	std::vector<FLightId> Ids;
	for (const auto& [Light, Kind] : Lights)
	{
		EXPECT_EQ(GetLightKind(Light), Kind);
		Ids.push_back(Store.Add(Light));
	}
	EXPECT_EQ(Store.GetShadowedCount(), 8u);
	const auto Casts = [&](size_t I) { return (Store.GetTable()[Ids[I].Index].Flags & LIGHT_CASTS_SHADOW) != 0; };
	for (const ELightKind Off : {ELightKind::Point, ELightKind::Spot, ELightKind::Rect, ELightKind::Directional})
	{
		const uint64_t Before = Store.GetChangeCount();
		Store.SetCastingKinds(~(1u << uint32_t(Off)));
		EXPECT_GT(Store.GetChangeCount(), Before) << "histories must hear of it";
		uint32_t Shadowed = 0;
		for (size_t I = 0; I < Ids.size(); ++I)
		{
			EXPECT_EQ(Casts(I), Lights[I].first.bCastsShadow && Lights[I].second != Off) << I;
			Shadowed += Casts(I) ? 1 : 0;
		}
		EXPECT_EQ(Store.GetShadowedCount(), Shadowed);
	}
	// What comes, moves or changes meanwhile, too.
	Store.SetCastingKinds(~(1u << uint32_t(ELightKind::Spot)));
	Spot.Position = {1, 2, 3};
	Store.Set(Ids[4], Spot);
	EXPECT_FALSE(Casts(4));
	FSceneLight Narrow = Spot;
	Narrow.OuterCone = 0.5f;
	Store.Set(Ids[4], Narrow);
	EXPECT_FALSE(Casts(4));
	Store.Remove(Ids[0]);
	Ids[0] = Store.Add(Spot);
	EXPECT_FALSE(Casts(0));
	EXPECT_EQ(Store.GetShadowedCount(), 5u);
	Store.SetCastingKinds(~0u);
	EXPECT_TRUE(Casts(0) && Casts(4) && !Casts(1));
	const uint64_t Before = Store.GetChangeCount();
	Store.SetCastingKinds(~0u);
	EXPECT_EQ(Store.GetChangeCount(), Before) << "nothing changed";
}

/// As shaders compute it: differences wrap around.
double GetDistanceOnGpu(double Light, double Origin)
{
	FSceneLight There = MakeLight({Light, 0, 0}), Here = MakeLight({Origin, 0, 0});
	const auto Difference = static_cast<uint32_t>(PackLight(There).Position.x) - static_cast<uint32_t>(PackLight(Here).Position.x);
	return double(static_cast<int32_t>(Difference)) / double(LIGHT_POSITION_STEPS);
}

TEST(FLightStoreTest, PositionsAreRightAnywhereInTheWorld)
{
	for (const double Origin : {0.0, 64.0, 16'000.0, -262'080.0, 262'144.0, 1e6, -5e7, 1e9})
	{
		for (const double Offset : {0.0, 0.25, -1.5, 1234.0625, -200'000.0})
		{
			EXPECT_EQ(GetDistanceOnGpu(Origin + Offset, Origin), Offset) << Origin;
		}
		EXPECT_NEAR(GetDistanceOnGpu(Origin + 0.1, Origin), 0.1, 0.5 / double(LIGHT_POSITION_STEPS) + 1e-7) << Origin;
	}
	(void)GetDistanceOnGpu(1e300, 0.0); // where it is does not matter, but that nothing overflows (sanitizers)
}

TEST(FLightStoreTest, NumbersTellLightsOfOneSlotApart)
{
	FLightStore Store;
	FSceneLight Light = MakeLight({});
	const FLightId First = Store.Add(Light);
	(void)Store.Add(Light);
	EXPECT_EQ(Store.GetTable()[First.Index].Number, MakeLightNumber(First));
	Light.Position.x += 1.0;
	Store.Set(First, Light); // moves alone take another way
	EXPECT_EQ(Store.GetTable()[First.Index].Number, MakeLightNumber(First));
	Store.Remove(First);
	EXPECT_EQ(Store.GetTable()[First.Index].Number, 0u);
	const FLightId Second = Store.Add(Light);
	ASSERT_EQ(Second.Index, First.Index);
	EXPECT_NE(Store.GetTable()[Second.Index].Number, MakeLightNumber(First));
	Light.Number = 77;
	Store.Set(Second, Light);
	EXPECT_EQ(Store.GetTable()[Second.Index].Number, 77u) << "the host's own";
}

TEST(FLightStoreTest, ShapesAreAsShadersReadThem)
{
	FSceneLight Light = MakeLight({}, LIGHT_RECTANGLE);
	Light.Direction = {0, 0, -2};
	Light.Tangent = {3, 0, 1};
	Light.bTwoSided = true;
	Light.bCastsShadow = false;
	FLightData Data = PackLight(Light);
	EXPECT_EQ(Data.Flags, LIGHT_RECTANGLE | LIGHT_TWO_SIDED | LIGHT_IN_FOG);
	Light.bLightsFog = false;
	EXPECT_EQ(Data.Size, glm::vec2(1, 1.5f)) << "half of each";
	EXPECT_EQ(glm::unpackSnorm2x16(Data.Tangent), glm::vec2(1, 0)) << "at a right angle to the direction";
	Light.Type = LIGHT_TUBE;
	EXPECT_EQ(PackLight(Light).Size, glm::vec2(2, 1.5f)) << "radius and half length";
	Light.Type = LIGHT_DISK;
	EXPECT_EQ(PackLight(Light).Size.x, 2.0f);
	Light.Type = LIGHT_DIRECTIONAL;
	Light.Size.x = std::numbers::pi_v<float>;
	EXPECT_FLOAT_EQ(PackLight(Light).Size.x, 1.0f) << "a hemisphere";
	Light.Type = LIGHT_POINT;
	Light.bTwoSided = false;
	Light.InnerCone = 0.2f;
	Light.OuterCone = 0.5f;
	Data = PackLight(Light);
	EXPECT_EQ(Data.Flags, LIGHT_POINT | LIGHT_HAS_CONE);
	EXPECT_NEAR(Data.SpotScale * std::cos(0.5f) + Data.SpotOffset, 0.0f, 1e-5f) << "dark at the outer cone";
	EXPECT_NEAR(Data.SpotScale * std::cos(0.2f) + Data.SpotOffset, 1.0f, 1e-5f) << "full within the inner one";
}

} // namespace
} // namespace Lantern
