// Lights with an extent against closed forms, in the reference and in direct lighting, and against surfaces that emit as they do.
// The figures for polygons are Lambert's; those of disk and sphere are textbook ones; the tube is integrated on the CPU.
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "LanternImage/ImageStatistics.h"
#include "LanternImage/Metrics.h"
#include "Support/RenderFixture.h"
#include "Support/Srgb.h"
#include "Support/TestScene.h"

namespace Lantern
{

namespace
{
constexpr double Tolerance = 0.005;
constexpr uint32_t Batches = 8;

const float Albedo = MakeSrgb(190);

FSceneLight MakeLight(uint32_t Type, glm::dvec3 Position, glm::vec2 Size)
{
	FSceneLight Light;
	Light.Type = Type;
	Light.Position = Position;
	Light.Size = Size;
	Light.Color = glm::vec3(1);
	return Light;
}

/// Irradiance at the origin, with normal y, of a polygon above the horizon that shines to it: L/2 · Σ Θᵢ (Γᵢ·n), L = 1 (Lambert 1760).
double IntegratePolygon(const std::vector<glm::dvec3>& Corners)
{
	double Sum = 0.0;
	for (size_t I = 0; I < Corners.size(); ++I)
	{
		const glm::dvec3 A = glm::normalize(Corners[I]), B = glm::normalize(Corners[(I + 1) % Corners.size()]);
		Sum += std::acos(glm::dot(A, B)) * glm::normalize(glm::cross(A, B)).y;
	}
	return 0.5 * std::abs(Sum);
}

FSceneLight MakeSquare(double Height) { return MakeLight(LIGHT_RECTANGLE, {0, Height, 0}, {1, 1}); }

class FLightsTest : public FRenderTest
{
protected:
	void SetUp() override
	{
		FRenderTest::SetUp();
		SetVariable("r.RT.Lights.Denoise", "0"); // the filter weighs outliers less, and figures are of one frame
		FTestScene Floor("floor");
		Floor.AddNode(Floor.AddMesh({FTestScene::MakeFloor(Floor.AddLambert(glm::vec3(Albedo)), 20.0f)}));
		ASSERT_TRUE(Load(std::move(Floor.Scene)));
		// Base colours have 8 bits, which drivers encode with approximations of their own.
		SetSun(0.0, 1.0f, {0, -1, 0});
		AlbedoSeen = MeanGreen(RenderLighting(MakePointView(0.0, 8))) * Pi;
		EXPECT_NEAR(AlbedoSeen, double(Albedo), 0.003 * double(Albedo));
		SetSun(0.0, 0.0f);
	}
	static FRTScene& GetWorld() { return GetScene().GetScene(); }
	/// A point of the floor, from above.
	static FView MakePointView(double X, uint32_t Size) { return LookAt({X, 6, 0}, {X, 0, 0}, 0.0002f, Size, Size); }

	/// Irradiance of the floor at X by direct lighting, which takes one point of the light in a pixel and frame.
	FEstimate EstimateLighting(double X, uint32_t Size)
	{
		std::vector<double> Values;
		FView View = MakePointView(X, Size);
		for (uint32_t Batch = 0; Batch < Batches; ++Batch)
		{
			View.Seed = 1 + Batch;
			Values.push_back(MeanGreen(RenderLighting(View)) * Pi / AlbedoSeen);
		}
		return MakeEstimate(Values);
	}
	FEstimate EstimateReference(double X, uint32_t Samples)
	{
		FEstimate Estimate = EstimateMean(MakePointView(X, 32), Samples, 1, Batches);
		Estimate.Mean *= Pi / double(Albedo);
		Estimate.StandardError *= Pi / double(Albedo);
		return Estimate;
	}
	/// Effort: its square is the factor of samples.
	void ExpectIrradiance(const std::string& What, double X, double Expected, uint32_t Effort = 1)
	{
		ExpectClosedForm((What + ", reference").c_str(), EstimateReference(X, 16 * Effort * Effort), Expected, Tolerance);
		ExpectClosedForm((What + ", direct lighting").c_str(), EstimateLighting(X, 128 * Effort), Expected, Tolerance);
	}
	static FLightId Add(const FSceneLight& Light) { return GetWorld().AddLight(Light); }

	double AlbedoSeen = 0.0; // by direct lighting
};

TEST_F(FLightsTest, Rectangle)
{
	const std::pair<double, double> Cases[] = {
	    {0, 0.752275}, {0.5, 0.566645}, {1, 0.265005}, {1.5, 0.104637}, {2, 0.043743}, {3, 0.010575}};
	const FLightId Id = Add(MakeSquare(1.0));
	for (const auto& [X, Expected] : Cases) { ExpectIrradiance(fmt::format("unit square, x = {}", X), X, Expected); }
	// It shines to one side unless told otherwise, and its width may point anywhere.
	FSceneLight Upwards = MakeSquare(1.0);
	Upwards.Direction = {0, 1, 0};
	Upwards.Tangent = {0, 0, 1};
	GetWorld().SetLight(Id, Upwards);
	EXPECT_EQ(EstimateLighting(0.5, 8).Mean, 0.0);
	EXPECT_EQ(EstimateReference(0.5, 1).Mean, 0.0);
	Upwards.bTwoSided = true;
	GetWorld().SetLight(Id, Upwards);
	ExpectIrradiance("unit square of two sides", 0.5, 0.566645);
}

// A rectangle that stands on the floor is cut by the horizon; one that is far away is sampled by area.
TEST_F(FLightsTest, RectangleAtTheHorizonAndFarAway)
{
	FSceneLight Wall = MakeLight(LIGHT_RECTANGLE, {0, 0, 0}, {2, 2}); // half of it is below the floor
	Wall.Direction = {1, 0, 0};
	Wall.Tangent = {0, 0, 1};
	const FLightId Id = Add(Wall);
	ASSERT_NEAR(IntegratePolygon({{-0.5, 1, -0.5}, {0.5, 1, -0.5}, {0.5, 1, 0.5}, {-0.5, 1, 0.5}}), 0.752275, 1e-6);
	ExpectIrradiance("wall on the floor", 0.5, IntegratePolygon({{-0.5, 0, -1}, {-0.5, 1, -1}, {-0.5, 1, 1}, {-0.5, 0, 1}}), 4);
	GetWorld().SetLight(Id, MakeSquare(12.0));
	ExpectIrradiance(
	    "unit square, 12 m above", 0.0, IntegratePolygon({{-0.5, 12, -0.5}, {0.5, 12, -0.5}, {0.5, 12, 0.5}, {-0.5, 12, 0.5}}));
}

TEST_F(FLightsTest, DiskSphereAndSunlikeLights)
{
	const FLightId Id = Add(MakeLight(LIGHT_DISK, {0, 1, 0}, {1, 0}));
	for (const double Height : {0.5, 1.0, 2.0})
	{
		GetWorld().SetLight(Id, MakeLight(LIGHT_DISK, {0, Height, 0}, {1, 0}));
		ExpectIrradiance(fmt::format("disk, height {}", Height), 0.0, Pi / (1.0 + Height * Height), 3);
	}
	for (const double X : {0.0, std::sqrt(3.0)})
	{
		GetWorld().SetLight(Id, MakeLight(LIGHT_SPHERE, {0, 1, 0}, {0.5, 0}));
		const double Squared = 1.0 + X * X;
		ExpectIrradiance(fmt::format("sphere, x = {}", X), X, Pi * 0.25 / Squared / std::sqrt(Squared));
	}
	FSceneLight Moon = MakeLight(LIGHT_DIRECTIONAL, {}, {0.5, 0});
	Moon.Direction = {1, -1, 0};
	GetWorld().SetLight(Id, Moon);
	ExpectIrradiance("directional light of 0.5 rad", 0.0, std::sqrt(0.5));
}

/// Irradiance below the middle of a capsule along x at Height, by sums over its surface.
double IntegrateTube(double Height, double Radius, double HalfLength, double X)
{
	double Sum = 0.0;
	const auto AddPoint = [&](glm::dvec3 Point, glm::dvec3 Normal, double Area) {
		const glm::dvec3 To = Point - glm::dvec3(X, 0, 0);
		const double Squared = glm::dot(To, To);
		const double AtLight = -glm::dot(Normal, To) / std::sqrt(Squared), AtFloor = To.y / std::sqrt(Squared);
		if (AtLight > 0.0 && AtFloor > 0.0) { Sum += AtLight * AtFloor / Squared * Area; }
	};
	constexpr int Steps = 1000;
	for (int I = 0; I < Steps; ++I)
	{
		const double Phi = 2.0 * Pi * (I + 0.5) / Steps;
		for (int K = 0; K < Steps; ++K)
		{
			const glm::dvec3 Side(0, std::cos(Phi), std::sin(Phi));
			const double Along = HalfLength * (2.0 * (K + 0.5) / Steps - 1.0);
			AddPoint(glm::dvec3(Along, Height, 0) + Side * Radius, Side, 4.0 * Pi * Radius * HalfLength / (double(Steps) * Steps));
			// Both rounded ends together are a sphere, cut in two.
			const double Z = 2.0 * (K + 0.5) / Steps - 1.0;
			const glm::dvec3 End = glm::dvec3(Z, 0, 0) + Side * std::sqrt(1.0 - Z * Z);
			AddPoint(glm::dvec3(Z > 0.0 ? HalfLength : -HalfLength, Height, 0) + End * Radius, End,
			    4.0 * Pi * Radius * Radius / (double(Steps) * Steps));
		}
	}
	return Sum;
}

TEST_F(FLightsTest, Tube)
{
	for (const auto& [Radius, HalfLength] : {std::pair(0.1, 1.0), std::pair(0.4, 0.2)})
	{
		const FLightId Id = Add(MakeLight(LIGHT_TUBE, {0, 1, 0}, glm::vec2(Radius, 2.0 * HalfLength)));
		for (const double X : {0.0, 1.5, 4.0})
		{
			const std::string Name = fmt::format("tube of {} m and {} m, x = {}", Radius, 2.0 * HalfLength, X);
			ExpectIrradiance(Name, X, IntegrateTube(1.0, Radius, HalfLength, X), 3);
		}
		GetWorld().RemoveLight(Id);
	}
	// From the end of it, its side is not seen: an end is half a sphere.
	FSceneLight Post = MakeLight(LIGHT_TUBE, {0, 3, 0}, {0.5, 2});
	Post.Tangent = {0, 1, 0};
	(void)Add(Post);
	ExpectIrradiance("tube from below", 0.0, Pi * 0.25 / 4.0, 3);
}

// Range and cone hold for a light with an extent as a whole, by its centre.
TEST_F(FLightsTest, RangesAndCones)
{
	FSceneLight Light = MakeLight(LIGHT_SPHERE, {0, 2, 0}, {0.25, 0});
	Light.Color = glm::vec3(10);
	Light.Range = 3.0f;
	Light.InnerCone = 0.3f;
	Light.OuterCone = 0.7f;
	(void)Add(Light);
	for (const double Angle : {0.0, 0.4, 0.6})
	{
		const double X = 2.0 * std::tan(Angle), Squared = X * X + 4.0;
		const double Window = 1.0 - std::pow(Squared / 9.0, 2.0);
		const double Cone = std::clamp((std::cos(Angle) - std::cos(0.7)) / (std::cos(0.3) - std::cos(0.7)), 0.0, 1.0);
		ExpectIrradiance(fmt::format("sphere with range and cone, {} rad", Angle), X,
		    10.0 * Window * Cone * Cone * Pi * 0.0625 / Squared * 2.0 / std::sqrt(Squared));
	}
	EXPECT_EQ(EstimateLighting(2.0, 8).Mean, 0.0) << "outside of the cone";
}

// What shines as a light casts the shadow that it casts as a surface; lights without shadows shine through.
TEST_F(FLightsTest, ShadowsAreThoseOfSurfacesThatEmit)
{
	const auto MakeScene = [](bool bSurface) {
		FTestScene Out("shadow");
		const int32_t Grey = Out.AddLambert(glm::vec3(Albedo), glm::vec3(0), true);
		Out.AddNode(Out.AddMesh({FTestScene::MakeFloor(Grey, 8.0f), FTestScene::MakeFloor(Grey, 0.3f, 0.5f)}));
		if (!bSurface) { return Out.Scene; }
		// Seen from below, with no light to the back.
		FTestScene::FQuad Quad = FTestScene::MakeFloor(Out.AddLambert(glm::vec3(0), glm::vec3(5)), 0.5f, 1.5f);
		std::reverse(std::begin(Quad.P), std::end(Quad.P));
		Out.AddNode(Out.AddMesh({Quad}));
		return Out.Scene;
	};
	const FView View = LookAt({2.5, 1.2, 2.5}, {0, 0.1, 0}, 0.7f, 96, 64);
	ASSERT_TRUE(Load(MakeScene(true)));
	const FImage Surface = TraceReference(View, 256, 1);
	ASSERT_TRUE(Load(MakeScene(false)));
	FSceneLight Light = MakeSquare(1.5);
	Light.Color = glm::vec3(5);
	const FLightId Id = Add(Light);
	const FImage Shadowed = TraceReference(View, 256, 1);
	FImageMetrics Metrics;
	ASSERT_OK(CompareImages(Shadowed, Surface, Metrics));
	PrintFigure(fmt::format(
	    "square light as a light and as a surface: mean ratio {:.5f}, block16 median {:.5f}", Metrics.MeanRatio[1], Metrics.Block16Median));
	EXPECT_NEAR(Metrics.MeanRatio[1], 1.0, Tolerance);
	EXPECT_LE(Metrics.Block16Median, 0.01); // 256 samples of two shaded techniques: 0.4 % of noise in a block
	Light.bCastsShadow = false;
	GetWorld().SetLight(Id, Light);
	const FImage Through = TraceReference(View, 64, 1);
	EXPECT_GT(MeanGreen(Through), 1.02 * MeanGreen(Shadowed));
	ASSERT_OK(CompareImages(RenderLightingFine(View, 8), Through, Metrics));
	EXPECT_NEAR(Metrics.MeanRatio[1], 1.0, Tolerance) << "direct lighting has no shadows";
}

// A mesh at the surface of a light, which makes it visible, does not shadow it.
TEST_F(FLightsTest, MeshesAtTheSurfaceOfALightCastNothing)
{
	FTestScene Lamp("lamp");
	const int32_t Grey = Lamp.AddLambert(glm::vec3(Albedo), glm::vec3(0), true);
	Lamp.AddNode(Lamp.AddMesh({FTestScene::MakeFloor(Grey, 20.0f)}));
	Lamp.AddNode(Lamp.AddMesh({FTestScene::MakeFloor(Grey, 0.5f, 1.00003f)})); // between two steps of a light's position
	ASSERT_TRUE(Load(std::move(Lamp.Scene)));
	SetSky({});
	(void)Add(MakeSquare(1.00003));
	for (const double X : {0.5, 3.0})
	{
		FEstimate Estimate = EstimateMean(LookAt({X, 0.5, 3.0}, {X, 0, 0}, 0.0002f, 32, 32), 16, 1);
		Estimate.Mean *= Pi / double(Albedo);
		Estimate.StandardError *= Pi / double(Albedo);
		ExpectClosedForm(fmt::format("square with a mesh, x = {}", X).c_str(), Estimate, X == 0.5 ? 0.566645 : 0.010575, Tolerance);
	}
}

// A surface inside a light, lights of no size to speak of, and the brightest that there may be: numbers, and finite ones.
TEST_F(FLightsTest, ExtremeLightsAreFinite)
{
	const uint32_t Types[] = {LIGHT_POINT, LIGHT_RECTANGLE, LIGHT_DISK, LIGHT_SPHERE, LIGHT_TUBE};
	for (const uint32_t Type : Types)
	{
		for (const float Size : {1e-9f, 1.0f, 1e9f})
		{
			for (const double Height : {0.0, 1e-7, 0.5})
			{
				FSceneLight Light = MakeLight(Type, {0, Height, 0}, glm::vec2(Size));
				Light.Color = glm::vec3(1e20f);
				const FLightId Id = Add(Light);
				for (const FImage& Image : {RenderLighting(MakePointView(0.0, 8)), TraceReference(MakePointView(0.0, 8), 1, 2)})
				{
					for (const float Value : Image.Pixels) { ASSERT_TRUE(std::isfinite(Value)) << Type << ", " << Size << ", " << Height; }
				}
				GetWorld().RemoveLight(Id);
			}
		}
	}
	(void)Add(MakeLight(LIGHT_SPHERE, {0, 0.3, 0}, {0.5, 0}));
	ExpectClosedForm("inside a sphere", EstimateReference(0.0, 192), Pi, Tolerance);
}

// The unit square again, as two triangles that emit.
TEST_F(FLightsTest, SquareOfEmissiveTriangles)
{
	FTestScene Scene("square");
	Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Scene.AddLambert(glm::vec3(Albedo)), 20.0f)}));
	FTestScene::FQuad Square = FTestScene::MakeFloor(Scene.AddLambert(glm::vec3(0), glm::vec3(1)), 0.5f, 1.0f);
	std::reverse(std::begin(Square.P), std::end(Square.P));
	Scene.AddNode(Scene.AddMesh({Square}));
	ASSERT_TRUE(Load(std::move(Scene.Scene)));
	SetSun(0.0, 0.0f);
	SetSky(glm::vec3(0));
	const std::pair<double, double> Cases[] = {
	    {0, 0.752275}, {0.5, 0.566645}, {1, 0.265005}, {1.5, 0.104637}, {2, 0.043743}, {3, 0.010575}};
	for (const auto& [X, Expected] : Cases)
	{
		ExpectClosedForm(fmt::format("two triangles, x = {}", X).c_str(), EstimateLighting(X, 256), Expected, Tolerance);
	}
	SetVariable("r.RT.Debug.Lights.Area", "0");
	EXPECT_GT(std::abs(EstimateLighting(0.0, 64).Mean / 0.752275 - 1.0), Tolerance);
}

TEST_F(FLightsTest, HalfTheAreaIsSeen)
{
	(void)Add(MakeSquare(1.0));
	SetVariable("r.RT.Debug.Lights.Area", "0");
	const double Reference = EstimateReference(0.0, 4).Mean, Lighting = EstimateLighting(0.0, 32).Mean;
	SetVariable("r.RT.Debug.Lights.Area", "1");
	EXPECT_GT(std::abs(Reference / 0.752275 - 1.0), Tolerance);
	EXPECT_GT(std::abs(Lighting / 0.752275 - 1.0), Tolerance);
}

} // namespace
} // namespace Lantern
