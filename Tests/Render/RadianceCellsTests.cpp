// Diffuse GI by paths that end in radiance cells: closed forms of all bounces, brute force of many, walls without thickness, tables that
// are too small, cuts, poison, and the same bits again.
#include <cmath>

#include "CachedGIFixture.h"
#include "LanternCore/Config/ConsoleVariables.h"

namespace Lantern
{

namespace
{

class FRadianceCellsTest : public FCachedGITest
{
protected:
	void SetUp() override
	{
		FSignalTest::SetUp();
		SetRoute("3");
	}

	/// Mean of the green channel of settled frames, from runs with seeds of their own.
	FEstimate EstimateSettled(FView View, const std::string& Scene, uint32_t Warm = WarmFrames)
	{
		std::vector<double> Means;
		for (uint32_t Seed = 1; Seed <= 6; ++Seed)
		{
			EXPECT_TRUE(Load(Scene)); // an empty table
			View.Seed = Seed;
			Means.push_back(MeanGreen(RenderSettled(View, 8, Warm)));
		}
		return MakeEstimate(Means);
	}
};

// Le / (1 − ρ) from everywhere.
TEST_F(FRadianceCellsTest, FurnaceOfAllBounces)
{
	ASSERT_TRUE(Load("furnace:0.5"));
	SetVariable("r.RT.Lights.Emissive", "0"); // local lights would have the walls' own light
	ExpectClosedForm("furnace through cells", EstimateSettled(MakeView(24, 24), "furnace:0.5"), 1.0, 0.02);
}

// In a bright room, light comes by dozens of surfaces. What a new table's paths lose would be missing for seconds: an eighth, if they ended
// at the third surface.
TEST_F(FRadianceCellsTest, NewTableHasTheLightOfBrightRooms)
{
	constexpr const char* Scene = "furnace:0.9";
	ASSERT_TRUE(Load(Scene));
	SetVariable("r.RT.Lights.Emissive", "0");
	SetVariable("r.RT.GI.Cells.UpdatesPerSecond", "2500000");
	ExpectClosedForm("bright furnace through cells", EstimateSettled(MakeView(24, 24), Scene), 5.0, 0.02);
}

// Φ/S ρ / (1 − ρ) / π: the point light's own light is not in it.
TEST_F(FRadianceCellsTest, SphereOfAllBounces)
{
	// Each update carries light one surface further, so a brighter room takes longer.
	for (const auto& [Albedo, Warm] : {std::pair(0.5, 48u), std::pair(0.7, 160u)})
	{
		const std::string Scene = fmt::format("sphere:{}", Albedo);
		ASSERT_TRUE(Load(Scene));
		const double Expected = 10000.0 / 96.0 * Albedo / (1.0 - Albedo) / Pi;
		ExpectClosedForm(fmt::format("{} through cells", Scene).c_str(), EstimateSettled(MakeView(24, 24), Scene, Warm), Expected, 0.02);
	}
}

// The bias floor of what is kept: one sample a pixel, against paths of ten bounces without cells.
TEST_F(FRadianceCellsTest, CornellAsBruteForce)
{
	REQUIRE_SCENE(Scene, "cornell/cornell.gltf");
	ASSERT_TRUE(Load(Scene));
	const FView View = MakeView(48, 48);
	SetVariable("r.RT.GI.Cells.SizeAngle", "0.02");
	SetVariable("r.RT.GI.Cells.UpdatesPerSecond", "1000000");
	const FImage Reference = TraceSignal(ESignal::DiffuseGI, View, 512, 11);
	for (const char* const Path : {"1", "2"}) // pipeline, queries
	{
		SCOPED_TRACE(Path);
		SetVariable("r.RT.GI.Path", Path);
		ASSERT_TRUE(Load(Scene));
		const FImage Cells = RenderSettled(View, 48);
		EXPECT_EQ(CountNonFinitePixels(Cells), 0u);
		const double Ratio = ComputeMeans(Cells).Luminance / ComputeMeans(Reference).Luminance;
		const std::vector<double> Ours = ComputeBlockMeans(Cells, 16), Theirs = ComputeBlockMeans(Reference, 16);
		std::vector<double> Errors;
		for (size_t Block = 0; Block < Ours.size(); ++Block) { Errors.push_back(std::abs(Ours[Block] / Theirs[Block] - 1.0)); }
		const double Median = ComputePercentile(Errors, 0.5);
		PrintFigure(fmt::format("cornell through cells, path {}: mean / reference {:.4f}, block median {:.4f}", Path, Ratio, Median));
		EXPECT_NEAR(Ratio, 1.0, 0.02);
		EXPECT_LT(Median, 0.03);
	}
}

/// A closed room whose walls have no thickness, in full sun above a ground, which sees the walls from outside.
FSceneDescription MakeSealedRoom()
{
	FTestScene Room("sealed");
	FHostMaterial White;
	White.BaseColor = glm::vec4(0.8f, 0.8f, 0.8f, 1.0f);
	White.Roughness = 1.0f;
	White.Metallic = 0.0f;
	White.bDoubleSided = true;
	const int32_t Wall = Room.AddMaterial(White);
	const auto Quad = [&](glm::vec3 A, glm::vec3 B, glm::vec3 C, glm::vec3 D) { return FTestScene::FQuad{Wall, {A, B, C, D}}; };
	Room.AddNode(Room.AddMesh({FTestScene::MakeFloor(Wall, 8.0f, -1.0f), Quad({-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}),
	    Quad({-2, 3, 2}, {-2, 3, -2}, {2, 3, -2}, {2, 3, 2}), Quad({-2, 0, -2}, {2, 0, -2}, {2, 3, -2}, {-2, 3, -2}),
	    Quad({-2, 0, 2}, {-2, 3, 2}, {2, 3, 2}, {2, 0, 2}), Quad({-2, 0, -2}, {-2, 3, -2}, {-2, 3, 2}, {-2, 0, 2}),
	    Quad({2, 0, -2}, {2, 0, 2}, {2, 3, 2}, {2, 3, -2})}));
	return std::move(Room.Scene);
}

// A wall that the sun grazes mirrors it down to the floor. The planted fault sends that light everywhere.
TEST_F(FRadianceCellsTest, GlossyWallMirrorsTheSun)
{
	for (const bool bDirection : {true, false})
	{
		LoadGlossyWall(bDirection);
		SetVariable("r.RT.GI.Samples", "16");
		const FView View = LookAtGlossyWall();
		const double Reference = MeanGreen(TraceSignal(ESignal::DiffuseGI, View, 1024, 4));
		const double Ratio = MeanGreen(RenderSettled(View)) / Reference;
		fmt::print("[  figure  ] floor before a glossy wall, cells with directions {}: mean / reference {:.4f}\n", bDirection, Ratio);
		if (bDirection) { EXPECT_NEAR(Ratio, 1.0, 0.05); }
		else { EXPECT_LT(Ratio, 0.85); }
	}
}

TEST_F(FRadianceCellsTest, NoLightThroughWallsWithoutThickness)
{
	for (const bool bLayers : {true, false})
	{
		ASSERT_TRUE(Load(MakeSealedRoom()));
		SetVariable("r.RT.Debug.GI.Layers", bLayers ? "1" : "0");
		SetVariable("r.RT.GI.Cells.SizeAngle", "0.002"); // inside and outside have cells of one size
		SetSun(0.0, 10.0f);
		SetSky(glm::vec3(1));
		// Outside first, so that the walls' outer sides have cells that are lit.
		const double Outside = MeanGreen(RenderSettled(LookAt({5, 2, 6}, {0, 1.5, 0}, 1.0f, 32, 24)));
		const double Inside = MeanGreen(RenderSettled(LookAt({1.5, 1.5, 1.5}, {-1, 1, -1}, 1.2f, 32, 24)));
		PrintFigure(fmt::format("sealed room, layers {}: inside / outside {:.2e}", bLayers, Inside / Outside));
		if (bLayers) { EXPECT_LT(Inside / Outside, 1e-3); }
		else { EXPECT_GT(Inside / Outside, 1e-3) << "the planted fault must be seen"; }
	}
}

// The sun lights a floor in front of a wall without thickness, and the floor runs on behind it, where no light comes. Cells of the floor lie
// on both sides, and what looks them up sees one of them alone.
TEST_F(FRadianceCellsTest, NoLightUnderAWallThatStandsOnAFloor)
{
	FTestScene Scene("wall on a floor");
	const int32_t White = Scene.AddLambert(glm::vec3(0.8f));
	const auto MakeWall = [&](float Z, float Height) -> FTestScene::FQuad {
		return {White, {{-4, 0, Z}, {4, 0, Z}, {4, Height, Z}, {-4, Height, Z}}};
	};
	Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(White, 4.0f), MakeWall(0.0f, 3.0f), MakeWall(-3.0f, 2.4f)}));
	ASSERT_TRUE(Load(Scene.Scene));
	SetSky(glm::vec3(0));
	SetSun(0.0, 8.0f, {0, -0.17, -0.985});
	const FView View = LookAt({0, 9, 3}, {0, 1, -1.5}, 0.6f, 48, 48);
	const FImage Reference = TraceSignal(ESignal::DiffuseGI, View, 64, 11);
	double Behind[2];
	for (const bool bSight : {false, true})
	{
		SetVariable("r.RT.GI.Cells.Sight", bSight ? "1" : "0");
		constexpr uint32_t Warm = 300;
		RenderSignal(ESignal::DiffuseGI, View, Warm);
		const FImage Picture = RenderSignal(ESignal::DiffuseGI, View, 16, Warm);
		double Dark = 0.0, Lit = 0.0;
		size_t DarkPixels = 0;
		for (size_t P = 0; P < Picture.Pixels.size(); P += 3)
		{
			const bool bDark = Reference.Pixels[P] <= 0.0f;
			(bDark ? Dark : Lit) += Picture.Pixels[P];
			DarkPixels += bDark ? 1 : 0;
		}
		ASSERT_GT(DarkPixels, 500u);
		ASSERT_GT(Lit, 0.0);
		Behind[bSight] = Dark / double(DarkPixels) / (Lit / double(Picture.Pixels.size() / 3 - DarkPixels));
		PrintFigure(fmt::format("wall on a floor, sight {}: behind / before {:.2e}", bSight, Behind[bSight]));
	}
	EXPECT_LT(Behind[true], 1.0e-3); // design, case 1, for walls without thickness
	EXPECT_GT(Behind[false], 3.0e-3) << "what is tested shows";
}

// Behind a turn of the camera, the cells that it saw live on. Updates are for those that paths ask for.
TEST_F(FRadianceCellsTest, WhatNobodyAsksForWaits)
{
	SetVariable("r.RT.GI.Cells.Count", "1");
	SetVariable("r.RT.GI.Cells.UpdatesPerSecond", "10000000");
	SetVariable("r.RT.GI.Cells.Rounds", "1"); // counts are those of all rounds
	for (const bool bAskedFirst : {true, false})
	{
		SetVariable("r.RT.Debug.GI.AskedFirst", bAskedFirst ? "1" : "0");
		ASSERT_TRUE(Load(MakeSealedRoom()));
		SetSun(0.0, 10.0f);
		SetSky(glm::vec3(1));
		RenderSettled(LookAt({6, 3, 6}, {0, 1, 0}, 0.9f, 48, 48), 1);
		const uint32_t Live = GetEngine().GetRenderer().GetRadianceCells().Live;
		RenderSignal(ESignal::DiffuseGI, LookAt({6, 3, 6}, {6, 9, 6.1}, 0.9f, 48, 48), 16, WarmFrames + 1);
		const FRadianceCellCounts Behind = GetEngine().GetRenderer().GetRadianceCells();
		PrintFigure(fmt::format("cells that nobody asks for, asked first {}: {} live, then {}, and {} updated", bAskedFirst, Live,
		    Behind.Live, Behind.Updated));
		ASSERT_GT(Live, 100u);
		EXPECT_GT(Behind.Live, Live * 9 / 10);
		// The paths of updates ask for some.
		if (bAskedFirst) { EXPECT_LT(Behind.Updated, Behind.Live / 3); }
		else { EXPECT_GT(Behind.Updated, Behind.Live / 2); }
	}
}

// More cells than there is room for: buckets overflow, and what finds no cell is lit by itself.
TEST_F(FRadianceCellsTest, TablesThatAreTooSmall)
{
	REQUIRE_SCENE(Scene, "cornell/cornell.gltf");
	ASSERT_TRUE(Load(Scene));
	SetVariable("r.RT.GI.Cells.SizeAngle", "0.002");
	const FView View = MakeView(48, 48);
	const double Reference = MeanGreen(TraceSignal(ESignal::DiffuseGI, View, 256, 11));
	for (const char* Capacity : {"256", "1000", "4096"})
	{
		SetVariable("r.RT.GI.Cells.Capacity", Capacity);
		const FImage Picture = RenderSettled(View, 16);
		const double Ratio = MeanGreen(Picture) / Reference;
		PrintFigure(fmt::format("cornell, room for {} cells: mean / reference {:.4f}", Capacity, Ratio));
		EXPECT_EQ(CountNonFinitePixels(Picture), 0u) << Capacity;
		// Paths of three bounces stand in where there is no room, and lack the fourth and on.
		EXPECT_GT(Ratio, 0.88) << Capacity;
		EXPECT_LT(Ratio, 1.05) << Capacity;
	}
}

TEST_F(FRadianceCellsTest, PoisonIsGoneAndReachesNoPicture)
{
	ASSERT_TRUE(Load("furnace:0.5"));
	SetVariable("r.RT.Lights.Emissive", "0");
	const FView View = MakeView(24, 24);
	RenderSettled(View, 1);
	SetVariable("r.RT.Debug.PoisonHistory", "7");
	const FImage Picture = RenderSignal(ESignal::DiffuseGI, View, 14, WarmFrames + 1);
	EXPECT_EQ(CountNonFinitePixels(Picture), 0u);
	EXPECT_NEAR(MeanGreen(Picture), 1.0, 0.1) << "without cells, paths of three bounces stand in";
}

// A cut keeps the cells: the first frame behind it has all bounces. The paths that stand in for cells have 94 % of them.
TEST_F(FRadianceCellsTest, ACutKeepsThem)
{
	ASSERT_TRUE(Load("furnace:0.5"));
	SetVariable("r.RT.Lights.Emissive", "0");
	FView View = MakeView(48, 48);
	RenderSettled(View, 1);
	View.bCut = true;
	const double Behind = MeanGreen(RenderSignal(ESignal::DiffuseGI, View, 1, WarmFrames + 1));
	ASSERT_TRUE(Load("furnace:0.5"));
	const double Fresh = MeanGreen(RenderSignal(ESignal::DiffuseGI, View, 1, WarmFrames + 1));
	PrintFigure(fmt::format("furnace behind a cut {:.4f}, with an empty table {:.4f}", Behind, Fresh));
	EXPECT_NEAR(Behind, 1.0, 0.02);
	EXPECT_LT(Fresh, 0.97);
}

TEST_F(FRadianceCellsTest, TheSameBitsAgain)
{
	REQUIRE_SCENE(Scene, "cornell/cornell.gltf");
	const FView View = LookAt({0, 1, 3.4}, {0, 1, 0}, 0.7f, 32, 32);
	for (const char* const Sight : {"0", "1"})
	{
		SetVariable("r.RT.GI.Cells.Sight", Sight);
		ExpectTheSameBitsAgain(Scene, View);
	}
}

// Far more cells ask for room than there is: which of them get it must not depend on the order of threads.
TEST_F(FRadianceCellsTest, TheSameBitsAgainWithAFullTable)
{
	REQUIRE_SCENE(Scene, "cornell/cornell.gltf");
	SetVariable("r.RT.GI.Cells.Capacity", "512");
	SetVariable("r.RT.GI.Cells.UpdatesPerSecond", "1000000");
	SetVariable("r.RT.GI.Cells.Count", "1");
	ExpectTheSameBitsAgain(Scene, LookAt({0, 1, 3.4}, {0, 1, 0}, 0.7f, 32, 32));
	EXPECT_GT(GetEngine().GetRenderer().GetRadianceCells().Full, 100u) << "the table is full";
}

} // namespace

} // namespace Lantern
