// On the mock: what fewer rays to lamps and lamps that change add to a frame, and that they add nothing where nothing has a use for them.
#include "Support/RendererTestTools.h"

namespace Lantern
{
namespace
{

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class FLightRateTest : public FRendererTest
{
protected:
	void SetUp() override
	{
		FRendererTest::SetUp();
		Set("r.RT.Shadow", "0");
		Set("r.RT.AO", "0");
	}
	FRTScene& GetWorld() { return Engine->GetScene().GetScene(); }
	FLightId AddLamp(double X, float Brightness)
	{
		FSceneLight Light;
		Light.Position = {X, 0, 1};
		Light.Color = glm::vec3(Brightness);
		return GetWorld().AddLight(Light);
	}
	bool HasSecondRays() { return HasPass("ShadowSecondAsk") && HasPass("ShadowSecondRays"); }
	bool FollowsLamps() { return HasPass("LocalLightsChange"); }
	/// Whether anything of lamps that change was made since the device was opened.
	void ExpectNothingFollowed()
	{
		for (const FRTMockCall& Call : Mock().FindCalls(ERTMockCall::CreateBuffer))
		{
			EXPECT_EQ(Call.Name.find("Lamp"), std::string::npos);
		}
		EXPECT_THAT(Mock().GetCreatedPipelines(), Not(Contains(HasSubstr("Lamps.comp"))));
	}
};

TEST_F(FLightRateTest, SecondRaysAreForFewerFirstOnes)
{
	LoadAndRender({.bLights = true});
	EXPECT_FALSE(HasPass("ShadowSecondAsk"));
	EXPECT_THAT(Mock().GetCreatedPipelines(), Not(Contains(StartsWith("LocalLights/SecondRays.comp"))));
	for (const char* const Rate : {"1", "2"})
	{
		Set("r.RT.Lights.Rate", Rate);
		Render();
		EXPECT_TRUE(HasSecondRays()) << Rate;
	}
	Set("r.RT.Debug.Lights.SecondRay", "0");
	Render();
	EXPECT_FALSE(HasPass("ShadowSecondAsk"));
	Set("r.RT.Debug.Lights.SecondRay", "1");
	Set("r.RT.Lights.Rate", "0");
	Render();
	EXPECT_FALSE(HasPass("ShadowSecondAsk"));
}

TEST_F(FLightRateTest, WithoutLampsThereAreNoSecondRays)
{
	Set("r.RT.Shadow", "1");
	Set("r.RT.Lights.Rate", "1");
	LoadAndRender({});
	EXPECT_TRUE(HasPass("ShadowRays"));
	EXPECT_FALSE(HasPass("ShadowSecondAsk"));
	EXPECT_THAT(Mock().GetCreatedPipelines(), Not(Contains(StartsWith("LocalLights/SecondRays.comp"))));
}

// Lamps without an extent have no penumbrae, and without a filter nobody knows who has a history.
TEST_F(FLightRateTest, MoreRaysAreForPenumbraeOfFilteredLamps)
{
	ASSERT_TRUE(Load({}));
	const FLightId Lamp = AddLamp(0, 1.0f);
	Render();
	EXPECT_TRUE(HasPass("ShadowRays"));
	EXPECT_FALSE(HasPass("ShadowMoreLocalAsk"));
	EXPECT_THAT(Mock().GetCreatedPipelines(), Not(Contains(StartsWith("LocalLights/MoreLocalRays.comp"))));
	FSceneLight Sphere = GetWorld().GetLights().Get(Lamp);
	Sphere.Type = LIGHT_SPHERE;
	Sphere.Size = {0.1, 0};
	GetWorld().SetLight(Lamp, Sphere);
	const auto HasMore = [&] { return HasPass("ShadowMoreLocalAsk") && HasPass("ShadowMoreLocalRays"); };
	for (int Frame = 0; Frame < 4 && !HasMore(); ++Frame) { Render(); } // shaders are compiled beside the frames
	EXPECT_TRUE(HasMore());
	for (const char* const Name : {"r.RT.Lights.MoreRays", "r.RT.Lights.Denoise"})
	{
		Set(Name, "0");
		Render();
		EXPECT_TRUE(HasPass("ShadowRays")) << Name;
		EXPECT_FALSE(HasPass("ShadowMoreLocalAsk")) << Name;
		Set(Name, "1");
	}
}

// Only the first frame, which notes what all are, and frames in which one has changed.
TEST_F(FLightRateTest, LampsThatChangeAreFollowed)
{
	ASSERT_TRUE(Load({}));
	FLightId First;
	for (int I = 0; I < 6; ++I) { First = AddLamp(I, 1.0f); }
	Render();
	EXPECT_TRUE(HasPass("ChangedLamps"));
	EXPECT_FALSE(FollowsLamps()) << "there is no frame before";
	Render();
	EXPECT_FALSE(HasPass("ChangedLamps"));
	for (int Frame = 0; Frame < 10; ++Frame) { Render(); }
	FSceneLight Dark = GetWorld().GetLights().Get(First);
	Dark.Color = glm::vec3(0.1f);
	GetWorld().SetLight(First, Dark);
	Render();
	EXPECT_TRUE(HasPass("ChangedLamps"));
	EXPECT_TRUE(FollowsLamps()) << "what was noted is kept";
	Render();
	EXPECT_FALSE(HasPass("ChangedLamps"));
}

// As lamps: the first frame, and frames in which one has moved.
TEST_F(FLightRateTest, EmittersThatMoveAreFollowed)
{
	FSceneDescription Description = MakeDescription({.bEmissive = true});
	const size_t Panel = Description.Nodes.size() - 1;
	ASSERT_TRUE(Engine->Load(std::move(Description)));
	Render();
	EXPECT_TRUE(HasPass("ChangedEmitters"));
	EXPECT_FALSE(FollowsLamps()) << "there is no frame before";
	for (int Frame = 0; Frame < 10; ++Frame)
	{
		Render();
		EXPECT_FALSE(HasPass("ChangedEmitters"));
	}
	Mock().ClearCalls();
	Engine->GetScene().SetTransform(Panel, glm::dmat4(2.0));
	Render();
	EXPECT_TRUE(HasPass("ChangedEmitters"));
	EXPECT_TRUE(FollowsLamps()) << "what was noted is kept";
	EXPECT_TRUE(HasPass("ChangedLamps")) << "the list says that no lamp has changed";
	EXPECT_EQ(Mock().FindDispatches("LocalLights/ListEmitters.comp").size(), 1u);
	EXPECT_TRUE(Mock().FindDispatches("LocalLights/ListLamps.comp").empty()) << "there are none";
	Render();
	EXPECT_FALSE(HasPass("ChangedEmitters"));
	EXPECT_FALSE(FollowsLamps());
	Set("r.RT.Debug.Lights.Rescale", "0");
	Engine->GetScene().SetTransform(Panel, glm::dmat4(3.0));
	Render();
	EXPECT_FALSE(FollowsLamps());
}

// What lamps were is noted with room for some more, or else a lamp that comes and goes at a limit would be followed never.
TEST_F(FLightRateTest, LampsBeyondEveryPowerOfTwoAreFollowed)
{
	ASSERT_TRUE(Load({}));
	FLightId Last;
	for (int I = 0; I < 64; ++I) { Last = AddLamp(I, 1.0f); }
	Render();
	Last = AddLamp(64, 1.0f);
	Render();
	EXPECT_TRUE(FollowsLamps());
	const std::vector<std::string> Passes = GetPasses();
	EXPECT_EQ(std::count(Passes.begin(), Passes.end(), "ChangedLamps"), 1) << "one list for both lobes";
	GetWorld().RemoveLight(Last);
	Render();
	EXPECT_TRUE(FollowsLamps());
	for (int I = 0; I < 300; ++I) { AddLamp(I, 1.0f); }
	Render();
	EXPECT_TRUE(FollowsLamps()) << "without notes, histories are given up";
}

TEST_F(FLightRateTest, WhatIsNotAccumulatedNeedsNotFollow)
{
	Set("r.RT.Lights.Denoise", "0");
	ASSERT_TRUE(Load({}));
	for (int I = 0; I < 6; ++I) { AddLamp(I, 1.0f); }
	Render();
	AddLamp(7, 1.0f);
	Render();
	ExpectNothingFollowed();
}

TEST_F(FLightRateTest, TilesOfFewLampsFindChangesThemselves)
{
	ASSERT_TRUE(Load({}));
	for (int I = 0; I < 3; ++I) { AddLamp(I, 1.0f); }
	Render();
	AddLamp(7, 1.0f);
	Render();
	ExpectNothingFollowed();
}

TEST_F(FLightRateTest, PlantedFaultFollowsNothing)
{
	Set("r.RT.Debug.Lights.Rescale", "0");
	ASSERT_TRUE(Load({}));
	for (int I = 0; I < 6; ++I) { AddLamp(I, 1.0f); }
	Render();
	AddLamp(7, 1.0f);
	Render();
	ExpectNothingFollowed();
}

} // namespace
} // namespace Lantern
