// Lights and casters of the module: what shaders and rays see of them, and what is refused.
#include <cmath>
#include <functional>
#include <limits>

#include <glm/gtc/packing.hpp>

#include "ModuleTestTools.h"

namespace Lantern
{
namespace
{

class FModuleLightTest : public FModuleTest
{
protected:
	void SetUp() override
	{
		FModuleTest::SetUp();
		ASSERT_OK(SetSun(-1.0));
	}
	FRTModuleObject MakePlaced()
	{
		FRTModuleObject Placed;
		Placed.Mesh = AddOpaqueMesh();
		Placed.Materials = &Solid;
		Placed.MaterialCount = 1;
		return Placed;
	}
	FLightData Read(uint32_t Slot)
	{
		const FSceneConstants Constants = ReadConstants(DescribeFrame());
		EXPECT_GT(Constants.LightCount, Slot);
		return ReadEntry<FLightData>(Constants.Lights, Slot);
	}
	FRTStatus Try(const std::function<void(FRTModuleLight&)>& Change)
	{
		FRTModuleLight Light;
		Light.Type = ERTModuleLight::Rectangle;
		Light.Width = Light.Height = Light.Radius = 1.0f;
		Change(Light);
		ERTLightHandle Handle = ERTLightHandle::None;
		const FRTStatus Status = Renderer->AddLight(Light, &Handle);
		EXPECT_EQ(Status.IsOk(), Handle != ERTLightHandle::None);
		return Status;
	}
};

TEST_F(FModuleLightTest, LightsComeChangeAndGo)
{
	ASSERT_OK(AddObject(AddOpaqueMesh(), Solid));
	FRTModuleLight Lamp;
	Lamp.Color[1] = 40.0f;
	Lamp.Position[0] = 3.0;
	ERTLightHandle First = ERTLightHandle::None, Second = ERTLightHandle::None;
	ASSERT_OK(Renderer->AddLight(Lamp, &First));
	Lamp.Type = ERTModuleLight::Spot;
	Lamp.Direction[1] = -2.0f;
	ASSERT_OK(Renderer->AddLight(Lamp, &Second));
	FSceneConstants Constants = ReadConstants(DescribeFrame());
	ASSERT_EQ(Constants.LightCount, 2u);
	auto Light = ReadEntry<FLightData>(Constants.Lights, 0);
	EXPECT_EQ(Light.Flags, LIGHT_POINT | LIGHT_CASTS_SHADOW | LIGHT_IN_FOG);
	EXPECT_EQ(Light.Position, glm::ivec3(3 * LIGHT_POSITION_STEPS, 0, 0));
	EXPECT_EQ(Light.Color, glm::vec3(0, 40, 0));
	Light = ReadEntry<FLightData>(Constants.Lights, 1);
	EXPECT_EQ(Light.Flags, LIGHT_POINT | LIGHT_HAS_CONE | LIGHT_CASTS_SHADOW | LIGHT_IN_FOG);
	EXPECT_EQ(Light.Direction, 0x8001'0000u) << "octahedral: 0, -1";
	EXPECT_NEAR(Light.SpotScale * std::cos(0.7853982f) + Light.SpotOffset, 0.0f, 1e-5f) << "dark at the outer cone";
	EXPECT_NEAR(Light.SpotScale + Light.SpotOffset, 1.0f, 1e-5f) << "bright on the axis";
	ASSERT_OK(Renderer->RemoveLight(First));
	Lamp.Color[1] = 10.0f;
	ASSERT_OK(Renderer->SetLight(Second, Lamp));
	Constants = ReadConstants(DescribeFrame());
	ASSERT_EQ(Constants.LightCount, 2u) << "the second light stays in its slot";
	EXPECT_EQ(ReadEntry<FLightData>(Constants.Lights, 0).Flags, LIGHT_NONE);
	EXPECT_EQ(ReadEntry<FLightData>(Constants.Lights, 1).Color, glm::vec3(0, 10, 0));
	EXPECT_REFUSED(Renderer->SetLight(First, Lamp), "no such light");
	EXPECT_REFUSED(Renderer->RemoveLight(First), "no such light");
	Lamp.OuterCone = 2.0f;
	EXPECT_REFUSED(Renderer->SetLight(Second, Lamp), "OuterCone");
	Lamp.OuterCone = 0.5f;
	Lamp.Color[0] = -1.0f;
	EXPECT_REFUSED(Renderer->SetLight(Second, Lamp), "Color");
}

// Profiles: files and tables, their peaks, their numbers in lights, and that a profile in use stays.
TEST_F(FModuleLightTest, ProfilesComeAndGo)
{
	constexpr char File[] = "TILT=NONE\n1 1000 2 3 1 1 2 0 0 0\n1 1 10\n0 45 90\n0\n100 50 0\n";
	ASSERT_OK(AddObject(AddOpaqueMesh(), Solid));
	FRTModuleIesProfile Given;
	Given.Name = "lamp.ies";
	Given.Text = File;
	Given.TextBytes = sizeof(File) - 1;
	ERTIesHandle Profile = ERTIesHandle::None, Table = ERTIesHandle::None;
	FRTModuleIesInfo Info;
	ASSERT_OK(Renderer->AddIesProfile(Given, &Profile, &Info));
	EXPECT_EQ(Info.Peak, 200.0f);
	Given.TextBytes -= 6;
	EXPECT_REFUSED(Renderer->AddIesProfile(Given, &Table, nullptr), "lamp.ies:5: the file ends before 3 numbers: an intensity");
	EXPECT_EQ(Table, ERTIesHandle::None);
	Given.Text = nullptr;
	EXPECT_REFUSED(Renderer->AddIesProfile(Given, &Table, nullptr), "is null");
	const float Vertical[] = {0, 180}, Horizontal[] = {0}, Candela[] = {3, 6};
	Given.VerticalAngles = Vertical;
	Given.VerticalCount = 2;
	Given.HorizontalAngles = Horizontal;
	Given.HorizontalCount = 1;
	Given.Candela = Candela;
	Given.VerticalCount = ~0u;
	EXPECT_REFUSED(Renderer->AddIesProfile(Given, &Table, nullptr), "FRTModuleIesProfile::VerticalCount must be 4096 at most");
	Given.VerticalCount = 2;
	Given.HorizontalCount = ~0u;
	EXPECT_REFUSED(Renderer->AddIesProfile(Given, &Table, nullptr), "FRTModuleIesProfile::HorizontalCount");
	Given.HorizontalCount = 0;
	EXPECT_REFUSED(Renderer->AddIesProfile(Given, &Table, nullptr), "1 horizontal one at least");
	Given.HorizontalCount = 1;
	ASSERT_OK(Renderer->AddIesProfile(Given, &Table, nullptr));

	FRTModuleLight Lamp;
	Lamp.Color[1] = 40.0f;
	Lamp.Ies = Table;
	ERTLightHandle Handle = ERTLightHandle::None;
	ASSERT_OK(Renderer->AddLight(Lamp, &Handle));
	EXPECT_EQ(Read(0).Flags >> LIGHT_PROFILE_SHIFT, 2u);
	const FSceneConstants Constants = ReadConstants(DescribeFrame());
	EXPECT_EQ(ReadEntry<FLightProfile>(Constants.LightProfiles, 1).Rows, 19u) << "by 10°";
	EXPECT_REFUSED(Renderer->RemoveIesProfile(Table), "1 lights have the profile");
	Lamp.Ies = Profile;
	ASSERT_OK(Renderer->SetLight(Handle, Lamp));
	ASSERT_OK(Renderer->RemoveIesProfile(Table));
	EXPECT_REFUSED(Renderer->RemoveIesProfile(Table), "no such profile");
	EXPECT_EQ(Read(0).Flags >> LIGHT_PROFILE_SHIFT, 1u);
	Lamp.Ies = Table;
	EXPECT_REFUSED(Renderer->SetLight(Handle, Lamp), "no such profile");
	Lamp.Ies = Profile;
	Lamp.Type = ERTModuleLight::Sphere;
	Lamp.Radius = 1.0f;
	EXPECT_REFUSED(Renderer->SetLight(Handle, Lamp), "FRTModuleLight::Ies");
	ASSERT_OK(Renderer->RemoveLight(Handle));
	EXPECT_OK(Renderer->RemoveIesProfile(Profile));
}

// Channels of lights and objects, as shaders see them. The default costs no table.
TEST_F(FModuleLightTest, ChannelsReachTheScene)
{
	ERTObjectHandle Thing = ERTObjectHandle::None;
	ASSERT_OK(Renderer->AddObject(MakePlaced(), &Thing));
	FRTModuleLight Lamp;
	ERTLightHandle Handle = ERTLightHandle::None;
	ASSERT_OK(Renderer->AddLight(Lamp, &Handle));
	EXPECT_EQ(Read(0).Flags >> LIGHT_CHANNELS_SHIFT, 0u) << "coded as what differs from channel 0";
	EXPECT_EQ(ReadConstants(DescribeFrame()).ObjectChannels, 0u);
	Lamp.Channels = 4;
	ASSERT_OK(Renderer->SetLight(Handle, Lamp));
	ASSERT_OK(Renderer->SetObjectChannels(Thing, 6));
	EXPECT_EQ(Read(0).Flags >> LIGHT_CHANNELS_SHIFT, 4u ^ CHANNELS_DEFAULT);
	const FSceneConstants Constants = ReadConstants(DescribeFrame());
	ASSERT_NE(Constants.ObjectChannels, 0u);
	EXPECT_EQ(ReadEntry<uint32_t>(Constants.ObjectChannels, 0), 6u ^ CHANNELS_DEFAULT);
	ASSERT_OK(Renderer->RemoveObject(Thing));
	EXPECT_REFUSED(Renderer->SetObjectChannels(Thing, 1), "no such object");
}

// Styles of objects, as shaders see them: by object, and by the engine's numbers. None costs no table.
TEST_F(FModuleLightTest, ToonStylesReachTheScene)
{
	ERTObjectHandle Thing = ERTObjectHandle::None;
	ASSERT_OK(Renderer->AddObject(MakePlaced(), &Thing));
	EXPECT_EQ(ReadConstants(DescribeFrame()).ToonStyles, 0u);
	FRTModuleToon Toon;
	Toon.Center[1] = 150.0f;
	Toon.SphereWeight = 1.0f;
	Toon.Tint[2] = 0.5f;
	Toon.Number = 7;
	ASSERT_OK(Renderer->SetObjectToon(Thing, &Toon));
	const FSceneConstants Constants = ReadConstants(DescribeFrame());
	ASSERT_NE(Constants.ToonStyles, 0u);
	const FToonData Data = ReadEntry<FToonData>(Constants.ToonStyles, 0);
	EXPECT_EQ(Data.Center, glm::vec3(0, 150, 0)) << "the mesh's space is the engine's";
	EXPECT_EQ(Data.SphereWeight, 1.0f);
	EXPECT_EQ(Data.Bend, Toon.Bend);
	EXPECT_EQ(Data.MaxSaturation, Toon.MaxSaturation);
	EXPECT_EQ(Data.MaxValue, Toon.MaxValue);
	EXPECT_EQ(Data.Tint, glm::vec3(1, 1, 0.5f));
	EXPECT_EQ(ReadEntry<uint32_t>(Constants.ObjectToons, 0), 1u);
	EXPECT_EQ(ReadEntry<uint32_t>(Constants.ToonNumbers, 7), 1u);
	EXPECT_EQ(ReadEntry<uint32_t>(Constants.ToonNumbers, 6), 0u);
	ASSERT_OK(Renderer->SetObjectToon(Thing, nullptr));
	EXPECT_EQ(ReadConstants(DescribeFrame()).ToonStyles, 0u);
	ASSERT_OK(Renderer->RemoveObject(Thing));
	EXPECT_REFUSED(Renderer->SetObjectToon(Thing, &Toon), "no such object");
}

TEST_F(FModuleLightTest, WrongToonStylesAreNamed)
{
	const float Nan = std::numeric_limits<float>::quiet_NaN();
	FRTModuleObject Placed = MakePlaced();
	const auto Refuse = [&](auto&& Change, const char* Says) {
		FRTModuleToon Toon;
		Change(Toon);
		Placed.Toon = &Toon;
		ERTObjectHandle Thing = ERTObjectHandle::None;
		EXPECT_REFUSED(Renderer->AddObject(Placed, &Thing), Says);
	};
	Refuse([&](auto& T) { T.Center[2] = Nan; }, "FRTModuleToon::Center must be finite");
	for (const float Wrong : {-0.1f, 1.1f, Nan})
	{
		Refuse([&](auto& T) { T.SphereWeight = Wrong; }, "FRTModuleToon::SphereWeight");
		Refuse([&](auto& T) { T.Bend = Wrong; }, "FRTModuleToon::Bend");
		Refuse([&](auto& T) { T.MaxSaturation = Wrong; }, "FRTModuleToon::MaxSaturation");
		Refuse([&](auto& T) { T.Occlusion = Wrong; }, "FRTModuleToon::Occlusion");
	}
	Refuse([&](auto& T) { T.MaxValue = -1.0f; }, "FRTModuleToon::MaxValue");
	Refuse([&](auto& T) { T.Tint[0] = T.Tint[1] = T.Tint[2] = 0.0f; }, "FRTModuleToon::Tint");
	Refuse([&](auto& T) { T.Tint[1] = Nan; }, "FRTModuleToon::Tint");
}

// An engine's world: centimetres, left-handed, z up.
TEST_F(FModuleLightTest, ShapesAreInTheEnginesWorld)
{
	ASSERT_OK(Module->CreateRenderer(Device.Get(), MakeUnrealWorld(), Renderer.ReleaseAndGetAddress()));
	ASSERT_OK(Renderer->AddMaterial({}, &Solid));
	ASSERT_OK(AddObject(AddOpaqueMesh(), Solid));
	ASSERT_OK(SetSun(-1.0));
	FRTModuleLight Panel;
	Panel.Type = ERTModuleLight::Rectangle;
	Panel.Position[2] = 250.0;
	Panel.Direction[0] = 0.0f;
	Panel.Direction[1] = 0.0f;
	Panel.Direction[2] = -1.0f; // down
	Panel.Tangent[0] = 0.0f;
	Panel.Tangent[1] = 2.0f; // right
	Panel.Width = 200.0f;
	Panel.Height = 100.0f;
	Panel.bTwoSided = true;
	Panel.bCastsShadow = false;
	ERTLightHandle Handle = ERTLightHandle::None;
	ASSERT_OK(Renderer->AddLight(Panel, &Handle));
	FLightData Light = Read(0);
	EXPECT_EQ(Light.Flags, LIGHT_RECTANGLE | LIGHT_TWO_SIDED | LIGHT_IN_FOG);
	EXPECT_EQ(Light.Position, glm::ivec3(0, 2.5 * LIGHT_POSITION_STEPS, 0));
	EXPECT_EQ(Light.Size, glm::vec2(1.0f, 0.5f));
	EXPECT_EQ(glm::unpackSnorm2x16(Light.Direction), glm::vec2(0, -1));
	EXPECT_EQ(glm::unpackSnorm2x16(Light.Tangent), glm::vec2(1, 0));
	Panel.Type = ERTModuleLight::Tube;
	Panel.Radius = 5.0f;
	Panel.Length = 120.0f;
	Panel.bCone = true;
	Panel.bLightsFog = false;
	ASSERT_OK(Renderer->SetLight(Handle, Panel));
	Light = Read(0);
	EXPECT_EQ(Light.Flags & LIGHT_IN_FOG, 0u);
	EXPECT_EQ(Light.Flags & LIGHT_TYPE_MASK, LIGHT_TUBE);
	EXPECT_NE(Light.Flags & LIGHT_HAS_CONE, 0u);
	EXPECT_FLOAT_EQ(Light.Size.x, 0.05f);
	EXPECT_FLOAT_EQ(Light.Size.y, 0.6f);
}

TEST_F(FModuleLightTest, WrongLightsAreRefusedByName)
{
	constexpr float NaN = std::numeric_limits<float>::quiet_NaN(), Infinity = std::numeric_limits<float>::infinity();
	EXPECT_OK(Try([](auto&) {}));
	for (const float Bad : {0.0f, -1.0f, NaN, Infinity, 1e10f})
	{
		EXPECT_REFUSED(Try([&](auto& L) { L.Width = Bad; }), "FRTModuleLight::Width");
		EXPECT_REFUSED(Try([&](auto& L) { L.Height = Bad; }), "FRTModuleLight::Height");
		for (const ERTModuleLight Type : {ERTModuleLight::Disk, ERTModuleLight::Sphere, ERTModuleLight::Tube})
		{
			EXPECT_REFUSED(Try([&](auto& L) {
				L.Type = Type;
				L.Radius = Bad;
			}),
			    "FRTModuleLight::Radius");
		}
	}
	for (const float Bad : {-1.0f, NaN, Infinity})
	{
		EXPECT_REFUSED(Try([&](auto& L) {
			L.Type = ERTModuleLight::Tube;
			L.Length = Bad;
		}),
		    "FRTModuleLight::Length");
		EXPECT_REFUSED(Try([&](auto& L) {
			L.Type = ERTModuleLight::Directional;
			L.AngularDiameter = Bad;
		}),
		    "FRTModuleLight::AngularDiameter");
		EXPECT_REFUSED(Try([&](auto& L) { L.Range = Bad; }), "FRTModuleLight::Range");
		EXPECT_REFUSED(Try([&](auto& L) { L.Color[1] = Bad; }), "FRTModuleLight::Color");
		EXPECT_REFUSED(Try([&](auto& L) { L.Position[1] = Bad * Infinity; }), "FRTModuleLight::Position");
	}
	EXPECT_REFUSED(Try([](auto& L) { L.Position[0] = 1e300; }), "FRTModuleLight::Position");
	EXPECT_REFUSED(Try([](auto& L) { L.Color[2] = 1e21f; }), "FRTModuleLight::Color");
	EXPECT_REFUSED(Try([](auto& L) { L.Direction[1] = 0.0f; }), "FRTModuleLight::Direction");
	EXPECT_REFUSED(Try([](auto& L) { L.Tangent[0] = NaN; }), "FRTModuleLight::Tangent is zero");
	EXPECT_REFUSED(Try([](auto& L) {
		L.Tangent[0] = 0.0f;
		L.Tangent[1] = 5.0f;
	}),
	    "FRTModuleLight::Tangent is along Direction");
	EXPECT_REFUSED(Try([](auto& L) {
		L.bCone = true;
		L.OuterCone = 0.0f;
	}),
	    "OuterCone");
	EXPECT_REFUSED(Try([](auto& L) { L.Type = static_cast<ERTModuleLight>(99); }), "FRTModuleLight::Type");
	// What does not count for a light's type may be anything.
	EXPECT_OK(Try([](auto& L) {
		L.Type = ERTModuleLight::Point;
		L.Width = NaN;
		L.Direction[1] = 0.0f;
		L.OuterCone = NaN;
	}));
}

TEST_F(FModuleLightTest, ObjectsSayWhatTheyShadow)
{
	ASSERT_OK(SetSun(4.0));
	const ERTMeshHandle Mesh = AddOpaqueMesh();
	const auto FindMask = [&](const std::function<void(FRTModuleObject&)>& Change) {
		FRTModuleObject Added;
		Added.Mesh = Mesh;
		Added.Materials = &Solid;
		Added.MaterialCount = 1;
		Change(Added);
		ERTObjectHandle Handle = ERTObjectHandle::None;
		EXPECT_OK(Renderer->AddObject(Added, &Handle));
		std::vector<uint32_t> Masks;
		const auto Step = [&] {
			ASSERT_OK(RenderWholeFrame());
			Masks.clear();
			for (IRTScene* const Scene : Mock().FindLiveScenes())
			{
				for (const FRTMockInstance& Item : Mock().GetSceneInstances(Scene))
				{
					Masks.push_back(Item.Instance.CustomIndexAndMask >> 24);
				}
			}
			GiveWay();
		};
		EXPECT_TRUE(WaitUntil(
		    "the object", [&] { return Masks.size() == 1; }, Step));
		EXPECT_OK(Renderer->RemoveObject(Handle));
		const uint32_t Mask = Masks.empty() ? 0 : Masks[0];
		EXPECT_TRUE(WaitUntil(
		    "no object", [&] { return Masks.empty(); }, Step));
		return Mask & (MASK_CASTERS | MASK_VISIBLE);
	};
	EXPECT_EQ(FindMask([](auto&) {}), MASK_VISIBLE | MASK_SUN_MOVING | MASK_LOCAL);
	EXPECT_EQ(FindMask([](auto& O) { O.Mobility = ERTModuleMobility::Static; }), MASK_VISIBLE | MASK_SUN | MASK_LOCAL);
	EXPECT_EQ(FindMask([](auto& O) { O.bCastsLocalShadow = false; }), MASK_VISIBLE | MASK_SUN_MOVING);
	EXPECT_EQ(FindMask([](auto& O) { O.bCharacter = true; }), MASK_VISIBLE | MASK_CHARACTER);
	EXPECT_EQ(FindMask([](auto& O) { O.bCastsShadow = false; }), MASK_VISIBLE);
}

} // namespace
} // namespace Lantern
