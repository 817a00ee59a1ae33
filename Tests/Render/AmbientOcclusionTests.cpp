// The plugin's ambient occlusion against closed forms, one path against the other, and against the path tracer's.
#include <cmath>
#include <functional>

#include "LanternImage/ImageStatistics.h"
#include "Support/RenderFixture.h"
#include "Support/TestScene.h"

namespace Lantern
{

namespace
{

/// 1 − (d / R)² blocked by what is at distance d.
double Visible(double Distance, double Radius) { return std::min(1.0, Distance * Distance / (Radius * Radius)); }

/// Visibility over the hemisphere by the midpoint rule on the unit disk, on which cosine-weighted directions are uniform.
/// Distance: along (x, y up, z), to the nearest surface; infinite where there is none.
double IntegrateOcclusion(double Radius, const std::function<double(glm::dvec3)>& Distance)
{
	constexpr int Rings = 400, Sectors = 800;
	double Sum = 0.0;
	for (int I = 0; I < Rings; ++I)
	{
		const double R = std::sqrt((I + 0.5) / Rings);
		for (int J = 0; J < Sectors; ++J)
		{
			const double Phi = 2.0 * Pi * (J + 0.5) / Sectors;
			Sum += Visible(Distance({R * std::cos(Phi), std::sqrt(1.0 - R * R), R * std::sin(Phi)}), Radius);
		}
	}
	return Sum / (double(Rings) * Sectors);
}

/// On a floor at distance K · R from an endless wall.
double BesideWall(double K)
{
	if (K >= 1.0) { return 1.0; }
	// ∫ 2 √(1 − x²) (1 − K²/x²) dx over the disk's chords from K to 1.
	const auto F = [&](double X) {
		const double Y = std::sqrt(std::max(0.0, 1.0 - X * X));
		return X * Y + std::asin(X) + 2.0 * K * K * (Y / X + std::asin(X));
	};
	return 1.0 - (F(1.0) - F(K)) / Pi;
}

/// Under an endless ceiling at height K · R: ∫ 2u min(K²/u², 1) du.
double UnderCeiling(double K) { return K >= 1.0 ? 1.0 : K * K * (1.0 - 2.0 * std::log(K)); }

class FAmbientOcclusionTest : public FRenderTest
{
protected:
	void SetUp() override
	{
		FRenderTest::SetUp();
		SetVariable("r.RT.AO.Denoise", "0");
		SetVariable("r.RT.AO.Samples", "16");
		SetVariable("r.RT.AO.Radius", "1");
	}

	/// Mean over frames First … First + Count − 1; asked for, so that no sky is needed.
	static FImage RenderOcclusion(const FView& View, uint32_t Count = 1, uint32_t First = 0)
	{
		return RenderSignal(ESignal::AmbientOcclusion, View, Count, First);
	}

	/// From above, Size metres of the floor across, x to the right and z down.
	static FView MakePlan(glm::dvec3 Center, double Size, uint32_t Pixels, double Height = 20.0)
	{
		FView View =
		    LookAt(Center + glm::dvec3(0, Height, 0), Center, static_cast<float>(2.0 * std::atan(0.5 * Size / Height)), Pixels, Pixels);
		View.Up = {0, 0, -1};
		return View;
	}

	static double MeanOfColumn(const FImage& Image, uint32_t X)
	{
		double Sum = 0.0;
		for (uint32_t Y = 0; Y < Image.Height; ++Y) { Sum += Image.At(X, Y, 0) / Image.Height; }
		return Sum;
	}

	/// A floor, a wall at x = 0 facing +x, and one at z = 0 facing +z if wanted. Higher than any radius used.
	static FSceneDescription MakeWalls(bool bCorner)
	{
		FTestScene Walls("walls");
		const int32_t Lambert = Walls.AddLambert(glm::vec3(0.5f));
		std::vector<FTestScene::FQuad> Quads = {FTestScene::MakeFloor(Lambert, 8.0f)};
		Quads.push_back({Lambert, {{0, 0, 8}, {0, 0, -8}, {0, 4, -8}, {0, 4, 8}}});
		if (bCorner) { Quads.push_back({Lambert, {{-8, 0, 0}, {8, 0, 0}, {8, 4, 0}, {-8, 4, 0}}}); }
		Walls.AddNode(Walls.AddMesh(Quads));
		return std::move(Walls.Scene);
	}

	static FSceneDescription MakeCeiling(float Height, bool bCut = false)
	{
		FTestScene Ceiling("ceiling");
		const int32_t Lambert = Ceiling.AddLambert(glm::vec3(0.5f), glm::vec3(0), true);
		Ceiling.AddNode(Ceiling.AddMesh({FTestScene::MakeFloor(Lambert, 8.0f)}));
		const int32_t Above = bCut ? Ceiling.AddHalfCutLambert() : Lambert;
		Ceiling.AddNode(Ceiling.AddMesh({FTestScene::MakeFloor(Above, 4.0f, Height)}));
		return std::move(Ceiling.Scene);
	}
	/// Between floor and ceiling: Size metres of the floor around a place.
	static FView MakeViewUnder(glm::dvec3 Center, double Size, uint32_t Pixels) { return MakePlan(Center, Size, Pixels, 0.2); }
};

TEST_F(FAmbientOcclusionTest, OpenFloorIsUnoccluded)
{
	FTestScene Flat("flat");
	Flat.AddNode(Flat.AddMesh({FTestScene::MakeFloor(Flat.AddLambert(glm::vec3(0.5f)), 500.0f)}));
	ASSERT_TRUE(Load(std::move(Flat.Scene)));
	for (const char* Path : {"1", "2"})
	{
		SetVariable("r.RT.AO.Path", Path);
		for (const char* Radius : {"0.01", "2", "1000"})
		{
			SetVariable("r.RT.AO.Radius", Radius);
			for (const double Height : {0.3, 5.0, 300.0})
			{
				const FView View = LookAt({0.3, Height, 0.2}, {3.0 * Height, 0, 0.5 * Height}, 1.2f, 96, 64);
				EXPECT_EQ(MeanGreen(RenderOcclusion(View)), 1.0) << "radius " << Radius << ", camera at " << Height << ", path " << Path;
			}
		}
	}
}

TEST_F(FAmbientOcclusionTest, BesideAWall)
{
	ASSERT_TRUE(Load(MakeWalls(false)));
	for (const char* Path : {"1", "2"})
	{
		SetVariable("r.RT.AO.Path", Path);
		const FImage Image = RenderOcclusion(MakePlan({0.6, 0, 0}, 1.2, 48), 64);
		double Worst = 0.0;
		for (uint32_t X = 0; X < 48; ++X) { Worst = std::max(Worst, std::abs(MeanOfColumn(Image, X) - BesideWall((X + 0.5) * 1.2 / 48))); }
		PrintFigure(fmt::format("beside a wall, path {}: worst column off by {:.4f}", Path, Worst));
		EXPECT_LT(Worst, 0.006) << "path " << Path;
	}
}

TEST_F(FAmbientOcclusionTest, InsideACorner)
{
	ASSERT_TRUE(Load(MakeWalls(true)));
	for (const double Where : {0.1, 0.35, 0.7})
	{
		const FImage Image = RenderOcclusion(MakePlan({Where, 0, 0.5 * Where}, 0.002, 32), 4);
		const double Exact = IntegrateOcclusion(1.0, [&](glm::dvec3 D) {
			const double X = D.x < 0.0 ? Where / -D.x : 1e9, Z = D.z < 0.0 ? 0.5 * Where / -D.z : 1e9;
			return std::min(X, Z);
		});
		PrintFigure(fmt::format("inside a corner at {} m: {:.4f} expected, {:.4f}", Where, Exact, MeanGreen(Image)));
		EXPECT_NEAR(MeanGreen(Image), Exact, 0.004) << Where;
	}
}

TEST_F(FAmbientOcclusionTest, UnderACeiling)
{
	ASSERT_TRUE(Load(MakeCeiling(0.5f)));
	const FView View = MakeViewUnder({0, 0, 0}, 0.2, 32);
	for (const double Radius : {0.4, 0.6, 1.0, 2.0, 3.5})
	{
		SetVariable("r.RT.AO.Radius", std::to_string(Radius));
		const double Exact = UnderCeiling(0.5 / Radius), Mean = MeanGreen(RenderOcclusion(View, 4));
		PrintFigure(fmt::format("under a ceiling at {:.2f} radii: {:.4f} expected, {:.4f}", 0.5 / Radius, Exact, Mean));
		EXPECT_NEAR(Mean, Exact, 0.003) << Radius;
	}
}

// One ray of each pixel in ten sees. Neighbourhoods in which none does are chance, and no change of the light: a filter that drops
// its history by them is noisy, and darker than what it filters.
TEST_F(FAmbientOcclusionTest, FilterKeepsWhatLittleSkyIsSeen)
{
	ASSERT_TRUE(Load(MakeCeiling(0.5f)));
	SetVariable("r.RT.AO.Samples", "1");
	SetVariable("r.RT.AO.Denoise", "1");
	for (const double Radius : {2.0, 3.5})
	{
		SetVariable("r.RT.AO.Radius", std::to_string(Radius));
		const double Exact = UnderCeiling(0.5 / Radius);
		const FImage Image = RenderOcclusion(MakeViewUnder({0, 0, 0}, 0.2, 64), 16);
		size_t Dots = 0;
		for (const float Value : Image.Pixels) { Dots += std::abs(Value - Exact) > 0.5 * Exact ? 1 : 0; }
		const double Share = double(Dots) / double(Image.Pixels.size());
		PrintFigure(fmt::format("filtered, {:.4f} expected: mean {:.4f}, off by half {:.4f}", Exact, MeanGreen(Image), Share));
		EXPECT_NEAR(MeanGreen(Image), Exact, 0.1 * Exact) << Radius;
		EXPECT_LT(Share, 0.02) << Radius;
	}
}

// A shading normal at an angle to the surface: what it has below the surface is blocked. Of the whole hemisphere's cosine,
// (1 + cos) / 2 is above.
TEST_F(FAmbientOcclusionTest, BelowTheSurfaceIsBlocked)
{
	FTestScene Bumpy("bumpy");
	Bumpy.AddNode(Bumpy.AddMesh({FTestScene::MakeFloor(Bumpy.AddBumpyLambert(glm::vec3(0.5f)), 4.0f)}));
	ASSERT_TRUE(Load(std::move(Bumpy.Scene)));
	const glm::dvec3 Normal = glm::normalize(glm::dvec3(166, 204, 217) / 127.5 - 1.0);
	// Also where the rays do not see the surface itself.
	for (const char* Mask : {"2", "0"})
	{
		SetVariable("r.RT.AO.InstanceMask", Mask);
		EXPECT_NEAR(MeanGreen(RenderOcclusion(MakePlan({0, 0, 0}, 2.0, 32), 4)), 0.5 * (1.0 + Normal.z), 0.003) << Mask;
	}
}

TEST_F(FAmbientOcclusionTest, ClosedRoomIsDark)
{
	ASSERT_TRUE(Load("furnace:0.5"));
	SetVariable("r.RT.AO.Radius", "100000");
	EXPECT_EQ(MeanGreen(RenderOcclusion(MakeView(32, 32))), 0.0);
}

TEST_F(FAmbientOcclusionTest, SkyIsUnoccluded)
{
	ASSERT_TRUE(Load(MakeCeiling(0.5f)));
	SetVariable("r.RT.AO.Radius", "100000");
	const FImage Image = RenderOcclusion(LookAt({0, 30, 60}, {0, 32, 0}, 1.0f, 32, 32));
	for (uint32_t X = 0; X < 32; ++X) { EXPECT_EQ(Image.At(X, 0, 0), 1.0f); }
}

// Half of the ceiling is cut away by its texture.
TEST_F(FAmbientOcclusionTest, AlphaTestedOcclusion)
{
	ASSERT_TRUE(Load(MakeCeiling(0.5f, true)));
	const double Covered = UnderCeiling(0.5);
	for (const char* Path : {"1", "2"})
	{
		SetVariable("r.RT.AO.Path", Path);
		SetVariable("r.RT.AlphaTest", "1");
		EXPECT_EQ(MeanGreen(RenderOcclusion(MakeViewUnder({-2, 0, 0}, 0.2, 32))), 1.0) << "path " << Path;
		EXPECT_NEAR(MeanGreen(RenderOcclusion(MakeViewUnder({2, 0, 0}, 0.2, 32), 4)), Covered, 0.003) << "path " << Path;
		SetVariable("r.RT.AlphaTest", "0");
		EXPECT_NEAR(MeanGreen(RenderOcclusion(MakeViewUnder({-2, 0, 0}, 0.2, 32), 4)), Covered, 0.003) << "path " << Path;
	}
}

TEST_F(FAmbientOcclusionTest, InstanceMask)
{
	ASSERT_TRUE(Load(MakeCeiling(0.5f)));
	const FView View = MakeViewUnder({0, 0, 0}, 0.2, 16);
	for (const char* Path : {"1", "2"})
	{
		SetVariable("r.RT.AO.Path", Path);
		SetVariable("r.RT.AO.InstanceMask", "2");
		EXPECT_LT(MeanGreen(RenderOcclusion(View)), 0.7);
		SetVariable("r.RT.AO.InstanceMask", "0");
		EXPECT_EQ(MeanGreen(RenderOcclusion(View)), 1.0) << "rays that see nothing, path " << Path;
	}
}

// Both paths cast the same rays of the same random numbers.
TEST_F(FAmbientOcclusionTest, PipelineEqualsRayQuery)
{
	ASSERT_TRUE(GetDevice().GetCapabilities().bRayQuery && GetDevice().GetCapabilities().bRayTracingPipeline);
	ASSERT_TRUE(Load("courtyard"));
	SetVariable("r.RT.AO.Radius", "2");
	for (const char* AlphaTest : {"1", "0"})
	{
		SetVariable("r.RT.AlphaTest", AlphaTest);
		for (const char* Samples : {"1", "4"})
		{
			SetVariable("r.RT.AO.Samples", Samples);
			const FView View = MakeView(192, 108);
			SetVariable("r.RT.AO.Path", "1");
			const FImage Pipeline = RenderOcclusion(View, 1, 3);
			SetVariable("r.RT.AO.Path", "2");
			const FImage Query = RenderOcclusion(View, 1, 3);
			EXPECT_EQ(Pipeline.Pixels, Query.Pixels) << "samples " << Samples << ", alpha test " << AlphaTest;
			const double Mean = MeanGreen(Query);
			EXPECT_TRUE(Mean > 0.2 && Mean < 0.99) << "the scene must have something to tell: " << Mean;
		}
	}
}

// Any number of rays gives the same mean; more rays, less scatter; frames complete each other.
TEST_F(FAmbientOcclusionTest, OneToSixteenRays)
{
	ASSERT_TRUE(Load(MakeCeiling(0.5f)));
	const FView View = MakeViewUnder({0, 0, 0}, 0.2, 64);
	const double Exact = UnderCeiling(0.5);
	const auto GetScatter = [&](const FImage& Image) {
		double Sum = 0.0;
		for (const float Value : Image.Pixels) { Sum += std::pow(Value - Exact, 2) / double(Image.Pixels.size()); }
		return std::sqrt(Sum);
	};
	double Before = 1e9;
	for (const int Rays : {1, 4, 16})
	{
		SetVariable("r.RT.AO.Samples", std::to_string(Rays));
		const FImage Image = RenderOcclusion(View);
		EXPECT_NEAR(MeanGreen(Image), Exact, 0.02) << Rays;
		PrintFigure(fmt::format(
		    "{} rays: scatter {:.4f}, of independent ones {:.4f}", Rays, GetScatter(Image), std::sqrt(Exact * (1.0 - Exact) / Rays)));
		// At least as fast as independent samples would: ×4 rays, half the error.
		EXPECT_LT(GetScatter(Image), 0.55 * Before) << Rays;
		Before = GetScatter(Image);
	}
	SetVariable("r.RT.AO.Samples", "1");
	EXPECT_NEAR(GetScatter(RenderOcclusion(View, 16)), Before, 0.1 * Before);
}

TEST_F(FAmbientOcclusionTest, SamplesFollowFrameAndSeed)
{
	ASSERT_TRUE(Load(MakeWalls(true)));
	FView View = MakePlan({0.5, 0, 0.5}, 1.0, 32);
	const FImage First = RenderOcclusion(View, 1, 5);
	EXPECT_EQ(First.Pixels, RenderOcclusion(View, 1, 5).Pixels);
	EXPECT_GT(FractionDiffering(First, RenderOcclusion(View, 1, 6), 0.0), 0.5);
	View.Seed = 1;
	EXPECT_GT(FractionDiffering(First, RenderOcclusion(View, 1, 5), 0.0), 0.5);
}

TEST_F(FAmbientOcclusionTest, FarFromTheOrigin)
{
	ASSERT_TRUE(Load(MakeWalls(true)));
	const FImage Near = RenderOcclusion(MakePlan({0.5, 0, 0.5}, 1.0, 48), 4);
	FSceneDescription Moved = MakeWalls(true);
	Moved.Nodes[0].Matrix = glm::dmat4({1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {16000, 500, 16000, 1});
	ASSERT_TRUE(Load(std::move(Moved)));
	const FImage Far = RenderOcclusion(MakePlan({16000.5, 500, 16000.5}, 1.0, 48), 4);
	EXPECT_NEAR(MeanGreen(Far), MeanGreen(Near), 1e-3);
	EXPECT_LT(FractionDiffering(Far, Near, 0.05), 0.01);
}

TEST_F(FAmbientOcclusionTest, ItIsThereWhereSomethingUsesIt)
{
	ASSERT_TRUE(Load(MakeWalls(true)));
	const FView View = MakePlan({0.5, 0, 0.5}, 1.0, 16);
	const auto IsThere = [&](bool bCaptured) {
		bool bThere = false;
		GetEngine().ExtraPasses = [&](FFrameContext&, const FGBuffer&, const FFrameOutputs& Frame) {
			bThere = Frame.Get(ESignal::AmbientOcclusion).IsValid();
		};
		FFrameCapture Capture;
		FCapturedFrame Frame;
		Capture.bLighting = true;
		if (bCaptured) { Capture.Signals.Add(ESignal::AmbientOcclusion); }
		EXPECT_OK(GetEngine().RenderFrame(View, 0.0, Capture, &Frame));
		EXPECT_EQ(!Frame.Get(ESignal::AmbientOcclusion).IsEmpty(), bThere && bCaptured);
		GetEngine().ExtraPasses = {};
		return bThere;
	};
	SetSky(glm::vec3(0));
	EXPECT_FALSE(IsThere(false)) << "no sky";
	EXPECT_TRUE(IsThere(true)) << "asked for";
	SetSky(glm::vec3(1));
	EXPECT_TRUE(IsThere(false));
	SetVariable("r.RT.SkyAmbient", "0");
	EXPECT_FALSE(IsThere(false)) << "no ambient light";
	SetVariable("r.RT.SkyAmbient", "1");
	for (const char* Toggle : {"r.RT.AO", "r.RT.Enable"})
	{
		SetVariable(Toggle, "0");
		EXPECT_FALSE(IsThere(true)) << Toggle;
		SetVariable(Toggle, "1");
		EXPECT_TRUE(IsThere(true)) << Toggle;
	}
}

// The path tracer's ambient occlusion, which finds the distance to the nearest surface.
TEST_F(FAmbientOcclusionTest, EqualsReference)
{
	ASSERT_TRUE(Load("courtyard"));
	// Geometry alone: textures, which alpha tests and normals come from, are mip-mapped in the raster only.
	SetVariable("r.RT.Material.Override", "2");
	SetVariable("r.RT.AO.Radius", "1.5");
	const FView View = MakeView(96, 54);
	const FImage Plugin = RenderOcclusion(View, 8);
	FReferenceSettings Settings;
	Settings.View = View;
	Settings.Samples = 128;
	Settings.Signal = ESignal::AmbientOcclusion;
	Settings.bPixelCenters = true;
	FReferenceResult Result;
	ASSERT_OK(RenderReference(GetEngine(), Settings, Result));
	ASSERT_EQ(Result.Radiance.Pixels.size(), Plugin.Pixels.size());
	double Squares = 0.0;
	for (size_t I = 0; I < Plugin.Pixels.size(); ++I)
	{
		Squares += std::pow(Plugin.Pixels[I] - Result.Radiance.Pixels[I], 2) / double(Plugin.Pixels.size());
	}
	PrintFigure(fmt::format("courtyard: mean {:.4f}, reference {:.4f}; RMS of the difference {:.4f}", MeanGreen(Plugin),
	    MeanGreen(Result.Radiance), std::sqrt(Squares)));
	EXPECT_NEAR(MeanGreen(Plugin), MeanGreen(Result.Radiance), 0.002);
	// 128 samples each: all or nothing scatters by 0.044 at most, the reference's by less.
	EXPECT_LT(std::sqrt(Squares), 0.05);
}

} // namespace
} // namespace Lantern
