// FSceneLights: positions relative to the origin, and what the constants say of sun and sky.
#include <gtest/gtest.h>

#include "LanternScene/Scene/SceneLights.h"

namespace Lantern
{
namespace
{

FSceneLight MakeLight(glm::dvec3 Position, float Range = 0.0f)
{
	FSceneLight Light{};
	Light.WorldPosition = Position;
	Light.Data.Range = Range;
	return Light;
}

TEST(FSceneLightsTest, PositionsAreRelativeToTheOrigin)
{
	FSceneLights Lights;
	Lights.SetLights({MakeLight({16'001, 2, 3}, 5.0f), MakeLight({15'999, 0, 0})});
	EXPECT_TRUE(Lights.NeedsUpdate());
	Lights.Update({16'000, 0, 0});
	EXPECT_FALSE(Lights.NeedsUpdate());
	ASSERT_EQ(Lights.GetTable().Num(), 2u);
	EXPECT_EQ(Lights.GetTable()[0].Position, glm::vec3(1, 2, 3));
	EXPECT_EQ(Lights.GetTable()[0].Range, 5.0f);
	EXPECT_EQ(Lights.GetTable()[1].Position, glm::vec3(-1, 0, 0));
	Lights.OnOriginMoved();
	EXPECT_TRUE(Lights.NeedsUpdate());
	Lights.Update({16'064, 0, 0});
	EXPECT_EQ(Lights.GetTable()[0].Position, glm::vec3(-63, 2, 3));
	EXPECT_EQ(Lights.GetLights()[0].WorldPosition, glm::dvec3(16'001, 2, 3));
}

TEST(FSceneLightsTest, RemovedLightsLeaveTheTable)
{
	FSceneLights Lights;
	Lights.SetLights({MakeLight({1, 2, 3})});
	Lights.Update({});
	Lights.SetLights({});
	EXPECT_TRUE(Lights.NeedsUpdate());
	Lights.Update({});
	FSceneConstants Constants{};
	Lights.FillConstants(Constants);
	EXPECT_EQ(Constants.LightCount, 0u);
}

TEST(FSceneLightsTest, ConstantsHoldSunAndSky)
{
	FSceneLights Lights;
	FSunLight Sun;
	Sun.Direction = {0, -4, 0};
	Sun.Color = {1, 0.5f, 0.25f};
	Sun.Irradiance = 100.0f;
	Sun.AngularDiameter = 0.0093f;
	Lights.SetSun(Sun);
	Lights.SetSky({1, 2, 3});
	Lights.SetLights({MakeLight({})});
	Lights.Update({});
	FSceneConstants Constants{};
	Lights.FillConstants(Constants);
	EXPECT_EQ(Constants.SunDirection, glm::vec3(0, -1, 0));
	EXPECT_EQ(Constants.SunColor, Sun.Color);
	EXPECT_EQ(Constants.SunIrradiance, 100.0f);
	EXPECT_EQ(Constants.SkyRadiance, glm::vec3(1, 2, 3));
	EXPECT_EQ(Constants.LightCount, 1u);
	// The series of 1 − cos r: fp32 has no digits of it left.
	const double Radius = 0.5 * double(Sun.AngularDiameter), Square = Radius * Radius;
	EXPECT_FLOAT_EQ(Constants.SunOneMinusCos, static_cast<float>(Square / 2 - Square * Square / 24));
}

TEST(FSceneLightsTest, SunAndSkyAreThereOnceTheyShine)
{
	FSceneLights Lights;
	EXPECT_FALSE(Lights.HasSun());
	EXPECT_FALSE(Lights.HasSky());
	FSunLight Sun;
	Sun.Irradiance = 1.0f;
	Lights.SetSun(Sun);
	Lights.SetSky({0, 0, 0.5f});
	EXPECT_TRUE(Lights.HasSun());
	EXPECT_TRUE(Lights.HasSky());
	Lights.SetSky({});
	EXPECT_FALSE(Lights.HasSky());
}

} // namespace
} // namespace Lantern
