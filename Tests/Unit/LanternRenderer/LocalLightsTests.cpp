// On the mock: what shadowed local lights add to a frame, and that kinds of lights and objects which a scene lacks add nothing.
#include "Support/RendererTestTools.h"

namespace Lantern
{
namespace
{

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class FLocalLightsMockTest : public FRendererTest
{
protected:
	void SetUp() override
	{
		FRendererTest::SetUp();
		Set("r.RT.AO", "0");
	}
	FRTScene& GetWorld() { return Engine->GetScene().GetScene(); }
	FLightId AddLamp(const FSceneLight& Like, bool bCastsShadow = true)
	{
		FSceneLight Light = Like;
		Light.Position = {0, 0, 1};
		Light.Color = glm::vec3(1);
		Light.bCastsShadow = bCastsShadow;
		return GetWorld().AddLight(Light);
	}
	std::vector<std::string> GetDispatched()
	{
		std::vector<std::string> Names;
		for (const FRTMockCall& Call : Mock().GetCalls())
		{
			if (Call.Kind == ERTMockCall::Dispatch || Call.Kind == ERTMockCall::DispatchIndirect) { Names.push_back(Call.Name); }
		}
		return Names;
	}
	/// Whether the frame traces, or prepares anything that only rays need.
	bool HasRays()
	{
		const bool bTraced = HasPass("ShadowRays") || HasPass("ShadowSecondRays") || HasPass("Structures") || HasPass("ShaderTable");
		EXPECT_EQ(bTraced, HasPass("ShadowRays"));
		EXPECT_TRUE(bTraced || (Mock().CountCalls(ERTMockCall::BuildScene) == 0 && Mock().CountCalls(ERTMockCall::BuildGeometry) == 0));
		return bTraced;
	}
};

// They are shaded by the same passes, in the same signals.
TEST_F(FLocalLightsMockTest, LampsWithoutShadowsTraceNothing)
{
	Set("r.RT.Lights.Rate", "1");
	for (const char* const Path : {"1", "2"})
	{
		Open(); // nothing of the other path is left
		Set("r.RT.Shadow.Path", Path);
		ASSERT_TRUE(Load({.bSun = false}));
		const FLightId Fill = AddLamp({}, false);
		for (int I = 0; I < 6; ++I) { AddLamp({}, false); } // more than each pixel asks
		Render();
		EXPECT_FALSE(HasRays()) << Path;
		EXPECT_TRUE(HasPass("ShadowLights"));
		EXPECT_TRUE(HasPass("ShadowLightsShade"));
		EXPECT_FALSE(HasPass("ShadowSecondAsk"));
		EXPECT_EQ(GetRTPSO(), nullptr) << "no pipeline for rays";
		EXPECT_THAT(Mock().GetCreatedPipelines(), Not(Contains(StartsWith("Rays/ShadowQueue"))));
		EXPECT_THAT(Mock().GetCreatedPipelines(), Not(Contains(StartsWith("LocalLights/SecondRays"))));
		FSceneLight Light = GetWorld().GetLights().Get(Fill);
		Light.bCastsShadow = true;
		GetWorld().SetLight(Fill, Light);
		Render();
		EXPECT_TRUE(HasRays()) << "one that casts is enough";
		GetWorld().RemoveLight(Fill);
		Render();
		EXPECT_FALSE(HasRays());
	}
}

TEST_F(FLocalLightsMockTest, DrawsItsPictures)
{
	ASSERT_TRUE(Load({.bSun = false}));
	AddLamp({});
	Render();
	EXPECT_FALSE(HasPass("LampView"));
	for (const char* const Name : {"lamp_tiles", "lamp_rays"})
	{
		Set("r.RT.Debug.View", Name);
		Render();
		EXPECT_TRUE(HasPass("LampView")) << Name;
		EXPECT_FALSE(HasPass("DebugView")) << Name;
		Set("r.RT.Lights", "0");
		Render();
		EXPECT_FALSE(HasPass("LampView"));
		EXPECT_FALSE(HasPass("DebugView"));
		Set("r.RT.Lights", "1");
	}
}

TEST_F(FLocalLightsMockTest, SwitchesOfKindsLeaveNoRaysBehind)
{
	struct FKind
	{
		const char* Variable;
		FSceneLight Light;
	};
	FSceneLight Point, Spot, Rect;
	Spot.OuterCone = 0.5f;
	Rect.Type = LIGHT_RECTANGLE;
	Rect.Size = {1, 1};
	const FKind Kinds[] = {{"r.RT.Lights.Shadows.Point", Point}, {"r.RT.Lights.Shadows.Spot", Spot}, {"r.RT.Lights.Shadows.Rect", Rect}};
	ASSERT_TRUE(Load({.bSun = false}));
	for (const FKind& Kind : Kinds)
	{
		const FLightId Lamp = AddLamp(Kind.Light);
		for (const FKind& Off : Kinds)
		{
			Set(Off.Variable, "0");
			Render();
			EXPECT_EQ(HasRays(), &Off != &Kind) << Kind.Variable << " by " << Off.Variable;
			EXPECT_TRUE(HasPass("ShadowLightsShade"));
			Set(Off.Variable, "1");
		}
		GetWorld().RemoveLight(Lamp);
	}
}

// Beside the sun, the queue's shader knows no lamps if none asks.
TEST_F(FLocalLightsMockTest, SunBesideLampsWithoutShadows)
{
	ASSERT_TRUE(Load({}));
	const FLightId Fill = AddLamp({}, false);
	Render();
	EXPECT_TRUE(HasPass("ShadowRays"));
	EXPECT_TRUE(HasPass("ShadowLightsShade"));
	EXPECT_THAT(GetDispatched(), Not(Contains(HasSubstr("LOCAL_RAYS"))));
	GetWorld().RemoveLight(Fill);
	AddLamp({});
	Render();
	EXPECT_THAT(GetDispatched(), Contains(HasSubstr("LOCAL_RAYS")));
}

TEST_F(FLocalLightsMockTest, CodeOfExtentsAndCharactersIsForScenesThatHaveThem)
{
	Set("r.RT.Shadow.Path", "2");
	ASSERT_TRUE(Load({}));
	AddLamp({});
	Render();
	EXPECT_THAT(GetDispatched(), Contains(StartsWith("LocalLights/Requests.comp HAS_LIGHTS")));
	EXPECT_THAT(GetDispatched(), Not(Contains(HasSubstr("HAS_AREA_LIGHTS"))));
	EXPECT_THAT(GetDispatched(), Not(Contains(HasSubstr("HAS_CHARACTERS"))));
	FSceneLight Sphere;
	Sphere.Type = LIGHT_SPHERE;
	Sphere.Size = {0.1f, 0};
	const FLightId Lamp = AddLamp(Sphere);
	Render();
	for (const char* const Shader : {"LocalLights/Requests.comp", "LocalLights/Shade.comp", "Rays/ShadowQueue.comp"})
	{
		EXPECT_THAT(GetDispatched(), Contains(::testing::AllOf(StartsWith(Shader), HasSubstr("HAS_AREA_LIGHTS"))));
	}
	GetWorld().RemoveLight(Lamp);
	FRTObjectInfo Doll = GetWorld().GetObject(Engine->GetScene().GetDraws()[0].Object);
	Doll.bCharacter = true;
	const FRTObjectId Object = GetWorld().AddObject(Doll);
	Render();
	EXPECT_THAT(GetDispatched(), Not(Contains(HasSubstr("HAS_AREA_LIGHTS"))));
	EXPECT_THAT(GetDispatched(), Contains(::testing::AllOf(StartsWith("Rays/ShadowQueue.comp"), HasSubstr("HAS_CHARACTERS"))));
	GetWorld().RemoveObject(Object);
	Render();
	EXPECT_THAT(GetDispatched(), Not(Contains(HasSubstr("HAS_CHARACTERS"))));
}

} // namespace
} // namespace Lantern
