// Emissive triangles as local lights: against the reference, alone and beside lamps, and the sum of all signals against the whole frame.
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "SignalFixture.h"

namespace Lantern
{

namespace
{
constexpr ESignal Lobes[] = {ESignal::LocalDiffuse, ESignal::LocalSpecular};

class FEmittersTest : public FSignalTest
{
protected:
	void SetUp() override
	{
		FSignalTest::SetUp();
		SetVariable("r.RT.Lights.Denoise", "0"); // the filter weighs outliers less
	}
	static FRTScene& GetWorld() { return GetScene().GetScene(); }
	static int32_t AddShiny(FTestScene& Scene, float Roughness)
	{
		FHostMaterial Material;
		Material.BaseColor = glm::vec4(0.6f, 0.4f, 0.3f, 1.0f);
		Material.Metallic = 0.0f;
		Material.Roughness = Roughness;
		return Scene.AddMaterial(Material);
	}
	/// A floor in stripes of four roughnesses, and posts on it. G-buffers hold these exactly: at 0.25 the share of reflections follows the
	/// roughness fifteen times as fast.
	static FTestScene MakeStage()
	{
		FTestScene Scene("stage");
		std::vector<FTestScene::FQuad> Floor;
		for (const float Roughness : {38.0f / 255.0f, 64.0f / 255.0f, 102.0f / 255.0f, 1.0f})
		{
			const float X = -3.0f + 2.0f * float(Floor.size());
			Floor.push_back(FTestScene::MakeFloor(AddShiny(Scene, Roughness), 1.0f, 0.0f, {X, 0}));
		}
		Scene.AddNode(Scene.AddMesh(Floor));
		const int32_t Post = Scene.AddMesh(
		    {{Scene.AddLambert(glm::vec3(0.5f), glm::vec3(0), true), {{-0.2f, 0, 0}, {0.2f, 0, 0}, {0.2f, 0.8f, 0}, {-0.2f, 0.8f, 0}}}});
		for (const glm::dvec3 At : {glm::dvec3(-1.2, 0, 0.2), {0.5, 0, -0.4}, {1.8, 0, 0.3}})
		{
			Scene.AddNode(Post, glm::translate(glm::dmat4(1), At));
		}
		return Scene;
	}
	/// Facing down.
	static FTestScene::FQuad MakePanel(int32_t Material, float Half, float Height, glm::vec2 Center)
	{
		FTestScene::FQuad Quad = FTestScene::MakeFloor(Material, Half, Height, Center);
		std::reverse(std::begin(Quad.P), std::end(Quad.P));
		return Quad;
	}
	/// Boxes of five bright sides, in a grid.
	static void AddCandles(FTestScene& Scene, int Rows)
	{
		const int32_t Bright = Scene.AddLambert(glm::vec3(0), glm::vec3(60, 40, 20)),
		              Dim = Scene.AddLambert(glm::vec3(0), glm::vec3(4, 6, 8));
		int32_t Candles[2];
		for (const int32_t Material : {Bright, Dim})
		{
			constexpr float R = 0.01f, H = 0.1f;
			Candles[Material == Dim] = Scene.AddMesh({FTestScene::MakeFloor(Material, R, H),
			    {Material, {{-R, 0, R}, {R, 0, R}, {R, H, R}, {-R, H, R}}}, {Material, {{R, 0, -R}, {-R, 0, -R}, {-R, H, -R}, {R, H, -R}}},
			    {Material, {{R, 0, R}, {R, 0, -R}, {R, H, -R}, {R, H, R}}},
			    {Material, {{-R, 0, -R}, {-R, 0, R}, {-R, H, R}, {-R, H, -R}}}});
		}
		for (int I = 0; I < Rows * Rows; ++I)
		{
			const glm::dvec3 At(-3.0 + 6.0 * (I % Rows) / Rows, 1.0 + 0.1 * (I % 5), -1.0 + 2.0 * (I / Rows) / double(Rows));
			Scene.AddNode(Candles[I % 3 == 0 ? 0 : 1], glm::translate(glm::dmat4(1), At));
		}
	}
	[[nodiscard]] bool LoadDark(FTestScene& Scene)
	{
		if (!Load(std::move(Scene.Scene))) { return false; }
		SetSun(0.0, 0.0f);
		SetSky(glm::vec3(0));
		return true;
	}
	[[nodiscard]] bool LoadPanels()
	{
		FTestScene Scene = MakeStage();
		const int32_t Warm = Scene.AddLambert(glm::vec3(0), glm::vec3(9, 7, 5)), Cold = Scene.AddLambert(glm::vec3(0), glm::vec3(3, 4, 6));
		Scene.AddNode(Scene.AddMesh({MakePanel(Warm, 0.3f, 1.2f, {-1, 0})}));
		Scene.AddNode(Scene.AddMesh({MakePanel(Cold, 0.15f, 0.6f, {1.4f, 0.2f})}));
		return LoadDark(Scene);
	}
	static void AddLamps(uint32_t Count)
	{
		for (uint32_t I = 0; I < Count; ++I)
		{
			FSceneLight Light;
			Light.Position = {2.5 * std::cos(2.4 * I), 0.6 + 0.05 * (I % 7), 0.8 * std::sin(2.4 * I)};
			Light.Color = glm::vec3(1.0f, 1.5f, 0.7f) * (2.0f / float(Count));
			(void)GetWorld().AddLight(Light);
		}
	}
	static FView LookAtStage(uint32_t Width, uint32_t Height) { return LookAt({0, 2.2, 3.4}, {0, 0.1, 0}, 0.9f, Width, Height); }
};

using FEmittersSlowTest = FEmittersTest;

TEST_F(FEmittersTest, PanelsAsTheReference)
{
	ASSERT_TRUE(LoadPanels());
	const FView View = LookAtStage(48, 27);
	for (const char* const Reflections : {"0", "2"})
	{
		SetVariable("r.RT.Reflections", Reflections);
		for (const ESignal Lobe : Lobes)
		{
			const std::string Name = fmt::format("panels, reflections {}, {}", Reflections, GetSignalInfo(Lobe).Name);
			ExpectUnbiased(Name.c_str(), Lobe, View, 128, 768, 1, Lobe == ESignal::LocalDiffuse ? 0.005 : 0.01);
		}
	}
	ExpectUnbiased("panels, reflections", ESignal::Reflections, View, 128, 768, 2, 0.01);
	// Narrow lobes alone are left to reflections that stop at this roughness.
	SetVariable("r.RT.Reflections.MaxRoughness", "0.2");
	ExpectUnbiased("panels, reflections up to 0.2", ESignal::LocalSpecular, View, 128, 768, 1, 0.01);
}

// Few lamps have rays of their own beside that of the triangle; many are chosen from together with triangles.
TEST_F(FEmittersSlowTest, BesideLampsAsTheReference)
{
	for (const uint32_t Count : {3u, 16u})
	{
		ASSERT_TRUE(LoadPanels());
		AddLamps(Count);
		ExpectUnbiased(fmt::format("panels and {} lamps", Count).c_str(), ESignal::LocalDiffuse, LookAtStage(64, 36), 128, 512, 1, 0.005);
	}
}

TEST_F(FEmittersSlowTest, ThousandsAsTheReference)
{
	FTestScene Scene = MakeStage();
	AddCandles(Scene, 40);
	ASSERT_TRUE(LoadDark(Scene));
	for (const char* const Unbiased : {"0", "1"})
	{
		SetVariable("r.RT.Lights.Unbiased", Unbiased);
		ExpectUnbiased(
		    fmt::format("16,000 triangles, unbiased {}", Unbiased).c_str(), ESignal::LocalDiffuse, LookAtStage(48, 27), 96, 768, 1, 0.005);
	}
	EXPECT_EQ(GetWorld().GetFacts().EmissiveTriangles, 16000u);
}

// Where emitters are dim, pixels ask for rays in some frames alone, which stand for the others. Planted fault: they stand for one.
TEST_F(FEmittersTest, DimLightIsAskedForInTurn)
{
	ASSERT_TRUE(LoadPanels());
	SetVariable("r.RT.Rays.Count", "1");
	const FView View = LookAtStage(48, 27);
	constexpr uint32_t Frames = 384, Batches = 6;
	FRenderer& Renderer = GetEngine().GetRenderer();
	const auto Measure = [&](const char* Dim, double& OutRays) {
		SetVariable("r.RT.Lights.DimEmitters", Dim);
		EXPECT_OK(Renderer.WaitForAll());
		const uint64_t Before = Renderer.GetRayCounts().Total;
		const FEstimate Light = EstimateFrames(ESignal::LocalDiffuse, View, Frames, Batches);
		EXPECT_OK(Renderer.WaitForAll());
		OutRays = double(Renderer.GetRayCounts().Total - Before) / (double(View.Width) * View.Height * Frames * Batches);
		return Light;
	};
	double AllRays = 0.0, SomeRays = 0.0, FaultyRays = 0.0;
	const FEstimate All = Measure("0", AllRays), Some = Measure("1", SomeRays);
	const double Sigma = std::hypot(All.StandardError, Some.StandardError) / All.Mean;
	PrintFigure(fmt::format("dim light: {:.2f} rays a pixel instead of {:.2f}, mean {:.4f} times (statistical error {:.4f})", SomeRays,
	    AllRays, Some.Mean / All.Mean, Sigma));
	EXPECT_LT(SomeRays, 0.6 * AllRays);
	EXPECT_NEAR(Some.Mean / All.Mean, 1.0, 0.005 + 3.0 * Sigma);
	SetVariable("r.RT.Debug.Lights.Weight", "0");
	EXPECT_LT(Measure("1", FaultyRays).Mean, 0.8 * All.Mean);
}

// The filter keeps what comes in few frames, though most of them are dark.
TEST_F(FEmittersTest, DimLightIsNotFilteredAway)
{
	ASSERT_TRUE(LoadPanels());
	SetVariable("r.RT.Lights.Denoise", "1");
	const FView View = LookAtStage(48, 27);
	const auto Measure = [&](const char* Dim) {
		SetVariable("r.RT.Lights.DimEmitters", Dim);
		GetEngine().SetFrameIndex(0);
		return MeanGreen(RenderSignal(ESignal::LocalDiffuse, View, 480, 120)); // behind 120 that are not looked at
	};
	const double All = Measure("0"), Some = Measure("1");
	PrintFigure(fmt::format("dim light behind the filter: mean {:.4f} times", Some / All));
	EXPECT_NEAR(Some / All, 1.0, 0.05);
}

// What the alpha test cuts away does not shine, and both sides do.
TEST_F(FEmittersSlowTest, HalfCutPanelAsTheReference)
{
	FTestScene Scene = MakeStage();
	const int32_t Half = Scene.AddHalfCutLambert();
	Scene.Scene.Materials[size_t(Half)].Emissive = glm::vec3(8);
	Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Half, 0.5f, 1.0f, {0, 0})}));
	ASSERT_TRUE(LoadDark(Scene));
	for (const char* const Path : {"1", "2"})
	{
		SetVariable("r.RT.Shadow.Path", Path);
		ExpectUnbiased(fmt::format("half a panel, path {}", Path).c_str(), ESignal::LocalDiffuse, LookAtStage(48, 27), 128, 512, 1, 0.005);
	}
}

// Nothing is counted twice or left out: by the composite of all signals, with and without those that emission is taken from.
TEST_F(FEmittersTest, SumOfSignalsAsTheWholeFrame)
{
	ASSERT_TRUE(LoadPanels());
	AddLamps(3);
	const FView View = LookAtStage(64, 36);
	SetIndirect(4, 1);
	ExpectUnbiased("panels, all signals", ESignal::Frame, View, 32, 256, 2, 0.005);
	const double Right = EstimateFrames(ESignal::Frame, View, 4, 2).Mean;
	SetVariable("r.RT.Debug.Lights.EmissiveTwice", "1");
	EXPECT_GT(EstimateFrames(ESignal::Frame, View, 4, 2).Mean, 1.05 * Right);
	SetVariable("r.RT.Debug.Lights.EmissiveTwice", "0");
	// Global illumination then holds all of it again.
	SetVariable("r.RT.Lights.Emissive", "0");
	ExpectUnbiased("panels, all signals, no light sampling", ESignal::Frame, View, 32, 256, 2, 0.005);
}

// Lanterns whose lamps shine on what is next to them: much noise.
TEST_F(FEmittersSlowTest, CourtyardAtNight)
{
	ASSERT_TRUE(Load("courtyard"));
	SetSun(0.0, 0.0f);
	SetSky(glm::vec3(0));
	SetVariable("r.RT.AlphaTest", "0"); // raster asks coarser levels of textures than rays do
	SetIndirect(4, 1);
	// Means alone: blocks differ by the level of detail of their textures.
	const FView View = MakeView(64, 36);
	const FEstimate Frames = EstimateFrames(ESignal::Frame, View, 96, 6), Right = EstimateSignal(ESignal::Frame, View, 768, 2, 6);
	const double Ratio = Frames.Mean / Right.Mean, Sigma = std::hypot(Frames.StandardError, Right.StandardError) / Right.Mean;
	PrintFigure(fmt::format("courtyard at night, all signals: frame / reference {:.5f} (statistical error {:.5f})", Ratio, Sigma));
	EXPECT_NEAR(Ratio, 1.0, 0.005 + 3.0 * Sigma);
	EXPECT_LT(Sigma, 0.005);
}

TEST_F(FEmittersTest, SignalsAreThereOnlyIfSomethingShines)
{
	ASSERT_TRUE(LoadPanels());
	const FView View = LookAtStage(16, 9);
	EXPECT_TRUE(HasSignal(ESignal::LocalDiffuse, View));
	SetVariable("r.RT.Lights.Emissive", "0");
	EXPECT_FALSE(HasSignal(ESignal::LocalDiffuse, View));
	FTestScene Dark = MakeStage();
	ASSERT_TRUE(LoadDark(Dark));
	SetVariable("r.RT.Lights.Emissive", "1");
	EXPECT_FALSE(HasSignal(ESignal::LocalDiffuse, View));
}

// A panel that is moved lights its new place in the same frame.
TEST_F(FEmittersTest, LightFollowsItsObject)
{
	const auto Place = [](double X) { return glm::translate(glm::dmat4(1), glm::dvec3(X, 0, 0)); };
	const auto LoadAt = [&](double X) {
		FTestScene Scene = MakeStage();
		const int32_t Bright = Scene.AddLambert(glm::vec3(0), glm::vec3(9));
		Scene.AddNode(Scene.AddMesh({MakePanel(Bright, 0.2f, 0.7f, {0, 0})}), Place(X));
		return LoadDark(Scene);
	};
	const FView View = LookAtStage(64, 36);
	ASSERT_TRUE(LoadAt(2.0));
	const FImage Right = RenderSignal(ESignal::LocalDiffuse, View, 1, 1);
	ASSERT_TRUE(LoadAt(-2.0));
	const FImage Before = RenderSignal(ESignal::LocalDiffuse, View, 1, 0);
	GetScene().SetTransform(4, Place(2.0)); // behind floor and posts
	const FImage After = RenderSignal(ESignal::LocalDiffuse, View, 1, 1);
	const auto SumHalf = [](const FImage& Image, uint32_t First) {
		double Sum = 0.0;
		for (uint32_t Y = 0; Y < Image.Height; ++Y)
		{
			for (uint32_t X = First; X < First + 32; ++X) { Sum += Image.Pixels[(size_t(Y) * Image.Width + X) * Image.Channels]; }
		}
		return Sum;
	};
	EXPECT_GT(SumHalf(Before, 0), 5.0 * SumHalf(Before, 32));
	EXPECT_GT(SumHalf(After, 32), 5.0 * SumHalf(After, 0));
	EXPECT_NEAR(SumHalf(After, 32) / SumHalf(Right, 32), 1.0, 0.02);
}

// A surface that a bright triangle touches: close points of light are as bright as the light, and no more.
TEST_F(FEmittersTest, TouchingTrianglesAreFinite)
{
	FTestScene Scene = MakeStage();
	const int32_t Bright = Scene.AddLambert(glm::vec3(0), glm::vec3(5), true);
	Scene.AddNode(Scene.AddMesh({{Bright, {{-2, 0, -0.5f}, {2, 0, -0.5f}, {2, 1, -0.5f}, {-2, 1, -0.5f}}}}));
	ASSERT_TRUE(LoadDark(Scene));
	const FView View = LookAt({0, 0.6, 1.0}, {0, 0, -0.5}, 0.6f, 64, 36);
	SetVariable("r.RT.Lights.Unbiased", "1");
	const FImage Picture = RenderSignal(ESignal::LocalDiffuse, View);
	EXPECT_EQ(CountNonFinitePixels(Picture), 0u);
	EXPECT_LT(ComputeMeans(Picture).MaxLuminance, 50.0) << "all brings 5 at most; points by area would bring thousands";
	ExpectUnbiased("a wall that shines", ESignal::LocalDiffuse, View, 128, 768, 1, 0.005);
}

} // namespace
} // namespace Lantern
