// Reflections of objects with a style: their strength, their roughness, the reference, and that nothing else changes.
#include <cmath>

#include "Support/RenderFixture.h"
#include "Support/TestScene.h"

namespace Lantern
{

namespace
{

class FToonReflectionsTest : public FRenderTest
{
protected:
	static constexpr uint32_t Size = 24;

	/// Two plates that face the camera, before a floor that the sun lights. The left one has the style.
	void LoadPlates(float Metallic, float Roughness)
	{
		FTestScene Out("plates");
		FHostMaterial Metal;
		Metal.BaseColor = glm::vec4(Blue, 1.0f);
		Metal.Metallic = Metallic;
		Metal.Roughness = Roughness;
		Metal.bDoubleSided = true;
		const int32_t Material = Out.AddMaterial(Metal);
		for (const float X : {-1.0f, 0.0f})
		{
			const int32_t Node = Out.AddNode(Out.AddMesh({{Material, {{X, -1, 0}, {X + 1, -1, 0}, {X + 1, 1, 0}, {X, 1, 0}}}}));
			if (X < 0.0f) { Out.Scene.Nodes[static_cast<size_t>(Node)].Toon = FToonStyle(); }
		}
		ASSERT_TRUE(Load(std::move(Out.Scene)));
		SetSun(0.0, 0.0f);
		SetSky(Sky);
		SetVariable("r.RT.GI", "0");
		SetVariable("r.RT.Reflections", "1");
		SetVariable("r.RT.Reflections.MaxRoughness", "1");
		SetVariable("r.RT.Reflections.Denoise", "0");
		SetVariable("r.RT.Reflections.Toon", "1");
	}
	static FView SeePlates() { return LookAt({0, 0, 3}, {0, 0, 0}, 0.3f, Size, Size); }
	static FImage Render() { return RenderSignal(ESignal::Reflections, SeePlates(), 2); }
	static double At(const FImage& Picture, uint32_t X, uint32_t Channel) { return double(Picture.At(X, Size / 2, Channel)); }
	static constexpr glm::vec3 Blue{0.2f, 0.5f, 0.9f};
	static constexpr glm::vec3 Sky{0.5f, 1.0f, 0.25f};
	static constexpr uint32_t Styled = 4, Other = 20;
};

TEST_F(FToonReflectionsTest, MetalIsTheStrength)
{
	for (const char* const Route : {"1", "2"})
	{
		ASSERT_NO_FATAL_FAILURE(LoadPlates(0.95f, 0.2f));
		SetVariable("r.RT.Reflections", Route);
		for (const double Tint : {0.0, 1.0})
		{
			SetVariable("r.RT.Reflections.Toon.Tint", Tint > 0.0 ? "1" : "0");
			const FImage Tinted = Render();
			for (uint32_t Channel = 0; Channel < 3; ++Channel)
			{
				const double Color = Tint > 0.0 ? double(Blue[int(Channel)] / Blue.z) : 1.0; // metalness and colour have eight bits
				EXPECT_NEAR(At(Tinted, Styled, Channel) / double(Sky[int(Channel)]), 0.95 * Color, 0.01) << Route;
			}
		}
		const FImage Shown = Render();
		EXPECT_LT(At(Shown, Other, 0) / double(Sky.x), 0.3) << "metal of a colour";
		SetVariable("r.RT.Reflections.Toon", "0");
		const FImage Off = Render();
		EXPECT_NEAR(At(Off, Other, 0) / At(Shown, Other, 0), 1.0, 2e-3) << "colours of other objects are rounded to half floats";
		EXPECT_NEAR(At(Off, Styled, 0), At(Shown, Other, 0), 0.01);
	}
}

// A mirror of metal is as bright as its light at any angle, and so is a painted strength.
TEST_F(FToonReflectionsTest, StrengthIsThatOfAnyAngle)
{
	ASSERT_NO_FATAL_FAILURE(LoadPlates(0.95f, 0.2f));
	SetVariable("r.RT.Reflections.Toon.Tint", "0");
	for (const double Degrees : {0.0, 45.0, 70.0})
	{
		const double Angle = glm::radians(Degrees);
		const FView View = LookAt({-0.5, 3.0 * std::sin(Angle), 3.0 * std::cos(Angle)}, {-0.5, 0, 0}, 0.1f, Size, Size);
		const FImage Shown = RenderSignal(ESignal::Reflections, View, 2);
		EXPECT_NEAR(At(Shown, Size / 2, 1), 0.95, 0.02) << Degrees << " degrees; a G-buffer's roughness and colour have eight bits";
	}
}

TEST_F(FToonReflectionsTest, BelowTheThresholdNothingIsAdded)
{
	ASSERT_NO_FATAL_FAILURE(LoadPlates(0.89f, 0.2f));
	EXPECT_EQ(At(Render(), Styled, 1), 0.0);
	EXPECT_GT(At(Render(), Other, 1), 0.1);
	SetVariable("r.RT.Reflections.Toon.Threshold", "0");
	EXPECT_NEAR(At(Render(), Styled, 2) / double(Sky.z), 0.89, 0.01) << "the planted fault shows";
	ASSERT_NO_FATAL_FAILURE(LoadPlates(0.91f, 0.2f));
	SetVariable("r.RT.Reflections.Toon.Threshold", "0.9");
	EXPECT_NEAR(At(Render(), Styled, 2) / double(Sky.z), 0.91, 0.01);
}

TEST_F(FToonReflectionsTest, RoughnessIsClamped)
{
	const auto Show = [&](float Roughness) {
		LoadPlates(1.0f, Roughness);
		SetVariable("r.Sky.Program", "1"); // bright and dark, so that roughness shows
		SetVariable("r.Sky.Clouds", "0");
		return Render();
	};
	// 26 and 89 of 255 are the nearest to 0.1 and 0.35 that a G-buffer holds.
	for (const auto& [Roughness, Limit] : {std::pair(0.0f, 26.0f), std::pair(1.0f, 89.0f)})
	{
		const FImage Clamped = Show(Roughness), AtLimit = Show(Limit / 255.0f);
		for (uint32_t X = 2; X < 10; ++X) { EXPECT_EQ(At(Clamped, X, 1), At(AtLimit, X, 1)) << Roughness; }
		EXPECT_NE(At(Clamped, Other, 1), At(AtLimit, Other, 1)) << "else roughness shows nowhere";
	}
}

TEST_F(FToonReflectionsTest, TheReferenceAgrees)
{
	ASSERT_NO_FATAL_FAILURE(LoadPlates(0.95f, 0.2f));
	FReferenceSettings Settings;
	Settings.View = SeePlates();
	Settings.Signal = ESignal::Reflections;
	Settings.Samples = 64;
	Settings.bPixelCenters = Settings.bRasterSurfaces = true;
	const FImage Reference = TraceReference(Settings), Shown = Render();
	for (const uint32_t X : {Styled, Other})
	{
		for (uint32_t Channel = 0; Channel < 3; ++Channel) { EXPECT_NEAR(At(Shown, X, Channel), At(Reference, X, Channel), 0.01) << X; }
	}
}

} // namespace
} // namespace Lantern
