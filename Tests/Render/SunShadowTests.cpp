// The plugin's sun shadows against geometry, against closed form 8, against the reference path tracer, and one path
// against the other.
#include <cmath>

#include "LanternImage/ImageStatistics.h"
#include "Support/RenderFixture.h"
#include "Support/TestScene.h"

namespace Lantern
{

namespace
{

class FSunShadowTest : public FRenderTest
{
protected:
	/// Means of the columns of a picture whose rows all show the same.
	static std::vector<double> MakeColumnMeans(const FImage& Image)
	{
		std::vector<double> Means(Image.Width);
		for (uint32_t Y = 0; Y < Image.Height; ++Y)
		{
			for (uint32_t X = 0; X < Image.Width; ++X) { Means[X] += Image.At(X, Y, 0) / Image.Height; }
		}
		return Means;
	}
};

/// Fraction of a disk of radius 1 on the side of a chord at distance T from its centre.
double DiskFraction(double T)
{
	T = std::clamp(T, -1.0, 1.0);
	return 0.5 + (T * std::sqrt(1.0 - T * T) + std::asin(T)) / Pi;
}

/// Where a rising curve of samples at (I + 0.5) crosses Level.
double FindCrossing(const std::vector<double>& Curve, double Level)
{
	for (size_t I = 1; I < Curve.size(); ++I)
	{
		if (Curve[I - 1] < Level && Curve[I] >= Level) { return double(I) - 0.5 + (Level - Curve[I - 1]) / (Curve[I] - Curve[I - 1]); }
	}
	return -1.0;
}

// The built-in scene: an edge at x = 0, the sun straight above, the picture 4 penumbra widths wide and centred on it.
TEST_F(FSunShadowTest, HardEdgeIsExact)
{
	ASSERT_TRUE(Load("penumbra:1"));
	SetSun(0.0, 4.0f, {0, -1, 0});
	for (const char* Path : {"1", "2"})
	{
		SetVariable("r.RT.Shadow.Path", Path);
		SetVariable("r.RT.Shadow.Samples", "16"); // more rays change nothing
		const FImage Shadow = RenderSunShadow(MakeView(64, 48));
		for (uint32_t Y = 0; Y < 48; ++Y)
		{
			for (uint32_t X = 0; X < 64; ++X) { ASSERT_EQ(Shadow.At(X, Y, 0), X < 32 ? 0.0f : 1.0f) << X << ", " << Y << " path " << Path; }
		}
	}
}

TEST_F(FSunShadowTest, SoftIsOffOnDemand)
{
	ASSERT_TRUE(Load("penumbra:1"));
	SetVariable("r.RT.Shadow.Soft", "0");
	const FImage Shadow = RenderSunShadow(MakeView(64, 8));
	for (const float Value : Shadow.Pixels) { ASSERT_TRUE(Value == 0.0f || Value == 1.0f); }
}

// Closed form 8: a penumbra is D·b/a wide, 9.30 mm per metre under the sun; and inside it the visible part of the disk.
TEST_F(FSunShadowTest, PenumbraHasItsWidthAndShape)
{
	SetVariable("r.RT.Shadow.Samples", "64");
	for (const double Height : {0.5, 1.0, 4.0, 20.0})
	{
		ASSERT_TRUE(Load(fmt::format("penumbra:{}", Height)));
		const uint32_t Width = 96;
		const FImage Shadow = RenderSunShadow(MakeView(Width, 16), 4);
		const std::vector<double> Curve = MakeColumnMeans(Shadow);
		const double Penumbra = 9.3026e-3 * Height;
		// MakeView keeps the height's field of view: 4 penumbrae high, and as wide as pixels are square.
		const double Pixel = 4.0 * Penumbra / 16.0;
		double Worst = 0.0;
		for (uint32_t X = 0; X < Width; ++X)
		{
			const double Position = (X + 0.5 - 0.5 * Width) * Pixel;
			Worst = std::max(Worst, std::abs(Curve[X] - DiskFraction(Position / (0.5 * Penumbra))));
		}
		PrintFigure(fmt::format("penumbra at {} m: worst column off by {:.4f}", Height, Worst));
		EXPECT_LT(Worst, 0.01) << Height;
	}
}

TEST_F(FSunShadowTest, PenumbraWidthInMillimetres)
{
	SetVariable("r.RT.Shadow.Samples", "64");
	ASSERT_TRUE(Load("penumbra:1"));
	// Between the columns where a tenth and nine tenths of the disk are seen lies a known part of the width.
	double T = 0.0;
	for (double Step = 0.5; Step > 1e-9; Step /= 2) { T += DiskFraction(T + Step) <= 0.9 ? Step : 0.0; }
	const auto Measure = [&] {
		const std::vector<double> Curve = MakeColumnMeans(RenderSunShadow(MakeView(64, 64), 4));
		const double PixelMillimetres = 4.0 * 9.3026 / 64.0;
		return (FindCrossing(Curve, 0.9) - FindCrossing(Curve, 0.1)) * PixelMillimetres / T;
	};
	const double Width = Measure();
	PrintFigure(fmt::format("penumbra width per metre: {:.3f} mm (9.30 expected)", Width));
	EXPECT_NEAR(Width, 9.30, 0.1);
	SetVariable("r.RT.Shadow.SourceScale", "2");
	EXPECT_GT(Measure(), 1.9 * 9.30) << "a sun of twice the diameter goes unnoticed";
}

// Any number of rays gives the same mean; more rays, less scatter.
TEST_F(FSunShadowTest, OneToSixtyFourRays)
{
	ASSERT_TRUE(Load("penumbra:1"));
	double Before = 1e9;
	for (const int Rays : {1, 4, 16, 64})
	{
		SetVariable("r.RT.Shadow.Samples", std::to_string(Rays));
		const FImage Shadow = RenderSunShadow(MakeView(64, 64));
		double Scatter = 0.0;
		for (uint32_t Y = 0; Y < 64; ++Y)
		{
			for (uint32_t X = 0; X < 64; ++X)
			{
				const double Value = Shadow.At(X, Y, 0) * Rays;
				ASSERT_NEAR(Value, std::round(Value), 0.02 * Rays) << "a multiple of 1/" << Rays;
				const double Exact = DiskFraction((X + 0.5 - 32.0) / 8.0);
				Scatter += std::pow(Shadow.At(X, Y, 0) - Exact, 2) / 4096;
			}
		}
		EXPECT_NEAR(MeanGreen(Shadow), 0.5, 0.01) << Rays;
		// At least as fast as independent samples would: ×4 rays, half the error.
		EXPECT_LT(std::sqrt(Scatter), 0.55 * Before) << Rays;
		Before = std::sqrt(Scatter);
	}
}

TEST_F(FSunShadowTest, SamplesFollowFrameAndSeed)
{
	ASSERT_TRUE(Load("penumbra:1"));
	FView View = MakeView(64, 32);
	const FImage First = RenderSunShadow(View, 1, 5);
	EXPECT_EQ(First.Pixels, RenderSunShadow(View, 1, 5).Pixels);
	EXPECT_GT(FractionDiffering(First, RenderSunShadow(View, 1, 6), 0.0), 0.02);
	View.Seed = 1;
	EXPECT_GT(FractionDiffering(First, RenderSunShadow(View, 1, 5), 0.0), 0.02);
	// Successive frames complete each other: 64 frames of one ray are about as good as one frame of 64. Pixels of a tile
	// have taken the same 64 points by then, so that a column's mean is of four sets, not of 32.
	View.Seed = 0;
	const std::vector<double> Curve = MakeColumnMeans(RenderSunShadow(View, 64));
	for (uint32_t X = 0; X < 64; ++X) { EXPECT_NEAR(Curve[X], DiskFraction((X + 0.5 - 32.0) / 4.0), 0.035) << X; }
}

// The picture of raster and plugin against the path tracer: sun alone, Lambert, where light is visibility times a
// constant. 8,192 independent samples of the reference in each column scatter by 0.0055 at most; four times that is
// allowed.
TEST_F(FSunShadowTest, PenumbraEqualsReference)
{
	ASSERT_TRUE(Load("penumbra:1"));
	SetVariable("r.RT.Shadow.Samples", "64");
	const FView View = MakeView(64, 32);
	const std::vector<double> Plugin = MakeColumnMeans(RenderSunShadow(View, 4));
	const FImage Reference = TraceReference(View, 256, 1);
	const std::vector<double> Traced = MakeColumnMeans(Reference);
	// Albedo 1 under π lux: radiance 1. The reference's pixels are averages over their area, the plugin's are their
	// centres; in the middle of the penumbra the difference is of second order.
	for (uint32_t X = 0; X < 64; ++X) { EXPECT_NEAR(Plugin[X], Traced[X], 0.02) << X; }
	EXPECT_NEAR(MeanGreen(Reference), 0.5, 0.002);
}

// Both paths cast the same rays of the same random numbers.
TEST_F(FSunShadowTest, PipelineEqualsRayQuery)
{
	ASSERT_TRUE(GetDevice().GetCapabilities().bRayQuery && GetDevice().GetCapabilities().bRayTracingPipeline);
	for (const char* Scene : {"courtyard", "planes"})
	{
		ASSERT_TRUE(Load(Scene));
		SetSun(3.0);
		for (const char* AlphaTest : {"1", "0"})
		{
			SetVariable("r.RT.AlphaTest", AlphaTest);
			SetVariable("r.RT.Shadow.Samples", "4");
			const FView View = MakeView(192, 108);
			SetVariable("r.RT.Shadow.Path", "1");
			const FImage Pipeline = RenderSunShadow(View, 1, 3);
			SetVariable("r.RT.Shadow.Path", "2");
			const FImage Query = RenderSunShadow(View, 1, 3);
			EXPECT_EQ(Pipeline.Pixels, Query.Pixels) << Scene << ", alpha test " << AlphaTest;
			const double Mean = MeanGreen(Query);
			EXPECT_TRUE(Mean > 0.05 && Mean < 0.999) << "the scene must have light and shadow to tell: " << Mean;
		}
	}
}

// A square above the floor of which one half is cut away: the shadow is the other half.
TEST_F(FSunShadowTest, AlphaTestedShadow)
{
	FTestScene Cut("cut");
	const int32_t Floor = Cut.AddLambert(glm::vec3(0.5f)), Half = Cut.AddHalfCutLambert();
	Cut.AddNode(Cut.AddMesh({FTestScene::MakeFloor(Floor, 10.0f)}));
	Cut.AddNode(Cut.AddMesh({FTestScene::MakeFloor(Half, 1.0f, 2.0f)}));
	ASSERT_TRUE(Load(std::move(Cut.Scene)));
	SetSun(0.0, 4.0f, {0, -1, 0});
	FView View = LookAt({0, 1.0, 0}, {0, 0, 0}, 2.0f * std::atan(2.0f), 64, 64); // from below: 4 m × 4 m of the floor
	for (const char* Path : {"1", "2"})
	{
		SetVariable("r.RT.Shadow.Path", Path);
		SetVariable("r.RT.AlphaTest", "1");
		const FImage Shadow = RenderSunShadow(View);
		SetVariable("r.RT.AlphaTest", "0");
		const FImage Solid = RenderSunShadow(View);
		for (uint32_t Y = 0; Y < 64; ++Y)
		{
			for (uint32_t X = 0; X < 64; ++X)
			{
				const bool bInSquare = X >= 16 && X < 48 && Y >= 16 && Y < 48;
				ASSERT_EQ(Shadow.At(X, Y, 0), bInSquare && X >= 32 ? 0.0f : 1.0f) << X << ", " << Y << " path " << Path;
				ASSERT_EQ(Solid.At(X, Y, 0), bInSquare ? 0.0f : 1.0f) << X << ", " << Y << " path " << Path;
			}
		}
	}
}

/// Fraction of the sun seen beneath each of the three planes of the built-in scene, sun straight above.
std::vector<double> MeasurePlanes(FRenderTest&, const FImage& Shadow)
{
	std::vector<double> Seen;
	for (uint32_t Plane = 0; Plane < 3; ++Plane)
	{
		// 8 m wide, 96 pixels: planes of 1.5 m at −2.5, 0 and 2.5 m.
		const uint32_t Center = 48 + (Plane - 1) * 30;
		Seen.push_back(ComputeMeans(Shadow, Center - 8, 40, Center + 8, 56).Channel[0]);
	}
	return Seen;
}

// Stability case 25: planes that face the sun, face away, and have two sides. Without culling all cast, as a shadow map
// of both sides has it; of those that face the sun or away from it, only one kind casts if the other kind of face is culled; two-sided ones always do.
TEST_F(FSunShadowTest, SingleSidedPlanesCastAsShadowMapsDo)
{
	ASSERT_TRUE(Load("planes"));
	SetSun(0.0, 4.0f, {0, -1, 0});
	const FView View = LookAt({0, 1.0, 0}, {0, 0, 0}, 2.0f * std::atan(4.0f), 96, 96);
	for (const char* Path : {"1", "2"})
	{
		SetVariable("r.RT.Shadow.Path", Path);
		SetVariable("r.RT.Shadow.CasterFaces", "0");
		EXPECT_EQ(MeasurePlanes(*this, RenderSunShadow(View)), (std::vector<double>{0, 0, 0})) << "path " << Path;
		SetVariable("r.RT.Shadow.CasterFaces", "2");
		EXPECT_EQ(MeasurePlanes(*this, RenderSunShadow(View)), (std::vector<double>{1, 0, 0})) << "path " << Path;
		SetVariable("r.RT.Shadow.CasterFaces", "1");
		EXPECT_EQ(MeasurePlanes(*this, RenderSunShadow(View)), (std::vector<double>{0, 1, 0})) << "path " << Path;
	}
}

// A plane that faces the sun is lit: it does not shadow itself, from near and far, under a high sun and a grazing one, with
// triangles up to a kilometre. (Of 4 km, seen from 0.3 m, they do: fp32 vertices 2 km away put the plane that rays meet
// 0.1 mm off. The path tracer has the same limit.)
TEST_F(FSunShadowTest, NoAcneOnLitSurfaces)
{
	for (const float Half : {5.0f, 50.0f, 500.0f})
	{
		FTestScene Flat("flat");
		const int32_t Lambert = Flat.AddLambert(glm::vec3(0.5f), glm::vec3(0), true);
		Flat.AddNode(Flat.AddMesh({FTestScene::MakeFloor(Lambert, Half)}));
		ASSERT_TRUE(Load(std::move(Flat.Scene)));
		for (const double Elevation : {60.0, 10.0, 1.0})
		{
			SetSun(0.0, 4.0f, {std::cos(glm::radians(Elevation)), -std::sin(glm::radians(Elevation)), 0.1});
			for (const double Height : {0.3, 5.0, 300.0})
			{
				const FView View = LookAt({0.3, Height, 0.2}, {3.0 * Height, 0, 0.5 * Height}, 1.2f, 96, 64);
				EXPECT_EQ(MeanGreen(RenderSunShadow(View)), 1.0)
				    << "floor of " << Half << " m, sun at " << Elevation << ", camera at " << Height;
			}
		}
	}
}

TEST_F(FSunShadowTest, InstanceMask)
{
	FTestScene Flat("mask");
	const int32_t Lambert = Flat.AddLambert(glm::vec3(0.5f));
	Flat.AddNode(Flat.AddMesh({FTestScene::MakeFloor(Lambert, 2.0f)}));
	ASSERT_TRUE(Load(std::move(Flat.Scene)));
	SetSun(0.0, 4.0f, {0, -1, 0});
	FView View = LookAt({0, 1.0, 0}, {0, 0, 0}, 1.0f, 16, 16);
	// A second object of the same geometry above, that only rays know.
	FRTScene& Scene = GetScene().GetScene();
	FRTObjectInfo Roof = Scene.GetObject(GetScene().GetDraws()[0].Object);
	Roof.Transform[3].y = 2.0;
	for (const char* Path : {"1", "2"})
	{
		SetVariable("r.RT.Shadow.Path", Path);
		SetVariable("r.RT.Shadow.InstanceMask", "14");
		EXPECT_EQ(MeanGreen(RenderSunShadow(View)), 1.0);
		const std::pair<uint8_t, double> Cases[] = {{MaskDefault, 0.0}, {MASK_SUN, 0.0}, {MASK_SUN_MOVING, 0.0}, {MASK_CHARACTER, 0.0},
		    {MASK_LOCAL, 1.0}, {MaskVisible, 1.0}, {0x80, 1.0}};
		for (const auto& [Mask, Expected] : Cases)
		{
			Roof.Mask = Mask;
			const FRTObjectId Object = Scene.AddObject(Roof);
			SetVariable("r.RT.Shadow.InstanceMask", "14");
			EXPECT_EQ(MeanGreen(RenderSunShadow(View)), Expected) << "mask " << int(Mask) << " path " << Path;
			SetVariable("r.RT.Shadow.InstanceMask", "0");
			EXPECT_EQ(MeanGreen(RenderSunShadow(View)), 1.0) << "rays that see nothing, path " << Path;
			Scene.RemoveObject(Object);
		}
	}
}

TEST_F(FSunShadowTest, MaxDistance)
{
	ASSERT_TRUE(Load("penumbra:4"));
	SetSun(0.0, 4.0f, {0, -1, 0});
	SetVariable("r.RT.Shadow.MaxDistance", "3.9");
	EXPECT_EQ(MeanGreen(RenderSunShadow(MakeView(32, 32))), 1.0);
	SetVariable("r.RT.Shadow.MaxDistance", "4.1");
	EXPECT_EQ(MeanGreen(RenderSunShadow(MakeView(32, 32))), 0.5);
}

} // namespace
} // namespace Lantern
