// The reference path tracer as such: reproducible, resumable, and without bias where strategies are combined.
#include <cmath>
#include <filesystem>
#include <fstream>

#include "Support/RenderFixture.h"
#include "Support/SharedFiles.h"
#include "Support/TestScene.h"

namespace Lantern
{

namespace
{

class FReferenceTest : public FRenderTest
{
protected:
	FReferenceSettings MakeSettings(uint32_t Samples)
	{
		FReferenceSettings Settings;
		Settings.View = MakeView(24, 20);
		Settings.Samples = Samples;
		Settings.Bounces = 4;
		Settings.SceneKey = "a scene";
		return Settings;
	}
	static FImage Run(const FReferenceSettings& Settings, uint32_t* OutResumed = nullptr)
	{
		FReferenceResult Result;
		EXPECT_OK(RenderReference(GetEngine(), Settings, Result));
		if (OutResumed) { *OutResumed = Result.ResumedSamples; }
		return std::move(Result.Radiance);
	}
};

TEST_F(FReferenceTest, SameSeedSameBits)
{
	ASSERT_TRUE(Load("furnace:0.7"));
	FReferenceSettings Settings = MakeSettings(12);
	const FImage First = Run(Settings);
	EXPECT_EQ(First.Pixels, Run(Settings).Pixels);
	Settings.View.Seed = 7;
	EXPECT_GT(FractionDiffering(First, Run(Settings), 0.0), 0.9);
}

// However samples fall on dispatches, their sum is formed in the same order.
TEST_F(FReferenceTest, ResumedEqualsUninterrupted)
{
	ASSERT_TRUE(Load("furnace:0.7"));
	const FTemporaryFolder Folder;
	const FImage Whole = Run(MakeSettings(31));
	FReferenceSettings Settings = MakeSettings(5);
	Settings.StateFile = Folder / "picture.state";
	Settings.bResume = true;
	uint32_t Resumed = 99;
	Run(Settings, &Resumed);
	EXPECT_EQ(Resumed, 0u);
	for (const uint32_t Samples : {18u, 31u})
	{
		const uint32_t Before = Settings.Samples;
		Settings.Samples = Samples;
		const FImage Picture = Run(Settings, &Resumed);
		EXPECT_EQ(Resumed, Before);
		if (Samples == 31) { EXPECT_EQ(Picture.Pixels, Whole.Pixels); }
	}
}

TEST_F(FReferenceTest, StateOfAnotherPictureIsRefusedAndKept)
{
	ASSERT_TRUE(Load("furnace"));
	const FTemporaryFolder Folder;
	FReferenceSettings Settings = MakeSettings(2);
	Settings.StateFile = Folder / "picture.state";
	Run(Settings);
	const auto ReadState = [&] {
		std::ifstream File(Settings.StateFile, std::ios::binary);
		return std::string(std::istreambuf_iterator<char>(File), {});
	};
	const std::string State = ReadState();
	Settings.bResume = true;
	Settings.Samples = 4;
	const auto ExpectRefused = [&](const FReferenceSettings& Other, const char* What) {
		FReferenceResult Result;
		const FRTStatus Status = RenderReference(GetEngine(), Other, Result);
		EXPECT_EQ(Status.Code, ERTResult::InvalidArgument) << What;
		EXPECT_NE(std::string(Status.Message).find("picture.state"), std::string::npos) << Status.Message;
		EXPECT_EQ(ReadState(), State) << What;
	};
	FReferenceSettings Other = Settings;
	Other.SceneKey = "another scene";
	ExpectRefused(Other, "scene");
	Other = Settings;
	Other.View.Seed = 3;
	ExpectRefused(Other, "seed");
	Other = Settings;
	Other.View.Position.x += 0.5;
	ExpectRefused(Other, "camera");
	Other = Settings;
	Other.Bounces = 2;
	ExpectRefused(Other, "bounces");
	Other = Settings;
	Other.View.Width = 20;
	Other.View.Height = 24;
	ExpectRefused(Other, "size");
}

TEST_F(FReferenceTest, DamagedStateIsAnError)
{
	ASSERT_TRUE(Load("furnace"));
	const FTemporaryFolder Folder;
	FReferenceSettings Settings = MakeSettings(2);
	Settings.StateFile = Folder / "picture.state";
	Run(Settings);
	std::filesystem::resize_file(Settings.StateFile, std::filesystem::file_size(Settings.StateFile) - 100);
	Settings.bResume = true;
	Settings.Samples = 4;
	FReferenceResult Result;
	const FRTStatus Status = RenderReference(GetEngine(), Settings, Result);
	EXPECT_EQ(Status.Code, ERTResult::IoError);
	EXPECT_NE(std::string(Status.Message).find("cut off"), std::string::npos) << Status.Message;
}

// Paths of one seed share their beginning, and every further bounce only adds light.
TEST_F(FReferenceTest, EachBounceAddsLight)
{
	ASSERT_TRUE(Load("furnace:0.5"));
	const FView View = MakeView(32, 32);
	FImage Before = TraceReference(View, 8, 0);
	EXPECT_NEAR(MeanGreen(Before), 0.5, 1e-3); // directly seen: the emission itself
	for (const uint32_t Bounces : {1u, 2u, 3u})
	{
		const FImage Now = TraceReference(View, 8, Bounces);
		for (size_t I = 0; I < Now.Pixels.size(); ++I) { ASSERT_GE(Now.Pixels[I], Before.Pixels[I]) << "bounces " << Bounces; }
		// Sum of the geometric series so far.
		EXPECT_NEAR(MeanGreen(Now), 1.0 - std::pow(0.5, Bounces + 1.0), 0.01) << "bounces " << Bounces;
		Before = Now;
	}
}

// The disk of the sun, integrated over the picture, is the irradiance that the sun is given by.
TEST_F(FReferenceTest, SunDiskSeenDirectly)
{
	ASSERT_TRUE(Load("emptysky"));
	SetSky(glm::vec3(0));
	for (const double Diameter : {0.533, 5.0})
	{
		SetSun(Diameter, 4.0f, {0.3, -0.8, 0.5});
		const uint32_t Size = 64;
		const double FovY = glm::radians(2.0 * Diameter), HalfTan = std::tan(FovY / 2);
		const FView View = LookAt({0, 0, 0}, {-0.3, 0.8, -0.5}, static_cast<float>(FovY), Size, Size);
		const FImage Picture = TraceReference(View, 64, 0);
		double Irradiance = 0.0;
		for (uint32_t Y = 0; Y < Size; ++Y)
		{
			for (uint32_t X = 0; X < Size; ++X)
			{
				const double U = ((X + 0.5) / Size * 2 - 1) * HalfTan, V = ((Y + 0.5) / Size * 2 - 1) * HalfTan;
				const double Area = 4.0 * HalfTan * HalfTan / (Size * Size);
				Irradiance += Picture.At(X, Y, 1) * Area / std::pow(1.0 + U * U + V * V, 2.0);
			}
		}
		PrintFigure(fmt::format("sun disk of {} degrees: {:.4f} lux of 4", Diameter, Irradiance));
		EXPECT_NEAR(Irradiance, 4.0, 0.005 * 4.0);
		const double SinRadius = std::sin(glm::radians(Diameter) / 2);
		EXPECT_NEAR(Picture.At(Size / 2, Size / 2, 1), 4.0 / (Pi * SinRadius * SinRadius), 1e-3 * Picture.At(Size / 2, Size / 2, 1));
		EXPECT_EQ(Picture.At(1, 1, 1), 0.0f);
	}
}

/// ∫ of single-scattering GGX over the sphere of outgoing directions, F = 1, by a grid over visible normals: with
/// their density the integrand is G2/G1 alone (Heitz 2018), smooth at every roughness.
double IntegrateGgxAlbedo(double Mu, double Alpha)
{
	const auto Lambda = [&](double Cos) { return 0.5 * (std::sqrt(1.0 + Alpha * Alpha * (1.0 / (Cos * Cos) - 1.0)) - 1.0); };
	constexpr int Grid = 400;
	const glm::dvec3 V(std::sqrt(1.0 - Mu * Mu), 0, Mu);
	const glm::dvec3 Vh = glm::normalize(glm::dvec3(Alpha * V.x, 0, V.z));
	double Sum = 0.0;
	for (int I = 0; I < Grid; ++I)
	{
		for (int J = 0; J < Grid; ++J)
		{
			const double Phi = 2.0 * Pi * (I + 0.5) / Grid;
			const double Z = 1.0 - (J + 0.5) / Grid * (1.0 + Vh.z), Sin = std::sqrt(std::max(0.0, 1.0 - Z * Z));
			const glm::dvec3 Cap(Sin * std::cos(Phi) + Vh.x, Sin * std::sin(Phi), Z + Vh.z);
			const glm::dvec3 H = glm::normalize(glm::dvec3(Alpha * Cap.x, Alpha * Cap.y, std::max(Cap.z, 1e-12)));
			const double CosOut = 2.0 * glm::dot(V, H) * H.z - V.z;
			if (CosOut > 0.0) { Sum += (1.0 + Lambda(Mu)) / (1.0 + Lambda(Mu) + Lambda(CosOut)); }
		}
	}
	return Sum / (double(Grid) * Grid);
}

// Sky sampling and BRDF sampling are combined; if their densities disagreed anywhere, energy would be lost or made.
// From mirrors, which only one of the two can find, to α = 1, where both compete everywhere.
TEST_F(FReferenceTest, CombinedStrategiesKeepEnergy)
{
	for (const double Roughness : {0.0, 0.02, 0.1, 0.5, 1.0})
	{
		for (const double Mu : {0.15, 0.7})
		{
			ASSERT_TRUE(Load(fmt::format("ggx:{}:{}", Roughness, Mu)));
			const double Expected = Roughness > 0.0 ? IntegrateGgxAlbedo(Mu, Roughness * Roughness) : 1.0;
			const std::string Name = fmt::format("white metal under a sky, roughness {}, mu {}", Roughness, Mu);
			ExpectClosedForm(Name.c_str(), EstimateMean(MakeView(32, 32), 16, 1), Expected, 0.005);
		}
	}
}

// The same for the sun: a wide disk is found by both strategies, in a mirror by BRDF sampling alone.
TEST_F(FReferenceTest, SunInMetals)
{
	ASSERT_TRUE(Load("ggx:0:0.7"));
	SetSky(glm::vec3(0));
	// Seen in the mirror exactly where the camera looks.
	const double Mu = 0.7, Sin = std::sqrt(1.0 - Mu * Mu);
	SetSun(4.0, 3.0f, {0, -Mu, Sin});
	const double SinRadius = std::sin(glm::radians(2.0));
	const FImage Mirror = TraceReference(MakeView(16, 16), 4, 1);
	EXPECT_NEAR(MeanGreen(Mirror), 3.0 / (Pi * SinRadius * SinRadius), 2e-3 * MeanGreen(Mirror));
}

// Multiple importance sampling must not depend on how the light is cut: a light of one quad and the same one of many,
// near a glossy surface.
TEST_F(FReferenceTest, EmitterCutIntoPiecesShinesTheSame)
{
	FEstimate Estimates[2];
	for (int Case = 0; Case < 2; ++Case)
	{
		FTestScene Pair("pieces");
		FHostMaterial Glossy;
		Glossy.Metallic = 1.0f;
		Glossy.Roughness = 0.3f;
		const int32_t Floor = Pair.AddMaterial(Glossy), Light = Pair.AddLambert(glm::vec3(0), glm::vec3(5));
		Pair.AddNode(Pair.AddMesh({FTestScene::MakeFloor(Floor, 4.0f)}));
		std::vector<FTestScene::FQuad> Pieces;
		const int Count = Case == 0 ? 1 : 5;
		for (int I = 0; I < Count; ++I)
		{
			for (int J = 0; J < Count; ++J)
			{
				const float Half = 0.5f / float(Count);
				FTestScene::FQuad Quad = FTestScene::MakeFloor(Light, Half, 0.7f, {(2 * I + 1) * Half - 0.5f, (2 * J + 1) * Half - 1.5f});
				std::swap(Quad.P[1], Quad.P[3]); // faces down
				Pieces.push_back(Quad);
			}
		}
		Pair.AddNode(Pair.AddMesh(Pieces));
		ASSERT_TRUE(Load(std::move(Pair.Scene)));
		FView View = LookAt({0, 0.8, 1.6}, {0, 0, 0}, 0.5f, 32, 32);
		Estimates[Case] = EstimateMean(View, 24, 1);
	}
	const double Sigma = std::hypot(Estimates[0].StandardError, Estimates[1].StandardError);
	PrintFigure(
	    fmt::format("emitter whole {:.5f}, in pieces {:.5f} (statistical error {:.5f})", Estimates[0].Mean, Estimates[1].Mean, Sigma));
	EXPECT_NEAR(Estimates[0].Mean, Estimates[1].Mean, 3.5 * Sigma);
	EXPECT_LT(Sigma, 0.005 * Estimates[0].Mean);
}

} // namespace
} // namespace Lantern
