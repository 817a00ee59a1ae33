// Reflections by brute force and by paths that end in radiance cells, and the composite of all signals against the reference.
#include <cmath>

#include "SignalFixture.h"

namespace Lantern
{

namespace
{
class FReflectionsTest : public FSignalTest
{
protected:
	/// A plane of one material under a sky of 1, seen at a cosine from so far away that all pixels see the same.
	[[nodiscard]] bool LoadPlane(float Metallic, float Roughness, double Mu)
	{
		FTestScene Plane("plane");
		FHostMaterial Material;
		Material.Metallic = Metallic;
		Material.Roughness = Roughness;
		Plane.AddNode(Plane.AddMesh({FTestScene::MakeFloor(Plane.AddMaterial(Material), 2.0f)}));
		if (!Load(std::move(Plane.Scene))) { return false; }
		SetSky(glm::vec3(1));
		const double Sin = std::sqrt(1.0 - Mu * Mu);
		PlaneView = LookAt(4.0 * glm::dvec3(0, Mu, Sin), {0, 0, 0}, glm::radians(0.05f), 32, 32);
		return true;
	}
	FView PlaneView;
};

// A mirror of F = 1 shows what is there: a lamp, and the sky beside it.
TEST_F(FReflectionsTest, MirrorShowsWhatIsThere)
{
	FTestScene Pair("mirror");
	FHostMaterial Mirror;
	Mirror.Roughness = 0.0f;
	const int32_t Metal = Pair.AddMaterial(Mirror), Lamp = Pair.AddLambert(glm::vec3(0), glm::vec3(7), true);
	Pair.AddNode(Pair.AddMesh({FTestScene::MakeFloor(Metal, 2.0f), FTestScene::MakeFloor(Lamp, 0.5f, 1.0f, {0, -1})}));
	ASSERT_TRUE(Load(std::move(Pair.Scene)));
	SetSky(glm::vec3(0.25f));
	SetIndirect(1, 1);
	const auto SetRoute = [](const char* Route, const char* Path) {
		SetVariable("r.RT.Reflections", Route);
		SetVariable("r.RT.Reflections.Path", Path);
	};
	// From (0, 1, 1) over the mirror at (0, 0, 0) the ray goes up to (0, 1, −1), the middle of the lamp; at (0, 0, 0.45) it
	// passes the lamp.
	const auto Look = [](double Z) { return LookAt({0, 1, 1}, {0, 0, Z}, 0.02f, 16, 16); };
	for (const auto& [Route, Path] : {std::pair("2", "0"), std::pair("1", "1"), std::pair("1", "2")})
	{
		SetRoute(Route, Path);
		EXPECT_NEAR(MeanGreen(RenderSignal(ESignal::Reflections, Look(0.0))), 7.0, 0.02) << Route << Path;
		EXPECT_NEAR(MeanGreen(RenderSignal(ESignal::Reflections, Look(0.45))), 0.25, 0.001) << Route << Path;
	}
	EXPECT_NEAR(MeanGreen(TraceSignal(ESignal::Reflections, Look(0.0), 2)), 7.0, 0.02);
}

// Case 19: what a white surface gives back of a sky of 1, at every roughness. The frame's whole, through the G-buffer and the
// composite, is the reference's whole within 1 %; where it is known in closed form, that too.
TEST_F(FReflectionsTest, FurnaceOfMetalsAndDielectrics)
{
	for (const double Mu : {0.3, 0.8})
	{
		for (const float Metallic : {0.0f, 1.0f})
		{
			for (const float Roughness : {0.0f, 0.05f, 0.2f, 0.5f, 1.0f})
			{
				ASSERT_TRUE(LoadPlane(Metallic, Roughness, Mu));
				SetIndirect(16, 1);
				const std::string Name = fmt::format("{} of roughness {}, mu {}", Metallic > 0.5f ? "metal" : "dielectric", Roughness, Mu);
				const FEstimate Reference = EstimateSignal(ESignal::Frame, PlaneView, 24, 1, 4);
				for (const char* const Route : {"1", "2"})
				{
					SetVariable("r.RT.Reflections", Route);
					const FEstimate Frame = EstimateFrames(ESignal::Frame, PlaneView, 1, 4);
					const double Sigma = std::hypot(Frame.StandardError, Reference.StandardError) / Reference.Mean;
					PrintFigure(fmt::format("{}, route {}: frame {:.5f}, reference {:.5f}: {:+.3f} % (statistical error {:.3f} %)", Name,
					    Route, Frame.Mean, Reference.Mean, 100.0 * (Frame.Mean / Reference.Mean - 1.0), 100.0 * Sigma));
					EXPECT_NEAR(Frame.Mean / Reference.Mean, 1.0, 0.01) << Name << ", route " << Route;
					EXPECT_LT(Sigma, 0.003) << Name;
					if (Metallic > 0.5f && Roughness == 0.0f) { EXPECT_NEAR(Frame.Mean, 1.0, 0.002); }
					if (Metallic > 0.5f && Roughness == 1.0f) { EXPECT_NEAR(Frame.Mean, 1.0 - Mu * std::log(1.0 + 1.0 / Mu), 0.01); }
				}
			}
		}
	}
}

TEST_F(FReflectionsTest, CornellAsTheReference)
{
	REQUIRE_SCENE(Scene, "cornell/cornell.gltf");
	ASSERT_TRUE(Load(Scene));
	SetIndirect(16, 4);
	if (MeanGreen(TraceSignal(ESignal::Reflections, MakeView(16, 16), 8)) > 0.0)
	{
		ExpectUnbiased("cornell reflections", ESignal::Reflections, MakeView(48, 48), 3, 48, 5, 0.01);
	}
	ExpectUnbiased("cornell, the whole frame", ESignal::Frame, MakeView(48, 48), 3, 48, 5, 0.01);
}

// Spheres of roughness 0 to 1, as metal and as dielectric. Triangles, no textures: both see the same surfaces.
TEST_F(FReflectionsTest, SpheresAsTheReference)
{
	REQUIRE_SCENE(Scene, "roughness/scene.gltf");
	ASSERT_TRUE(Load(Scene));
	SetSky({0.6f, 0.7f, 0.8f});
	SetSun(0.533);
	SetIndirect(16, 2);
	SetVariable("r.RT.GI", "0");
	ExpectUnbiased("spheres, reflections", ESignal::Reflections, MakeView(96, 54), 2, 32, 3, 0.01);
}

// Above it the sky's ambient light stands in, and the signal holds just that.
TEST_F(FReflectionsTest, RougherThanMaxRoughness)
{
	ASSERT_TRUE(LoadPlane(1.0f, 0.5f, 0.7));
	SetIndirect(4, 1);
	EXPECT_GT(
	    FractionDiffering(RenderSignal(ESignal::Reflections, PlaneView), RenderSignal(ESignal::Reflections, PlaneView, 1, 7), 0.0), 0.5);
	SetVariable("r.RT.Reflections.MaxRoughness", "0.4");
	const FImage Signal = RenderSignal(ESignal::Reflections, PlaneView);
	EXPECT_EQ(FractionDiffering(Signal, RenderSignal(ESignal::Reflections, PlaneView, 1, 7), 0.0), 0.0) << "no noise: nothing was traced";
	EXPECT_GT(MeanGreen(Signal), 0.5);
	// Paths of diffuse GI see the same sky, as far as the fit of the albedo goes (SpecularAlbedo, 2.3 %).
	EXPECT_NEAR(MeanGreen(RenderSignal(ESignal::Frame, PlaneView, 8)) / MeanGreen(Signal), 1.0, 0.025);
	SetVariable("r.RT.GI.RoughSpecular", "0");
	const double Composite = MeanGreen(RenderSignal(ESignal::Frame, PlaneView));
	EXPECT_NEAR(Composite, MeanGreen(Signal), 0.002);
	SetVariable("r.RT.SkyAmbient", "0");
	EXPECT_NEAR(MeanGreen(RenderSignal(ESignal::Frame, PlaneView)), Composite, 0.05 * Composite) << "the lobe takes diffuse GI's light";
	SetVariable("r.RT.GI", "0");
	EXPECT_EQ(MeanGreen(RenderSignal(ESignal::Frame, PlaneView)), 0.0);
}

} // namespace
} // namespace Lantern
