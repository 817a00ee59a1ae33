// Path reservoirs: means against those of paths alone where pixels see different things and where normals differ, noise of a frame, a furnace,
// light that goes out, and the same bits again.
#include <algorithm>
#include <cmath>

#include "CachedGIFixture.h"
#include "LanternCore/Config/ConsoleVariables.h"

namespace Lantern
{

namespace
{
class FPathReservoirTest : public FCachedGITest
{
protected:
	void SetUp() override
	{
		FSignalTest::SetUp();
		SetRoute("3");
		SetVariable("r.RT.GI.Rate", "2");
		SetVariable("r.RT.GI.Reuse.Near", "1"); // nearly all paths are resampled
		SetVariable("r.RT.GI.Cells.Near", "0");
	}

	/// A floor before a wall in the sun, and a row of slats between. Each piece of the floor sees another part of the wall.
	void LoadGrille(int Slats = 8)
	{
		FTestScene Scene("grille");
		const int32_t White = Scene.AddLambert(glm::vec3(0.8f)), Dark = Scene.AddLambert(glm::vec3(0.02f));
		std::vector<FTestScene::FQuad> Quads{
		    FTestScene::MakeFloor(Dark, 2.0f), {White, {{-2, 0, 3}, {-2, 0, -3}, {-2, 1.5, -3}, {-2, 1.5, 3}}}};
		for (int Slat = 0; Slat < Slats; ++Slat)
		{
			const double Z = -1.4 + 0.4 * Slat;
			const FTestScene::FQuad Front{Dark, {{-0.6, 0, Z + 0.2}, {-0.6, 0, Z}, {-0.6, 0.8, Z}, {-0.6, 0.8, Z + 0.2}}};
			Quads.push_back(Front);
			Quads.push_back({Dark, {Front.P[1], Front.P[0], Front.P[3], Front.P[2]}});
		}
		Scene.AddNode(Scene.AddMesh(Quads));
		ASSERT_TRUE(Load(std::move(Scene.Scene)));
		SetSun(0.0, 10.0f, {-1, -0.4, 0});
	}
	static FView LookAtGrille() { return LookAt({0.3, 2.2, 0.01}, {0.3, 0, 0}, 0.7f, 64, 64); }

	/// Mean over pixels of the squared difference, over the mean square of the reference.
	static double SquaredError(const FImage& Image, const FImage& Reference)
	{
		double Error = 0, Square = 0;
		for (uint32_t Y = 0; Y < Image.Height; ++Y)
		{
			for (uint32_t X = 0; X < Image.Width; ++X)
			{
				const double Theirs = double(Reference.At(X, Y, 1));
				Error += std::pow(double(Image.At(X, Y, 1)) - Theirs, 2.0);
				Square += Theirs * Theirs;
			}
		}
		return Error / Square;
	}
};

// Pixels around do not see what a pixel sees, and weights know it: the mean is that of paths alone. The planted fault takes the solid angle of
// the wall for the same from near and far.
TEST_F(FPathReservoirTest, TheMeanIsThatOfPathsAlone)
{
	constexpr uint32_t Frames = 384;
	struct FWay
	{
		const char *Name, *Reservoirs, *Jacobian;
		int Slats;
	};
	constexpr FWay Ways[] = {{"none", "0", "1", 8}, {"time", "1", "1", 8}, {"time and space", "2", "1", 8}, {"open, none", "0", "1", 0},
	    {"open, time and space", "2", "1", 0}, {"open, without Jacobian", "2", "0", 0}};
	FImage Means[std::size(Ways)];
	double Ratios[std::size(Ways)] = {}, Errors[std::size(Ways)] = {}, Noise[std::size(Ways)] = {};
	for (size_t I = 0; I < std::size(Ways); ++I)
	{
		const size_t Alone = Ways[I].Slats > 0 ? 0 : 3;
		LoadGrille(Ways[I].Slats);
		SetVariable("r.RT.GI.Reservoirs", Ways[I].Reservoirs);
		SetVariable("r.RT.Debug.GI.Jacobian", Ways[I].Jacobian);
		Means[I] = RenderSettled(LookAtGrille(), Frames);
		const FImage Single = RenderSignal(ESignal::DiffuseGI, LookAtGrille(), 1, WarmFrames + Frames);
		Ratios[I] = MeanGreen(Means[I]) / MeanGreen(Means[Alone]);
		Errors[I] = RelativeError(Means[I], Means[Alone]);
		Noise[I] = SquaredError(Single, Means[Alone]);
		PrintFigure(
		    fmt::format("grille, {}: mean over that of paths alone {:.4f}, error of columns {:.4f}, squared error of a frame {:.4f}",
		        Ways[I].Name, Ratios[I], Errors[I], Noise[I]));
	}
	EXPECT_NEAR(Ratios[1], 1.0, 0.02); // 0.8 % is what runs of one seed and the next differ by
	EXPECT_NEAR(Ratios[2], 1.0, 0.02);
	EXPECT_NEAR(Ratios[4], 1.0, 0.01);
	EXPECT_GT(Errors[5], 2.0 * Errors[4]) << "the planted fault must be seen";
	EXPECT_LT(Noise[1], 0.4 * Noise[0]);
	EXPECT_LT(Noise[2], 0.9 * Noise[1]);
	EXPECT_LT(Noise[4], 0.4 * Noise[3]);
}

TEST_F(FPathReservoirTest, FurnaceOfAllBounces)
{
	ASSERT_TRUE(Load("furnace:0.5"));
	SetVariable("r.RT.Lights.Emissive", "0"); // local lights would have the walls' own light
	SetVariable("r.RT.GI.Reservoirs", "2");
	const double Mean = MeanGreen(RenderSettled(MakeView(96, 96)));
	PrintFigure(fmt::format("furnace through path reservoirs {:.4f}", Mean));
	EXPECT_NEAR(Mean, 1.0, 0.01);
}

// Normals of pixels around differ, and so do the directions that their paths take.
TEST_F(FPathReservoirTest, CurvedSurfacesKeepTheirMean)
{
	double Means[2];
	for (const bool bReservoirs : {false, true})
	{
		ASSERT_TRUE(Load("sphere:0.5"));
		SetVariable("r.RT.GI.Reservoirs", bReservoirs ? "2" : "0");
		Means[bReservoirs] = MeanGreen(RenderSettled(MakeView(48, 48), 128));
	}
	PrintFigure(fmt::format("sphere: mean of reservoirs over paths alone {:.4f}", Means[1] / Means[0]));
	EXPECT_NEAR(Means[1] / Means[0], 1.0, 0.01);
}

TEST_F(FPathReservoirTest, TheSameBitsAgain)
{
	ASSERT_TRUE(Load("sphere:0.5"));
	SetVariable("r.RT.GI.Reservoirs", "2");
	ExpectTheSameBitsAgain("sphere:0.5", MakeView(64, 64));
}

// Paths that were kept bring the light that was. They lose their weight to paths that bring what is.
TEST_F(FPathReservoirTest, WhatGoesOutLightsNothing)
{
	LoadGrille(0);
	SetVariable("r.RT.GI.Reservoirs", "1");
	const double Lit = MeanGreen(RenderSettled(LookAtGrille(), 8));
	SetSun(0.0, 10.0f, {1, -0.4, 0}); // on the back of the wall
	RenderSignal(ESignal::DiffuseGI, LookAtGrille(), 59, WarmFrames + 8);
	const double Dark = MeanGreen(RenderSignal(ESignal::DiffuseGI, LookAtGrille(), 8, WarmFrames + 8 + 59));
	PrintFigure(fmt::format("wall, a second behind the sun: {:.5f} of its light", Dark / Lit));
	EXPECT_LT(Dark, 0.03 * Lit);
}
} // namespace

} // namespace Lantern
