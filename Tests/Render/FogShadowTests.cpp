// Light in fog: froxels against shadows cast on the CPU, how soon a change shows, what leaks, and frames that have no history.
#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "FogFixture.h"

namespace Lantern
{
namespace
{

/// A plate over a floor, the sun straight above: what lies under the plate is dark.
class FFogShadowTest : public FFogTest
{
protected:
	static constexpr float Half = 2.0f, Height = 5.0f; // of the plate

	void SetUp() override
	{
		FFogTest::SetUp();
		SetVariable("r.RT.Fog.PixelSize", "4");
		SetVariable("r.RT.Fog.Slices", "64");
		SetVariable("r.RT.Fog.Distance", "60");
	}
	void LoadPlate(const glm::dvec3& At = glm::dvec3(0))
	{
		FTestScene Scene("plate");
		const int32_t Grey = Scene.AddLambert(glm::vec3(0.5f), glm::vec3(0), true);
		Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Grey, 500.0f)}), glm::translate(glm::dmat4(1), At));
		Plate = At;
		Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Grey, Half, Height)}), glm::translate(glm::dmat4(1), At));
		ASSERT_TRUE(Load(std::move(Scene.Scene)));
		SetSun(0.0, 4.0f, {0, -1, 0});
		SetSky(glm::vec3(0));
		GetEngine().SeekTo(0.0); // the first time sets all transforms
	}
	void MovePlate(const glm::dvec3& To)
	{
		Plate = To;
		GetScene().SetTransform(1, glm::translate(glm::dmat4(1), To));
	}
	static FView LookAtPlate(uint32_t Width = 192, uint32_t InHeight = 112)
	{
		return LookAt({3, 2.3, 13.5}, {0, 2.0, 0}, 0.8f, Width, InHeight);
	}
	bool IsLit(const glm::dvec3& P) const
	{
		const glm::dvec3 D = P - Plate;
		return D.y > double(Height) || std::abs(D.x) > double(Half) || std::abs(D.z) > double(Half);
	}
	/// Shares of froxels that are lit, by texel. Negative: the floor or the plate may cut it, and only its part in view is lit.
	std::vector<double> ComputeShares(const FView& View, const FFogPicture& Fog) const
	{
		std::vector<double> Shares(Fog.Visibility.size(), -1.0);
		Fog.ForEach([&](glm::uvec3 Froxel) { Shares[Fog.GetTexel(Froxel)] = ComputeLit(View, Fog.Grid, Froxel); });
		return Shares;
	}
	/// Negative: see ComputeShares.
	double ComputeLit(const FView& View, const FFogGrid& Grid, glm::uvec3 Froxel) const
	{
		constexpr int Steps = 5;
		int Lit = 0;
		for (int I = 0; I < Steps * Steps * Steps; ++I)
		{
			const glm::dvec3 Within(I % Steps, I / Steps % Steps, I / (Steps * Steps));
			const glm::dvec3 P = FroxelToWorld(View, Grid, glm::dvec3(Froxel) + (Within + 0.5) / double(Steps));
			if (P.y - Plate.y < 0.02 || std::abs(P.y - Plate.y - double(Height)) < 0.5) { return -1.0; }
			Lit += IsLit(P) ? 1 : 0;
		}
		return double(Lit) / (Steps * Steps * Steps);
	}
	/// Largest light in froxels that the CPU says are dark, corners included.
	double FindLeak(const FView& View, const FFogPicture& Fog) const
	{
		double Leak = 0.0;
		uint32_t Dark = 0;
		Fog.ForEach([&](glm::uvec3 Froxel) {
			const glm::dvec3 Center = FroxelToWorld(View, Fog.Grid, glm::dvec3(Froxel) + 0.5);
			bool bDark = !IsLit(Center) && Center.y > Plate.y + 0.2;
			for (int Corner = 0; Corner < 8; ++Corner)
			{
				const glm::dvec3 At = glm::dvec3(Froxel) + glm::dvec3(Corner & 1, (Corner >> 1) & 1, Corner >> 2);
				bDark = bDark && !IsLit(FroxelToWorld(View, Fog.Grid, At));
			}
			if (!bDark) { return; }
			++Dark;
			Leak = std::max(Leak, double(Fog.Get(Froxel)));
		});
		EXPECT_GT(Dark, 100u) << "there is nothing to leak into";
		return Leak;
	}

	glm::dvec3 Plate{0};
};

TEST_F(FFogShadowTest, FroxelsSeeTheSharesOfTheCpu)
{
	ASSERT_NO_FATAL_FAILURE(LoadPlate());
	SetVariable("r.RT.Fog.HistorySeconds", "0"); // each ray stands alone
	const FView View = LookAtPlate();
	RenderFog(View, 2);
	constexpr uint32_t Frames = 64;
	const FFogPicture Fog = MeanFog(View, Frames);
	double Sum = 0.0, Squares = 0.0;
	uint32_t Count = 0;
	Fog.ForEach([&](glm::uvec3 Froxel) {
		const double Lit = ComputeLit(View, Fog.Grid, Froxel);
		if (Lit <= 0.0 || Lit >= 1.0) { return; }
		const double Error = double(Fog.Get(Froxel)) - Lit;
		Sum += Error;
		Squares += Error * Error;
		++Count;
	});
	ASSERT_GT(Count, 200u);
	const double Mean = Sum / Count, Rms = std::sqrt(Squares / Count);
	PrintFigure(fmt::format("{} froxels of penumbra: mean error {:.4f}, RMS {:.4f}", Count, Mean, Rms));
	// Half of the frames trace a froxel. Independent rays would leave sqrt(p (1 - p) / 32): 0.088 at worst.
	EXPECT_LT(std::abs(Mean), 0.01);
	EXPECT_LT(Rms, 0.088);
	EXPECT_EQ(FindLeak(View, Fog), 0.0); // corners included
	SetVariable("r.RT.Debug.Fog.Slice", "0");
	EXPECT_GT(FindLeak(View, MeanFog(View, Frames)), 0.1) << "the planted fault is not seen";
}

// Case 23 of the stability cases: a shaft past a moving occluder.
TEST_F(FFogShadowTest, AChangeShowsWithinEightFrames)
{
	ASSERT_NO_FATAL_FAILURE(LoadPlate());
	const FView View = LookAtPlate();
	const auto CountFrames = [&](const char* History) {
		MovePlate({-2.5, 0, 0});
		SetVariable("r.RT.Debug.Fog.History", "1");
		const FFogPicture Before = RenderFog(View, 60);
		SetVariable("r.RT.Debug.Fog.History", History);
		MovePlate({2.5, 0, 0});
		const std::vector<double> Shares = ComputeShares(View, Before);
		for (uint32_t Frame = 1; Frame <= 60; ++Frame)
		{
			const FFogPicture Fog = RenderFog(View);
			double Lag = 0.0, All = 0.0;
			for (size_t I = 0; I < Shares.size(); ++I)
			{
				const double Was = double(Before.Visibility[I]);
				if ((Shares[I] != 0.0 && Shares[I] != 1.0) || std::abs(Shares[I] - Was) < 0.9) { continue; }
				Lag += std::abs(Shares[I] - double(Fog.Visibility[I]));
				All += std::abs(Shares[I] - Was);
			}
			EXPECT_GT(All, 100.0) << "nothing changes";
			if (Lag <= 0.1 * All) { return Frame; }
		}
		return 61u;
	};
	const uint32_t Frames = CountFrames("1");
	PrintFigure(fmt::format("90 % of a change after {} frames", Frames));
	EXPECT_LE(Frames, 8u);
	EXPECT_GT(CountFrames("0"), 30u) << "the planted fault is not seen";
}

// At any frame rate a change takes as long.
TEST_F(FFogShadowTest, ChangesTakeTimeAndNotFrames)
{
	ASSERT_NO_FATAL_FAILURE(LoadPlate());
	for (const uint32_t Rate : {30u, 60u, 144u})
	{
		FView View = LookAtPlate();
		View.DeltaSeconds = 1.0f / float(Rate);
		MovePlate({-2.5, 0, 0});
		const FFogPicture Before = RenderFog(View, 2 * Rate);
		MovePlate({2.5, 0, 0});
		// An even number of frames that ends at about a tenth of a second.
		const uint32_t Frames = 2 * static_cast<uint32_t>(std::lround(0.05 * Rate));
		const FFogPicture Fog = RenderFog(View, Frames);
		double Rest = 0.0, All = 0.0;
		const std::vector<double> Shares = ComputeShares(View, Fog);
		for (size_t I = 0; I < Shares.size(); ++I)
		{
			if (Shares[I] != 0.0 || Before.Visibility[I] < 1.0f) { continue; }
			Rest += double(Fog.Visibility[I]);
			All += 1.0;
		}
		EXPECT_GT(All, 100.0) << "nothing changes";
		const double Expected = std::pow(0.1, Frames / double(Rate) / 0.12);
		PrintFigure(fmt::format("{} frames a second: {:.4f} left of a change, {:.4f} expected", Rate, Rest / All, Expected));
		EXPECT_NEAR(Rest / All, Expected, 0.01);
	}
}

// A closed room in the sun stays dark, whether the camera stands or moves: what its walls cut is lit as its part within.
TEST_F(FFogShadowTest, NothingLeaks)
{
	constexpr float R = 4.0f;
	FTestScene Scene("room");
	const int32_t Grey = Scene.AddLambert(glm::vec3(0.5f), glm::vec3(0), true);
	std::vector<FTestScene::FQuad> Walls{FTestScene::MakeFloor(Grey, R, -R), FTestScene::MakeFloor(Grey, R, R)};
	for (const float Side : {-R, R})
	{
		Walls.push_back({Grey, {{-R, -R, Side}, {R, -R, Side}, {R, R, Side}, {-R, R, Side}}});
		Walls.push_back({Grey, {{Side, -R, -R}, {Side, -R, R}, {Side, R, R}, {Side, R, -R}}});
	}
	Scene.AddNode(Scene.AddMesh(Walls));
	ASSERT_TRUE(Load(std::move(Scene.Scene)));
	SetSun(0.5, 4.0f, {1, -1, 0.6});
	SetSky(glm::vec3(0));
	struct FLeak
	{
		double Within = 0.0, Mean = 0.0, Cut = 0.0; // largest and mean of froxels within the room, mean of those that walls cut
	};
	const auto FindLeak = [&](const FView& View) {
		const FFogPicture Fog = RenderFog(View);
		FLeak Leak;
		uint32_t Within = 0, Cut = 0;
		Fog.ForEach([&](glm::uvec3 Froxel) {
			int Inside = 0;
			for (int Corner = 0; Corner < 8; ++Corner)
			{
				const glm::dvec3 At = glm::dvec3(Froxel) + glm::dvec3(Corner & 1, (Corner >> 1) & 1, Corner >> 2);
				const glm::dvec3 P = glm::abs(FroxelToWorld(View, Fog.Grid, At));
				Inside += std::max({P.x, P.y, P.z}) < double(R) ? 1 : 0;
			}
			const double Seen = double(Fog.Get(Froxel));
			Within += Inside == 8 ? 1 : 0;
			Cut += Inside > 0 && Inside < 8 ? 1 : 0;
			Leak.Within = std::max(Leak.Within, Inside == 8 ? Seen : 0.0);
			Leak.Mean += Inside == 8 ? Seen : 0.0;
			Leak.Cut += Inside > 0 && Inside < 8 ? Seen : 0.0;
		});
		EXPECT_GT(Within, 1000u);
		EXPECT_GT(Cut, 100u);
		Leak.Mean /= Within;
		Leak.Cut /= Cut;
		return Leak;
	};
	FView View = LookAt({-2.5, 1, 2.5}, {1, 0, -4}, 0.8f, 96, 56);
	RenderFog(View, 20);
	const FLeak Standing = FindLeak(View);
	const FView Still = View;
	FLeak Travelling;
	for (int Frame = 0; Frame < 40; ++Frame)
	{
		View.Position += glm::dvec3(0.05, -0.02, 0.02 * (Frame < 20 ? 1 : -1)); // 3 m/s
		const FLeak Now = FindLeak(View);
		Travelling = {std::max(Travelling.Within, Now.Within), std::max(Travelling.Mean, Now.Mean), std::max(Travelling.Cut, Now.Cut)};
	}
	for (const auto& [Name, Leak] : {std::pair("standing", Standing), std::pair("travelling", Travelling)})
	{
		PrintFigure(fmt::format(
		    "{}: froxels within {:.2e}, {:.4f} at most; those that a wall cuts {:.2e}", Name, Leak.Mean, Leak.Within, Leak.Cut));
	}
	EXPECT_LE(Standing.Within, 1e-3);
	EXPECT_LE(Travelling.Mean, 1e-3);
	SetVariable("r.RT.Debug.Fog.Slice", "0");
	RenderFog(Still, 20);
	EXPECT_GT(FindLeak(Still).Within, 0.1) << "the planted fault is not seen";
}

TEST_F(FFogShadowTest, PathsAgreeAndRunsRepeat)
{
	ASSERT_NO_FATAL_FAILURE(LoadPlate());
	FSceneLight Lamp;
	Lamp.Position = {0, 1.5, 1};
	Lamp.Color = glm::vec3(5, 3, 1);
	GetWorld().AddLight(Lamp);
	FView View = LookAtPlate();
	const auto Run = [&](const char* Path) {
		SetVariable("r.RT.Shadow.Path", Path);
		GetEngine().SetFrameIndex(0);
		View.bCut = true;
		RenderFog(View);
		View.bCut = false;
		return RenderFog(View, 5);
	};
	const FFogPicture Pipeline = Run("1"), Query = Run("2"), Again = Run("2");
	ASSERT_FALSE(Query.Visibility.empty());
	ASSERT_FALSE(Query.Light.empty());
	EXPECT_EQ(Pipeline.Visibility, Query.Visibility);
	EXPECT_EQ(Query.Visibility, Again.Visibility);
	EXPECT_EQ(Query.Light, Again.Light);
	EXPECT_EQ(Pipeline.Light, Query.Light);
}

// Each froxel is written, whatever the sizes; nothing is asked of a history that there is not.
TEST_F(FFogShadowTest, OddSizesAndCuts)
{
	FTestScene Scene("speck");
	const int32_t Grey = Scene.AddLambert(glm::vec3(0.5f));
	Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Grey, 0.01f, -50.0f)}));
	ASSERT_TRUE(Load(std::move(Scene.Scene)));
	SetSun(0.5, 4.0f, {0, -1, 0});
	for (const auto& [Width, InHeight] : {std::pair{1u, 1u}, {7u, 5u}, {131u, 73u}, {64u, 64u}, {17u, 1u}})
	{
		for (const auto& [PixelSize, Slices] : {std::pair{"1", "2"}, {"5", "7"}, {"16", "64"}, {"256", "256"}, {"9", "65"}})
		{
			if (PixelSize[0] == '1' && PixelSize[1] == 0 && Width > 17) { continue; } // millions of froxels
			SetVariable("r.RT.Fog.PixelSize", PixelSize);
			SetVariable("r.RT.Fog.Slices", Slices);
			FView View = LookAt({0, 2, 0}, {0, 2.5, -1}, 0.8f, Width, InHeight);
			for (const bool bCut : {false, true, false})
			{
				View.bCut = bCut;
				const FFogPicture Fog = RenderFog(View);
				ASSERT_EQ(Fog.Grid.Slices, static_cast<uint32_t>(std::stoi(Slices)));
				uint32_t Wrong = 0;
				Fog.ForEach([&](glm::uvec3 Froxel) { Wrong += Fog.Get(Froxel) != 1.0f ? 1 : 0; });
				EXPECT_EQ(Wrong, 0u) << Width << " x " << InHeight << ", " << PixelSize << " pixels, " << Slices << " slices";
			}
		}
	}
}

TEST_F(FFogShadowTest, ACutForgetsAndAResizeDoesNot)
{
	ASSERT_NO_FATAL_FAILURE(LoadPlate());
	FView View = LookAtPlate();
	MovePlate({-2.5, 0, 0});
	RenderFog(View, 30);
	const FFogPicture Settled = RenderFog(View);
	// Another size of picture: froxels lie elsewhere.
	const FView Larger = LookAtPlate(256, 144);
	const auto Measure = [&](const FView& Of, const FFogPicture& Fog) {
		double Squares = 0.0, Count = 0.0;
		const std::vector<double> Shares = ComputeShares(Of, Fog);
		for (size_t I = 0; I < Shares.size(); ++I)
		{
			if (Shares[I] <= 0.0 || Shares[I] >= 1.0) { continue; }
			Squares += (double(Fog.Visibility[I]) - Shares[I]) * (double(Fog.Visibility[I]) - Shares[I]);
			Count += 1.0;
		}
		EXPECT_GT(Count, 200.0);
		return std::sqrt(Squares / Count);
	};
	const double Still = Measure(View, Settled), Carried = Measure(Larger, RenderFog(Larger));
	FView Anew = Larger;
	Anew.bCut = true;
	const double Fresh = Measure(Larger, RenderFog(Anew));
	PrintFigure(fmt::format("RMS error of penumbrae: settled {:.3f}, another size {:.3f}, after a cut {:.3f}", Still, Carried, Fresh));
	EXPECT_LT(Carried, 0.75 * Fresh) << "the history was lost";
	MovePlate({2.5, 0, 0});
	View.bCut = true;
	const FFogPicture Cut = RenderFog(View);
	uint32_t Wrong = 0;
	Cut.ForEach([&](glm::uvec3 Froxel) {
		const double Lit = ComputeLit(View, Cut.Grid, Froxel);
		Wrong += (Lit == 0.0 && Cut.Get(Froxel) > 0.5f && !IsLit(FroxelToWorld(View, Cut.Grid, glm::dvec3(Froxel) + 0.5))) ? 1 : 0;
	});
	EXPECT_LT(Wrong, 20u) << "froxels of the frame before are still there";
}

// 16 km away, where the scene's origin has moved.
TEST_F(FFogShadowTest, FarAwayAsAtTheOrigin)
{
	constexpr glm::dvec3 Far(16'031.3, 500.7, -15'969.1);
	std::vector<float> Pictures[2];
	for (const int Away : {0, 1})
	{
		const glm::dvec3 At = double(Away) * Far;
		ASSERT_NO_FATAL_FAILURE(LoadPlate(At));
		FView View = LookAtPlate();
		View.Position += At;
		GetEngine().SetFrameIndex(0);
		Pictures[Away] = RenderFog(View, 8).Visibility;
	}
	ASSERT_EQ(Pictures[0].size(), Pictures[1].size());
	double Difference = 0.0;
	for (size_t I = 0; I < Pictures[0].size(); ++I) { Difference += std::abs(double(Pictures[0][I]) - double(Pictures[1][I])); }
	EXPECT_LT(Difference / double(Pictures[0].size()), 1e-3);
}

// What is hidden is not traced, and what comes into view is known at once.
TEST_F(FFogShadowTest, HiddenFroxelsAreSkippedUntilTheyAreSeen)
{
	FTestScene Scene("wall");
	const int32_t Grey = Scene.AddLambert(glm::vec3(0.5f), glm::vec3(0), true);
	Scene.AddNode(Scene.AddMesh({{Grey, {{-100, -100, 0}, {0, -100, 0}, {0, 100, 0}, {-100, 100, 0}}}}));
	ASSERT_TRUE(Load(std::move(Scene.Scene)));
	SetSun(0.5, 4.0f, {0, -1, 0.001});
	SetSky(glm::vec3(0));
	FView View = LookAt({-6, 0, 8}, {-6, 0, 0}, 0.8f, 96, 56); // the wall fills the picture
	RenderFog(View, 4);
	const FFogPicture Hidden = RenderFog(View);
	// Slices that begin two slices behind the wall were never lit.
	const double WallSlice = 64.0 * std::log2(1.0 + 64.0 * 8.0 / 60.0) / std::log2(65.0);
	for (uint32_t Slice = 0; Slice < 64; ++Slice)
	{
		const float Seen = Hidden.Get({12, 7, Slice});
		if (Slice + 1 < uint32_t(WallSlice)) { EXPECT_EQ(Seen, 1.0f) << "slice " << Slice; }
		if (Slice > uint32_t(WallSlice) + 1) { EXPECT_EQ(Seen, 0.0f) << "slice " << Slice; }
	}
	// The camera steps past the wall's end at 10 m/s: columns that now see past it are lit as soon.
	uint32_t Wrong = 0, Looked = 0;
	for (int Frame = 0; Frame < 40; ++Frame)
	{
		View.Position.x += 0.166;
		const FFogPicture Fog = RenderFog(View);
		Fog.ForEach([&](glm::uvec3 Froxel) {
			const glm::dvec3 P = FroxelToWorld(View, Fog.Grid, glm::dvec3(Froxel) + 0.5);
			if (P.z > -0.5) { return; }
			// Where the ray to the froxel crosses the wall's plane: beyond its end by a column or more, so that the pixels saw past it.
			const double Share = View.Position.z / (View.Position.z - P.z), Cross = View.Position.x + (P.x - View.Position.x) * Share;
			if (Cross < 0.3) { return; }
			++Looked;
			Wrong += Fog.Get(Froxel) < 0.99f ? 1 : 0;
		});
	}
	PrintFigure(fmt::format("{} of {} froxels that came into view were dark", Wrong, Looked));
	EXPECT_GT(Looked, 1000u);
	EXPECT_EQ(Wrong, 0u);
}

} // namespace
} // namespace Lantern
