// Light of local lights in fog against sums on the CPU, and the sample engine's height fog against integrals.
#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "FogFixture.h"
#include "LanternImage/ImageStatistics.h"

namespace Lantern
{
namespace
{

double ComputePhase(double Cosine, double G) { return (1 - G * G) / (4 * Pi * std::pow(1 + G * G - 2 * G * Cosine, 1.5)); }

class FFogLightTest : public FFogTest
{
protected:
	void SetUp() override
	{
		FFogTest::SetUp();
		SetVariable("r.RT.Fog.PixelSize", "4");
		SetVariable("r.RT.Fog.Slices", "64");
		SetVariable("r.RT.Fog.Distance", "30");
		SetVariable("r.RT.Fog.HistorySeconds", "0");
	}
	void LoadSpeck(float Irradiance = 0.0f)
	{
		FTestScene Scene("speck");
		Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Scene.AddLambert(glm::vec3(0.5f)), 0.01f, -50.0f)}));
		ASSERT_TRUE(Load(std::move(Scene.Scene)));
		SetSun(0.0, Irradiance, {0, -1, 0});
		SetSky(glm::vec3(0));
	}
	static FView LookNorth(uint32_t Width = 64, uint32_t Height = 40) { return LookAt({0, 0, 10}, {0, 0, 0}, 0.8f, Width, Height); }
	/// What lights without a range bring to a froxel, over the scattering coefficient, as the mean over its volume.
	static glm::dvec3 ComputeLight(
	    const FView& View, const FFogGrid& Grid, glm::uvec3 Froxel, const std::vector<FSceneLight>& Lights, double G)
	{
		constexpr int Steps = 4;
		glm::dvec3 Sum(0);
		for (int I = 0; I < Steps * Steps * Steps; ++I)
		{
			const glm::dvec3 Within(I % Steps, I / Steps % Steps, I / (Steps * Steps));
			const glm::dvec3 P = FroxelToWorld(View, Grid, glm::dvec3(Froxel) + (Within + 0.5) / double(Steps));
			for (const FSceneLight& Light : Lights)
			{
				const glm::dvec3 To = Light.Position - P;
				const double Squared = glm::dot(To, To);
				const double Ratio = Light.Range > 0.0f ? Squared / (double(Light.Range) * double(Light.Range)) : 0.0;
				if (Ratio >= 1.0) { continue; }
				const double Cosine = glm::dot(To, glm::normalize(P - View.Position)) / std::sqrt(Squared);
				Sum += glm::dvec3(Light.Color) * (ComputePhase(Cosine, G) * (1.0 - Ratio * Ratio) / Squared);
			}
		}
		return Sum / double(Steps * Steps * Steps);
	}
	/// Holds the mean of frames against ComputeLight, in froxels away from lights.
	void ExpectLight(const char* What, const std::vector<FSceneLight>& Lights, double G, double Tolerance)
	{
		GetEngine().Signals.FogPhase = float(G);
		const FView View = LookNorth();
		RenderFog(View, 4);
		const FFogPicture Fog = MeanFog(View, 32);
		EXPECT_TRUE(Fog.Visibility.empty()) << "there is no sun";
		double Ours = 0.0, Theirs = 0.0, Squares = 0.0;
		uint32_t Count = 0;
		Fog.ForEach([&](glm::uvec3 Froxel) {
			const glm::dvec3 P = FroxelToWorld(View, Fog.Grid, glm::dvec3(Froxel) + 0.5);
			for (const FSceneLight& Light : Lights)
			{
				if (glm::distance(P, Light.Position) < 2.5) { return; } // more than a froxel's radius
			}
			const double Expected = ComputeLight(View, Fog.Grid, Froxel, Lights, G).y, Got = double(Fog.GetLight(Froxel).y);
			Ours += Got;
			Theirs += Expected;
			Squares += (Got - Expected) * (Got - Expected) / (Expected * Expected + 1e-12);
			++Count;
		});
		PrintFigure(
		    fmt::format("{}: {:.5f} of the sum over {} froxels, RMS {:.4f}", What, Ours / Theirs, Count, std::sqrt(Squares / Count)));
		EXPECT_NEAR(Ours / Theirs, 1.0, Tolerance);
	}
};

TEST_F(FFogLightTest, LampsBringWhatTheyShould)
{
	ASSERT_NO_FATAL_FAILURE(LoadSpeck());
	FSceneLight Lamp;
	Lamp.Position = {1, 0.5, 0};
	Lamp.Color = glm::vec3(2, 3, 4);
	FLightId Id = GetWorld().AddLight(Lamp);
	ExpectLight("one lamp, isotropic", {Lamp}, 0.0, 0.002);
	ExpectLight("one lamp, forward", {Lamp}, 0.6, 0.002);
	std::vector<FSceneLight> Lamps{Lamp};
	for (int I = 0; I < 30; ++I)
	{
		FSceneLight Next;
		Next.Position = {6.0 * std::cos(2.4 * I), 3.0 * std::sin(1.7 * I), -12.0 + 0.6 * I};
		Next.Color = glm::vec3(1.0f + float(I % 3), 1.0f + float(I % 4), 2.0f);
		Next.Range = 6.0f;
		Lamps.push_back(Next);
		GetWorld().AddLight(Next);
	}
	ExpectLight("31 lamps, by light cells", Lamps, 0.3, 0.01);
	Lamp.bLightsFog = false;
	GetWorld().SetLight(Id, Lamp);
	Lamps.erase(Lamps.begin());
	ExpectLight("without the one that lights no fog", Lamps, 0.3, 0.01);
}

// A lamp within a froxel: the ball around it has the energy that 1/d² has there.
TEST_F(FFogLightTest, ALampWithinAFroxelKeepsItsEnergy)
{
	ASSERT_NO_FATAL_FAILURE(LoadSpeck());
	FSceneLight Lamp;
	Lamp.Position = {0.1, 0.05, 0};
	Lamp.Color = glm::vec3(1);
	GetWorld().AddLight(Lamp);
	GetEngine().Signals.FogPhase = 0.0f;
	const FView View = LookNorth();
	RenderFog(View, 2);
	const FFogPicture Fog = MeanFog(View, 256);
	// Over all froxels of a ball of radius R around the lamp, ∫ 1/(4π d²) dV = R.
	constexpr double Radius = 3.0;
	double Energy = 0.0, Brightest = 0.0;
	Fog.ForEach([&](glm::uvec3 Froxel) {
		const glm::dvec3 At(Froxel);
		const glm::dvec3 P = FroxelToWorld(View, Fog.Grid, At + 0.5);
		if (glm::distance(P, Lamp.Position) > Radius) { return; }
		const glm::dvec3 X =
		    FroxelToWorld(View, Fog.Grid, At + glm::dvec3(1, 0.5, 0.5)) - FroxelToWorld(View, Fog.Grid, At + glm::dvec3(0, 0.5, 0.5));
		const glm::dvec3 Y =
		    FroxelToWorld(View, Fog.Grid, At + glm::dvec3(0.5, 1, 0.5)) - FroxelToWorld(View, Fog.Grid, At + glm::dvec3(0.5, 0, 0.5));
		const glm::dvec3 Z =
		    FroxelToWorld(View, Fog.Grid, At + glm::dvec3(0.5, 0.5, 1)) - FroxelToWorld(View, Fog.Grid, At + glm::dvec3(0.5, 0.5, 0));
		const double Light = double(Fog.GetLight(Froxel).y);
		EXPECT_TRUE(std::isfinite(Light));
		Brightest = std::max(Brightest, Light);
		Energy += Light * std::abs(glm::dot(X, glm::cross(Y, Z)));
	});
	PrintFigure(fmt::format("energy within {} m: {:.4f} of the closed form; brightest froxel {:.3f}", Radius, Energy / Radius, Brightest));
	EXPECT_NEAR(Energy / Radius, 1.0, 0.05); // the ball is cut out by whole froxels
}

TEST_F(FFogLightTest, WallsShadowLamps)
{
	FTestScene Scene("screen");
	const int32_t Grey = Scene.AddLambert(glm::vec3(0.5f), glm::vec3(0), true);
	Scene.AddNode(Scene.AddMesh({{Grey, {{2, -40, -40}, {2, -40, 40}, {2, 40, 40}, {2, 40, -40}}}}));
	ASSERT_TRUE(Load(std::move(Scene.Scene)));
	SetSun(0.0, 0.0f);
	SetSky(glm::vec3(0));
	FSceneLight Lamp;
	Lamp.Position = {4, 0, 0};
	Lamp.Color = glm::vec3(100);
	FLightId Id = GetWorld().AddLight(Lamp);
	const FView View = LookNorth();
	const auto FindBrightest = [&] {
		const FFogPicture Fog = RenderFog(View, 4);
		double Brightest = 0.0;
		Fog.ForEach([&](glm::uvec3 Froxel) {
			bool bBehind = true;
			for (int Corner = 0; Corner < 8; ++Corner)
			{
				const glm::dvec3 At = glm::dvec3(Froxel) + glm::dvec3(Corner & 1, (Corner >> 1) & 1, Corner >> 2);
				bBehind = bBehind && FroxelToWorld(View, Fog.Grid, At).x < 2.0;
			}
			if (bBehind) { Brightest = std::max(Brightest, double(Fog.GetLight(Froxel).y)); }
		});
		return Brightest;
	};
	EXPECT_EQ(FindBrightest(), 0.0);
	Lamp.bCastsShadow = false;
	GetWorld().SetLight(Id, Lamp);
	EXPECT_GT(FindBrightest(), 0.1) << "a light without shadow shines through";
}

/// The sample engine's fog.
class FHeightFogTest : public FFogLightTest
{
protected:
	static constexpr double Density = 0.05, Falloff = 0.2, Level = -1.0, Albedo = 0.8, G = 0.4, Irradiance = 10.0;

	void SetUp() override
	{
		FFogLightTest::SetUp();
		SetVariable("r.Fog.Density", "0.05");
		SetVariable("r.Fog.HeightFalloff", "0.2");
		SetVariable("r.Fog.Height", "-1");
		SetVariable("r.Fog.Albedo", "0.8");
		SetVariable("r.Fog.Phase", "0.4");
	}
	/// Single scattering of the sun along a ray, by small steps. IsLit(P): whether the sun is seen.
	template <class TIsLit>
	static double Integrate(const glm::dvec3& From, const glm::dvec3& Direction, double End, const TIsLit& IsLit)
	{
		constexpr int Steps = 4000;
		double Depth = 0.0, Sum = 0.0;
		const double Source = Irradiance * ComputePhase(Direction.y, G);
		for (int I = 0; I < Steps; ++I)
		{
			const double Step = End / Steps;
			const glm::dvec3 P = From + Direction * ((I + 0.5) * Step);
			const double Extinction = Density * std::exp(-Falloff * (P.y - Level));
			Sum += IsLit(P) ? Source * Albedo * Extinction * Step * std::exp(-Depth - 0.5 * Extinction * Step) : 0.0;
			Depth += Extinction * Step;
		}
		return Sum;
	}
	static glm::dvec3 GetRay(const FView& View, uint32_t X, uint32_t Y)
	{
		FFogGrid Pixels{};
		Pixels.PixelSize = 1;
		Pixels.Slices = 1;
		Pixels.Distance = 1.0f;
		return glm::normalize(FroxelToWorld(View, Pixels, {X + 0.5, Y + 0.5, 1.0}) - View.Position);
	}
};

TEST_F(FHeightFogTest, UnshadowedFogIsTheClosedForm)
{
	ASSERT_NO_FATAL_FAILURE(LoadSpeck(float(Irradiance)));
	const FView View = LookAt({0, 2, 10}, {0, 4, 0}, 0.8f, 32, 20);
	for (const char* const Traced : {"0", "1"})
	{
		SetVariable("r.RT.Fog", Traced);
		const FImage Image = RenderLighting(View);
		double Worst = 0.0;
		for (uint32_t Y = 0; Y < 20; ++Y)
		{
			for (uint32_t X = 0; X < 32; ++X)
			{
				const glm::dvec3 Ray = GetRay(View, X, Y);
				if (Ray.y < 0.02) { continue; }
				// τ of the whole ray upwards; all that is taken out is scattered or absorbed.
				const double Depth = Density * std::exp(-Falloff * (View.Position.y - Level)) / (Falloff * Ray.y);
				const double Expected = Irradiance * ComputePhase(Ray.y, G) * Albedo * (1.0 - std::exp(-Depth));
				Worst = std::max(Worst, std::abs(double(Image.Pixels[(size_t(Y) * 32 + X) * 3 + 1]) / Expected - 1.0));
			}
		}
		PrintFigure(fmt::format("r.RT.Fog={}: off by {:.2e} at most", Traced, Worst));
		EXPECT_LT(Worst, 1e-3);
	}
}

TEST_F(FHeightFogTest, ABoxCastsItsShadowIntoTheFog)
{
	FTestScene Scene("box");
	const int32_t Black = Scene.AddLambert(glm::vec3(0), glm::vec3(0), true);
	Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Black, 2.0f, 6.0f), FTestScene::MakeFloor(Black, 2.0f, 5.0f)}));
	ASSERT_TRUE(Load(std::move(Scene.Scene)));
	SetSun(0.0, float(Irradiance), {0, -1, 0});
	SetSky(glm::vec3(0));
	SetVariable("r.RT.Fog.PixelSize", "4");
	SetVariable("r.RT.Fog.Slices", "128");
	const FView View = LookAt({0, 1, 12}, {0, 1.5, 0}, 0.5f, 64, 40);
	const auto IsLit = [](const glm::dvec3& P) { return P.y > 6.0 || std::abs(P.x) > 2.0 || std::abs(P.z) > 2.0; };
	FImage Mean;
	constexpr uint32_t Frames = 32;
	for (uint32_t Frame = 0; Frame < Frames; ++Frame)
	{
		const FImage Next = RenderLighting(View);
		if (Frame == 0) { Mean = Next; }
		for (size_t I = 0; I < Next.Pixels.size() && Frame > 0; ++I) { Mean.Pixels[I] += Next.Pixels[I]; }
	}
	const auto Compare = [&](const FImage& Image, double Scale) {
		double Worst = 0.0, Sum = 0.0, Truth = 0.0;
		uint32_t Shaded = 0;
		for (uint32_t Y = 0; Y < 40; ++Y)
		{
			for (uint32_t X = 0; X < 64; ++X)
			{
				const glm::dvec3 Ray = GetRay(View, X, Y);
				if (Ray.y < 0.02 || Ray.y > 0.2) { continue; } // neither the far end of the fog nor the box itself
				const double Expected = Integrate(View.Position, Ray, 300.0, IsLit);
				const double Lit = Integrate(View.Position, Ray, 300.0, [](const glm::dvec3&) { return true; });
				const double Got = double(Image.Pixels[(size_t(Y) * 64 + X) * 3 + 1]) * Scale;
				Sum += Got;
				Truth += Expected;
				Shaded += Expected < 0.9 * Lit ? 1 : 0;
				Worst = std::max(Worst, std::abs(Got - Expected) / Lit);
			}
		}
		EXPECT_GT(Shaded, 60u) << "there is no shadow";
		PrintFigure(fmt::format("fog under a box: {:.4f} of the integral, off by {:.4f} of the lit fog at most", Sum / Truth, Worst));
		return std::pair(Sum / Truth, Worst);
	};
	const auto [Ratio, Worst] = Compare(Mean, 1.0 / Frames);
	EXPECT_NEAR(Ratio, 1.0, 0.01);
	EXPECT_LT(Worst, 0.03);
	SetVariable("r.RT.Debug.Fog.Slice", "0");
	SetVariable("r.RT.Fog", "0");
	const auto [Unshadowed, Off] = Compare(RenderLighting(View), 1.0);
	EXPECT_GT(Off, 0.1) << "without shadows the test must fail";
	EXPECT_GT(Unshadowed, 1.02);
}

} // namespace
} // namespace Lantern
