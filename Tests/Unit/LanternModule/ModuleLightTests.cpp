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
