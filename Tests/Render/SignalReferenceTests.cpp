// The reference of each signal: closed forms, and how signals add up to the frame.
#include <algorithm>
#include <cmath>

#include "SignalFixture.h"
#include "Support/SharedFiles.h"

namespace Lantern
{

namespace
{

class FSignalReferenceTest : public FSignalTest
{};

// A floor under a ceiling at height h, falloff 1 − (d/R)². With k = (h/R)²: what is seen is k (1 − ln k).
TEST_F(FSignalReferenceTest, AmbientOcclusionUnderACeiling)
{
	FTestScene Pair("ceiling");
	const int32_t Grey = Pair.AddLambert(glm::vec3(0.5f), glm::vec3(0), true);
	Pair.AddNode(Pair.AddMesh({FTestScene::MakeFloor(Grey, 100.0f), FTestScene::MakeFloor(Grey, 100.0f, 1.0f)}));
	ASSERT_TRUE(Load(std::move(Pair.Scene)));
	const FView View = LookAt({0, 0.8, 0}, {0.2, 0, 0}, 0.3f, 24, 24);
	for (const double Radius : {1.25, 2.0, 4.0})
	{
		SetVariable("r.RT.AO.Radius", std::to_string(Radius));
		const double K = 1.0 / (Radius * Radius);
		ExpectClosedForm(fmt::format("ceiling, radius {}", Radius).c_str(), EstimateSignal(ESignal::AmbientOcclusion, View, 256),
		    K * (1.0 - std::log(K)), 0.005);
	}
	SetVariable("r.RT.AO.Radius", "0.9"); // out of reach
	EXPECT_DOUBLE_EQ(MeanGreen(TraceSignal(ESignal::AmbientOcclusion, View, 16)), 1.0);
}

// Beside an endless wall half of the hemisphere is blocked, wherever one stands.
TEST_F(FSignalReferenceTest, AmbientOcclusionBesideAWall)
{
	FTestScene Pair("wall");
	const int32_t Grey = Pair.AddLambert(glm::vec3(0.5f), glm::vec3(0), true);
	constexpr float Far = 4000.0f;
	Pair.AddNode(Pair.AddMesh(
	    {FTestScene::MakeFloor(Grey, 10.0f), {Grey, {{-0.5f, 0, -Far}, {-0.5f, 0, Far}, {-0.5f, Far, Far}, {-0.5f, Far, -Far}}}}));
	ASSERT_TRUE(Load(std::move(Pair.Scene)));
	SetVariable("r.RT.AO.Radius", "1000000");
	ExpectClosedForm("wall", EstimateSignal(ESignal::AmbientOcclusion, LookAt({0.5, 1, 0}, {0, 0, 0}, 0.3f, 24, 24), 128), 0.5, 0.005);
}

// A half-plane at height 1 over the floor: below its edge half of the disk is seen; far to either side all or nothing.
TEST_F(FSignalReferenceTest, SunShadowOfAHalfPlane)
{
	FTestScene Pair("half-plane");
	const int32_t Grey = Pair.AddLambert(glm::vec3(0.5f), glm::vec3(0), true);
	Pair.AddNode(Pair.AddMesh({FTestScene::MakeFloor(Grey, 10.0f), {Grey, {{-20, 1, -20}, {-20, 1, 20}, {0, 1, 20}, {0, 1, -20}}}}));
	ASSERT_TRUE(Load(std::move(Pair.Scene)));
	SetSun(10.0, 4.0f, {0, -1, 0});
	const auto Estimate = [&](double X) {
		return EstimateSignal(ESignal::SunShadow, LookAt({X + 1e-4, 0.9, 1}, {X, 0, 0}, 0.001f, 16, 16), 64);
	};
	ExpectClosedForm("below the edge", Estimate(0.0), 0.5, 0.01);
	// A segment of the disk: x = h tan r · c leaves (acos(−c) + c √(1 − c²)) / π of it.
	const double C = 0.5, Tan = std::tan(glm::radians(5.0));
	ExpectClosedForm("half a radius out", Estimate(C * Tan), (std::acos(-C) + C * std::sqrt(1.0 - C * C)) / Pi, 0.01);
	EXPECT_EQ(Estimate(0.2).Mean, 1.0);
	EXPECT_EQ(Estimate(-0.2).Mean, 0.0);
	SetSun(10.0, 4.0f, {0, 1, 0}); // from below
	EXPECT_EQ(Estimate(0.2).Mean, 0.0);
}

// In a closed furnace the same comes from everywhere: L = Le / (1 − ρ).
TEST_F(FSignalReferenceTest, FurnaceGI)
{
	SetVariable("r.RT.Lights.Emissive", "0"); // local lights would have the walls' own light
	for (const double Albedo : {0.5, 0.9})
	{
		ASSERT_TRUE(Load(fmt::format("furnace:{}", Albedo)));
		const FEstimate Estimate = EstimateSignal(ESignal::DiffuseGI, MakeView(32, 32), Albedo > 0.8 ? 48 : 16);
		ExpectClosedForm(fmt::format("furnace GI, albedo {}", Albedo).c_str(), Estimate, 0.5 / (1.0 - Albedo), 0.005);
	}
}

// Inside a sphere about a point light: indirect irradiance Φ/S · ρ/(1 − ρ). The light itself is not in the signal.
TEST_F(FSignalReferenceTest, SphereGI)
{
	for (const double Albedo : {0.2, 0.7})
	{
		ASSERT_TRUE(Load(fmt::format("sphere:{}", Albedo)));
		const FEstimate Estimate = EstimateSignal(ESignal::DiffuseGI, MakeView(32, 32), 16);
		ExpectClosedForm(
		    fmt::format("sphere GI, albedo {}", Albedo).c_str(), Estimate, 10000.0 / 96.0 * Albedo / (1.0 - Albedo) / Pi, 0.005);
	}
}

// The disk of the sun is direct lighting's: alone over a plane it leaves neither signal anything. A sky comes whole.
TEST_F(FSignalReferenceTest, SunIsNotIndirectSkyIs)
{
	ASSERT_TRUE(Load("ggx:1:0.7"));
	SetSky(glm::vec3(0));
	SetSun(20.0, 4.0f, {0, -0.7, -0.7});
	const FView View = MakeView(16, 16);
	EXPECT_EQ(MeanGreen(TraceSignal(ESignal::DiffuseGI, View, 64)), 0.0);
	EXPECT_EQ(MeanGreen(TraceSignal(ESignal::Reflections, View, 64)), 0.0);
	SetSky(glm::vec3(2));
	EXPECT_NEAR(MeanGreen(TraceSignal(ESignal::DiffuseGI, View, 8)), 2.0, 1e-4);
	const double Mu = 0.7;
	ExpectClosedForm("white metal of α = 1 under a sky", EstimateSignal(ESignal::Reflections, View, 64),
	    2.0 * (1.0 - Mu * std::log(1.0 + 1.0 / Mu)), 0.005);
}

// Where all is a Lambert of 0.5 and neither sun nor punctual lights shine: frame = emission + (GI + direct light of emitters) / 2, and no
// reflections. Without light sampling of emitters, GI has all.
TEST_F(FSignalReferenceTest, SignalsAddUp)
{
	REQUIRE_SCENE(Scene, "cornell/cornell.gltf");
	ASSERT_TRUE(Load(Scene));
	SetVariable("r.RT.Material.Override", "2");
	const FView View = MakeView(24, 24);
	const double Emission = MeanGreen(TraceSignal(ESignal::Frame, View, 1, 0));
	const FEstimate Frame = EstimateSignal(ESignal::Frame, View, 64);
	for (const bool bDirect : {false, true})
	{
		SetVariable("r.RT.Lights.Emissive", bDirect ? "1" : "0");
		const FEstimate GI = EstimateSignal(ESignal::DiffuseGI, View, 64), Local = EstimateSignal(ESignal::LocalDiffuse, View, 64);
		const double Sum = Emission + 0.5 * (GI.Mean + Local.Mean);
		const double Sigma = std::hypot(Frame.StandardError, 0.5 * GI.StandardError, 0.5 * Local.StandardError);
		PrintFigure(
		    fmt::format("cornell of 0.5: frame {:.5f}, emission + (GI {:.5f} + direct {:.5f}) / 2 {:.5f} (statistical error {:.5f})",
		        Frame.Mean, GI.Mean, Local.Mean, Sum, Sigma));
		EXPECT_NEAR(Frame.Mean, Sum, 3.5 * Sigma);
		EXPECT_LT(Sigma, 0.01 * Frame.Mean);
		EXPECT_GT(0.5 * (GI.Mean + Local.Mean), 0.2 * Frame.Mean);
		EXPECT_EQ(Local.Mean > 0.0, bDirect);
	}
	EXPECT_EQ(MeanGreen(TraceSignal(ESignal::Reflections, View, 16)), 0.0);
}

TEST_F(FSignalReferenceTest, ChannelsSkyAndPixelCenters)
{
	ASSERT_TRUE(Load("emptysky"));
	const FView View = MakeView(8, 6);
	for (const ESignal Signal : {ESignal::SunShadow, ESignal::AmbientOcclusion, ESignal::DiffuseGI, ESignal::Reflections})
	{
		const FImage Picture = TraceSignal(Signal, View, 2);
		EXPECT_EQ(Picture.Channels, GetSignalInfo(Signal).Channels);
		EXPECT_EQ(MeanGreen(Picture), GetSignalInfo(Signal).bRadiance ? 0.0 : 1.0) << GetSignalInfo(Signal).Name;
	}
	// The edge of a lamp: through centres every sample of a pixel sees the same, else some pixels see both sides.
	FTestScene Lamp("lamp");
	Lamp.AddNode(Lamp.AddMesh({FTestScene::MakeFloor(Lamp.AddLambert(glm::vec3(0), glm::vec3(1), true), 1.0f)}));
	ASSERT_TRUE(Load(std::move(Lamp.Scene)));
	for (const bool bCenters : {true, false})
	{
		FReferenceSettings Settings;
		Settings.View = LookAt({0.3, 4, 0.1}, {0.1, 0, 0}, 0.8f, 32, 32);
		Settings.Samples = 8;
		Settings.Bounces = 0;
		Settings.bPixelCenters = bCenters;
		FReferenceResult Result;
		ASSERT_OK(RenderReference(GetEngine(), Settings, Result));
		const auto IsBetween = [](float Value) { return Value > 1e-3f && Value < 0.999f; };
		const auto Between = std::count_if(Result.Radiance.Pixels.begin(), Result.Radiance.Pixels.end(), IsBetween);
		EXPECT_EQ(Between == 0, bCenters) << Between;
	}
}

TEST_F(FSignalReferenceTest, StateOfAnotherSignalIsRefused)
{
	ASSERT_TRUE(Load("furnace"));
	const FTemporaryFolder Folder;
	FReferenceSettings Settings;
	Settings.View = MakeView(16, 16);
	Settings.Samples = 2;
	Settings.Bounces = 2;
	Settings.Signal = ESignal::DiffuseGI;
	Settings.StateFile = Folder / "signal.state";
	FReferenceResult Result;
	ASSERT_OK(RenderReference(GetEngine(), Settings, Result));
	Settings.bResume = true;
	Settings.Samples = 4;
	FReferenceSettings Other = Settings;
	Other.Signal = ESignal::Reflections;
	EXPECT_EQ(RenderReference(GetEngine(), Other, Result).Code, ERTResult::InvalidArgument);
	Other = Settings;
	Other.bPixelCenters = true;
	EXPECT_EQ(RenderReference(GetEngine(), Other, Result).Code, ERTResult::InvalidArgument);
	ASSERT_OK(RenderReference(GetEngine(), Settings, Result));
	EXPECT_EQ(Result.ResumedSamples, 2u);
}

} // namespace
} // namespace Lantern
