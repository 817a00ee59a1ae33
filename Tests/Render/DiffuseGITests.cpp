// Brute-force diffuse global illumination: closed forms of paths of so many bounces, the reference, and nothing that is not
// a number.
#include <cmath>

#include "SignalFixture.h"

namespace Lantern
{

namespace
{

class FDiffuseGITest : public FSignalTest
{};

// Le (1 + ρ + … + ρ^bounces) from everywhere.
TEST_F(FDiffuseGITest, FurnaceOfSoManyBounces)
{
	ASSERT_TRUE(Load("furnace:0.5"));
	SetVariable("r.RT.Lights.Emissive", "0"); // local lights would have the walls' own light
	const FView View = MakeView(32, 32);
	for (const int32_t Bounces : {1, 2, 4})
	{
		SetIndirect(4, Bounces);
		const double Expected = 0.5 * (1.0 - std::pow(0.5, Bounces + 1)) / 0.5;
		ExpectClosedForm(fmt::format("furnace, {} bounces", Bounces).c_str(), EstimateFrames(ESignal::DiffuseGI, View, 4), Expected, 0.005);
	}
}

// Φ/S (ρ + … + ρ^bounces) / π: the point light's own light is not in it.
TEST_F(FDiffuseGITest, SphereOfSoManyBounces)
{
	ASSERT_TRUE(Load("sphere:0.5"));
	const FView View = MakeView(32, 32);
	for (const int32_t Bounces : {1, 3})
	{
		SetIndirect(4, Bounces);
		const double Expected = 10000.0 / 96.0 * (1.0 - std::pow(0.5, Bounces)) / Pi;
		ExpectClosedForm(fmt::format("sphere, {} bounces", Bounces).c_str(), EstimateFrames(ESignal::DiffuseGI, View, 2), Expected, 0.005);
	}
}

TEST_F(FDiffuseGITest, CornellAsTheReference)
{
	REQUIRE_SCENE(Scene, "cornell/cornell.gltf");
	ASSERT_TRUE(Load(Scene));
	for (const int32_t Bounces : {1, 4})
	{
		SetIndirect(16, Bounces);
		const uint32_t Events = static_cast<uint32_t>(Bounces) + 1;
		ExpectUnbiased(fmt::format("cornell GI, {} bounces", Bounces).c_str(), ESignal::DiffuseGI, MakeView(48, 48), 3, 48, Events, 0.01);
	}
}

using FDiffuseGISlowTest = FDiffuseGITest;

// Without alpha tests: raster asks coarser levels of the texture than rays do, and sees through leaves that the reference's
// camera rays hit. That is 5 % of this picture's light, and not the pass's.
TEST_F(FDiffuseGISlowTest, CourtyardAsTheReference)
{
	ASSERT_TRUE(Load("courtyard"));
	SetVariable("r.RT.AlphaTest", "0");
	SetIndirect(16, 2);
	SetVariable("r.RT.Reflections", "0");
	ExpectUnbiased("courtyard GI", ESignal::DiffuseGI, MakeView(64, 36), 1, 16, 3, 0.01);
}

// In a closed room each path has a ray to each surface, and from each that reflects one to the lamp.
TEST_F(FDiffuseGITest, RaysOfPathsAreCounted)
{
	ASSERT_TRUE(Load("sphere:0.5"));
	SetVariable("r.RT.Reflections", "0");
	SetVariable("r.RT.Rays.CountPaths", "1");
	constexpr uint32_t Pixels = 32 * 24;
	for (const uint32_t Bounces : {1u, 2u})
	{
		SetIndirect(2, int32_t(Bounces));
		RenderSignal(ESignal::DiffuseGI, MakeView(32, 24), 1);
		EXPECT_OK(GetEngine().GetRenderer().WaitForAll());
		const FPathRayCounts Counts = GetEngine().GetRenderer().GetPathRayCounts();
		EXPECT_EQ(Counts.Surfaces, 2 * Pixels * (Bounces + 1)) << Bounces;
		EXPECT_EQ(Counts.Lights, 2 * Pixels * Bounces) << Bounces;
	}
	SetVariable("r.RT.Rays.CountPaths", "0");
}

// Frames go on where the last one ended, and draw the same again for the same index and seed.
TEST_F(FDiffuseGITest, SamplesFollowFrameAndSeed)
{
	ASSERT_TRUE(Load("furnace:0.5"));
	SetIndirect(1, 1);
	FView View = MakeView(24, 24);
	const FImage First = RenderSignal(ESignal::DiffuseGI, View, 1, 5);
	EXPECT_EQ(First.Pixels, RenderSignal(ESignal::DiffuseGI, View, 1, 5).Pixels);
	EXPECT_GT(FractionDiffering(First, RenderSignal(ESignal::DiffuseGI, View, 1, 6), 0.0), 0.2);
	View.Seed = 9;
	EXPECT_GT(FractionDiffering(First, RenderSignal(ESignal::DiffuseGI, View, 1, 5), 0.0), 0.2);
}

TEST_F(FDiffuseGITest, NothingWithoutLightNorWhenOff)
{
	ASSERT_TRUE(Load("furnace:0.5"));
	const FView View = MakeView(16, 16);
	EXPECT_FALSE(HasSignal(ESignal::DiffuseGI, View)); // off by default
	EXPECT_FALSE(HasSignal(ESignal::Reflections, View));
	SetIndirect(1, 1);
	EXPECT_TRUE(HasSignal(ESignal::DiffuseGI, View));
	EXPECT_TRUE(HasSignal(ESignal::Reflections, View));
	SetVariable("r.RT.Enable", "0");
	EXPECT_FALSE(HasSignal(ESignal::DiffuseGI, View));
	SetVariable("r.RT.Enable", "1");
	FTestScene Dark("dark");
	Dark.AddNode(Dark.AddMesh({FTestScene::MakeFloor(Dark.AddLambert(glm::vec3(0.5f)), 1.0f)}));
	ASSERT_TRUE(Load(std::move(Dark.Scene)));
	EXPECT_FALSE(HasSignal(ESignal::DiffuseGI, View));
	EXPECT_FALSE(HasSignal(ESignal::Reflections, View));
	SetSky(glm::vec3(1));
	EXPECT_TRUE(HasSignal(ESignal::DiffuseGI, View));
}

// What makes careless shaders divide by zero: mirrors, surfaces seen edge-on, normals that face away, triangles without
// area, some of them lights; under a sun whose light alone is more than fp16 holds.
FSceneDescription MakeHostileScene()
{
	FTestScene Hostile("hostile");
	FHostMaterial Mirror;
	Mirror.Roughness = 0.0f;
	FHostMaterial Glass = Mirror;
	Glass.Metallic = 0.0f;
	FHostMaterial Glow = Glass;
	Glow.Emissive = glm::vec3(3.0e6f);
	Glow.bDoubleSided = true;
	const int32_t Mirrors = Hostile.AddMaterial(Mirror), Glasses = Hostile.AddMaterial(Glass), Glows = Hostile.AddMaterial(Glow);
	const int32_t Bumpy = Hostile.AddBumpyLambert(glm::vec3(1));
	const auto MakeWall = [](int32_t Material, float Z) {
		return FTestScene::FQuad{Material, {{-2, 0, Z}, {2, 0, Z}, {2, 2, Z}, {-2, 2, Z}}};
	};
	const int32_t Mesh = Hostile.AddMesh({FTestScene::MakeFloor(Mirrors, 3.0f), MakeWall(Glasses, -2.0f), MakeWall(Bumpy, -2.5f),
	    FTestScene::MakeFloor(Glows, 0.2f, 1.5f), FTestScene::MakeFloor(Bumpy, 0.5f, 0.4f, {1, 1})});
	// Corners that fall together: no area, and a normal that is none.
	FHostMesh& Broken = Hostile.Scene.Meshes[size_t(Mesh)];
	const FHostSection Light = Broken.Sections[3];
	for (uint32_t I = 0; I < 3; ++I) { Broken.Indices[Light.FirstIndex + I] = Broken.Indices[Light.FirstIndex]; }
	Hostile.AddNode(Mesh);
	return std::move(Hostile.Scene);
}

TEST_F(FDiffuseGITest, HostileSceneStaysFinite)
{
	ASSERT_TRUE(Load(MakeHostileScene()));
	SetSun(0.0, 1.0e6f, {0.1, -1, -0.2});
	SetSky(glm::vec3(1.0e5f));
	SetIndirect(4, 4);
	for (const glm::dvec3 Eye : {glm::dvec3(0, 1, 3), glm::dvec3(0, 1e-3, 3), glm::dvec3(2.9, 0.4 + 1e-4, 1)})
	{
		const FView View = LookAt(Eye, {0, 0.4, 0}, 1.0f, 64, 48);
		for (const ESignal Signal : {ESignal::DiffuseGI, ESignal::Reflections, ESignal::Frame})
		{
			const FImage Picture = RenderSignal(Signal, View, 2);
			EXPECT_EQ(CountNonFinitePixels(Picture), 0u) << GetSignalInfo(Signal).Name;
			EXPECT_GT(ComputeMeans(Picture).MaxLuminance, 1.0e4) << GetSignalInfo(Signal).Name;
		}
		for (const ESignal Signal : {ESignal::DiffuseGI, ESignal::Reflections})
		{
			EXPECT_EQ(CountNonFinitePixels(TraceSignal(Signal, View, 8)), 0u) << "reference, " << GetSignalInfo(Signal).Name;
		}
	}
	// So much light that sums of it overflow fp32 itself.
	SetSun(0.0, 3.0e38f, {0.1, -1, -0.2});
	SetSky(glm::vec3(3.0e38f));
	for (const ESignal Signal : {ESignal::DiffuseGI, ESignal::Reflections})
	{
		const FImage Picture = RenderSignal(Signal, LookAt({0, 1, 3}, {0, 0.4, 0}, 1.0f, 64, 48), 2);
		EXPECT_EQ(CountNonFinitePixels(Picture), 0u) << GetSignalInfo(Signal).Name;
	}
}

} // namespace
} // namespace Lantern
