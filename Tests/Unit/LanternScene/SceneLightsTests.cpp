// FSceneLights: what the constants say of lights, sun and sky.
#include <gtest/gtest.h>

#include "LanternScene/Scene/SceneLights.h"

namespace Lantern
{
namespace
{

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
	Lights.GetStore().Add({});
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
