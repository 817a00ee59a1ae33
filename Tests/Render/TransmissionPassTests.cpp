// Glass and water in the picture: the pass that finds them by rays, and its use by the sample engine.
#include <cmath>

#include "LanternImage/Metrics.h"
#include "Support/RenderFixture.h"
#include "TransmissionFixture.h"

namespace Lantern
{

namespace
{
constexpr double R = GlassR;

class FTransmissionPassTest : public FRenderTest
{
protected:
	/// A wall of 1 nit behind Count sheets of glass, before darkness.
	static FTestScene MakeSheets(int Count, const FHostMaterial& Material)
	{
		FTestScene Scene("Sheets");
		Scene.AddNode(Scene.AddMesh({MakeWall(Scene.AddLambert(glm::vec3(0), glm::vec3(1)), 4.0f, -10.0f)}));
		const int32_t Glass = Scene.AddMaterial(Material);
		for (int I = 0; I < Count; ++I) { Scene.AddNode(Scene.AddMesh({MakeWall(Glass, 4.0f, -float(I))})); }
		return Scene;
	}
	static FView LookAtWall(uint32_t Size = 16) { return LookAt({0, 0, 10}, {0, 0, -10}, glm::radians(0.5f), Size, Size); }
	double RenderSheets(int Count, const FHostMaterial& Material)
	{
		if (!Load(MakeSheets(Count, Material).Scene)) { return -1.0; }
		SetSky(glm::vec3(0));
		return MeanGreen(RenderLighting(LookAtWall()));
	}
};

// Transmittance has eight bits.
TEST_F(FTransmissionPassTest, SheetsLeaveThePictureBehindThem)
{
	const double Sheet = (1.0 - R) / (1.0 + R);
	EXPECT_NEAR(RenderSheets(1, MakeGlass()), Sheet, 0.003);
	// Two mirrors face each other: light that goes to and fro between them is passed by the likelier side, and lost.
	EXPECT_NEAR(RenderSheets(2, MakeGlass()), Sheet * Sheet, 0.006);
	FHostMaterial Tinted = MakeGlass();
	Tinted.BaseColor = {0.2f, 0.5f, 0.9f, 1.0f};
	EXPECT_NEAR(RenderSheets(1, Tinted), 0.5 * Sheet, 0.003);
	FHostMaterial Frosted = MakeGlass();
	Frosted.Roughness = 0.4f;
	EXPECT_NEAR(RenderSheets(1, Frosted), Sheet, 0.003) << "an even wall is as even when it is spread";
	SetVariable("r.RT.Transmission", "0");
	EXPECT_LT(RenderSheets(1, MakeGlass()), 0.01) << "glass is opaque, and dark without light";
}

// Rays for glass pass the opaque sections of its mesh, and end at what the raster shows.
TEST_F(FTransmissionPassTest, MeshesMayHaveGlassAmongOtherParts)
{
	FHostMaterial Tinted = MakeGlass();
	Tinted.BaseColor = {0.2f, 0.5f, 0.9f, 1.0f};
	for (const char* Path : {"1", "2"})
	{
		SetVariable("r.RT.Transmission.Path", Path);
		FTestScene Window("Window"), Hidden("Hidden");
		for (FTestScene* Scene : {&Window, &Hidden})
		{
			const int32_t Bright = Scene->AddLambert(glm::vec3(0), glm::vec3(1)), Pane = Scene->AddMaterial(Tinted);
			const float PaneZ = Scene == &Window ? 0.0f : -20.0f; // behind the wall
			Scene->AddNode(Scene->AddMesh({MakeWall(Bright, 4.0f, -10.0f), MakeWall(Pane, 4.0f, PaneZ)}));
		}
		ASSERT_TRUE(Load(std::move(Window.Scene)));
		SetSky(glm::vec3(0));
		EXPECT_NEAR(MeanGreen(RenderLighting(LookAtWall())), 0.5 * (1.0 - R) / (1.0 + R), 0.003) << "path " << Path;
		ASSERT_TRUE(Load(std::move(Hidden.Scene)));
		SetSky(glm::vec3(0));
		EXPECT_NEAR(MeanGreen(RenderLighting(LookAtWall())), 1.0, 0.001) << "path " << Path;
	}
}

TEST_F(FTransmissionPassTest, MoreLayersThanAllowedAreLeftOut)
{
	const double Sheet = (1.0 - R) / (1.0 + R);
	SetVariable("r.RT.Transmission.Layers", "2");
	EXPECT_NEAR(RenderSheets(6, MakeGlass()), Sheet * Sheet, 0.006);
	SetVariable("r.RT.Transmission.Layers", "6");
	EXPECT_NEAR(RenderSheets(6, MakeGlass()), std::pow(Sheet, 6.0), 0.015);
}

TEST_F(FTransmissionPassTest, VolumesBendAndAbsorb)
{
	FTestScene Scene("Water");
	FHostMaterial Water = MakeGlass(true, 1.333f);
	Water.Extinction = glm::vec3(0.7f);
	Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Scene.AddMaterial(Water), 4.0f)}));
	Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Scene.AddLambert(glm::vec3(0), glm::vec3(1)), 8.0f, -1.0f)}));
	ASSERT_TRUE(Load(Scene.Scene));
	SetSky(glm::vec3(0));
	// The bed is in the picture, and looks find it there: its own colour, without water, is what they weigh.
	const FView View = LookAt({0, 3, 3}, {0, 0, 0}, glm::radians(30.0f), 32, 32);
	const double Index = 1.333, F0 = std::pow((Index - 1.0) / (Index + 1.0), 2.0), Sine = std::sin(glm::radians(45.0)) / Index;
	const double Fresnel = F0 + (1.0 - F0) * std::pow(1.0 - std::cos(glm::radians(45.0)), 5.0);
	const double Expected = (1.0 - Fresnel) * std::exp(-0.7 / std::sqrt(1.0 - Sine * Sine));
	const FImage Picture = RenderLighting(View);
	EXPECT_NEAR(double(Picture.Pixels[3 * (16 * 32 + 16)]) / Expected, 1.0, 0.02) << "at the picture's middle";
}

/// A plate within a slab of glass keeps the sun from a floor. Rays to a sun without a disk run no closest-hit shader, and have met the
/// slab's lower side when the plate ends them: light gets denser there, which must not count as light. On lavapipe it holds without that care.
TEST_F(FTransmissionPassTest, WhatLiesInGlassCastsShadows)
{
	for (const float Height : {0.0f, 1.05f, 1.5f, 1.95f}) // 0: without a plate. Which surface a ray meets first is the driver's choice
	{
		FTestScene Scene("Plate");
		const int32_t Glass = Scene.AddMaterial(MakeGlass(true)), White = Scene.AddLambert(glm::vec3(0.5f));
		Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(White, 4.0f)}));
		FTestScene::FQuad Bottom = FTestScene::MakeFloor(Glass, 4.0f, 1.0f);
		std::swap(Bottom.P[1], Bottom.P[3]); // its outside is below
		Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Glass, 4.0f, 2.0f), Bottom}));
		const bool bPlate = Height > 0.0f;
		if (bPlate)
		{
			FTestScene::FQuad Under = FTestScene::MakeFloor(White, 2.0f, Height);
			std::swap(Under.P[1], Under.P[3]);
			Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(White, 2.0f, Height), Under}));
		}
		ASSERT_TRUE(Load(Scene.Scene));
		SetSky(glm::vec3(0));
		SetSun(0.0, 4.0f, {0.0, -1.0, 0.0});
		for (const char* const Path : {"1", "2"})
		{
			SetVariable("r.RT.Shadow.Path", Path);
			const double Mean = MeanGreen(RenderLighting(LookAt({0, 0.6, 0.6}, {0, 0, 0}, glm::radians(5.0f), 16, 16)));
			if (bPlate) { EXPECT_LT(Mean, 0.01) << Path; }
			else { EXPECT_GT(Mean, 0.4) << Path; }
		}
	}
}

/// The pipeline and ray queries show the same, and what the reference does.
TEST_F(FTransmissionPassTest, PicturesAgreeByEitherPathAndWithTheReference)
{
	ASSERT_TRUE(Load("glass"));
	const FView View = MakeView(96, 54);
	const auto RenderLast = [&] {
		FImage Picture;
		for (int Frame = 0; Frame < 24; ++Frame) { Picture = RenderLighting(View); }
		return Picture;
	};
	SetVariable("r.RT.GI", "3");
	SetVariable("r.RT.Transmission.Path", "1");
	GetEngine().SetFrameIndex(0);
	const FImage Pipeline = RenderLast();
	SetVariable("r.RT.Transmission.Path", "2");
	GetEngine().SetFrameIndex(0);
	const FImage Query = RenderLast();
	EXPECT_LT(FractionDiffering(Pipeline, Query, 0.05), 0.02) << "cells are asked for by rays in another order";
	SetVariable("r.RT.Transmission", "0");
	const FImage Opaque = RenderLast();
	SetVariable("r.RT.Transmission", "1");
	FReferenceSettings Settings;
	Settings.View = View;
	Settings.Samples = 96;
	Settings.bRasterSurfaces = true;
	const FImage Reference = TraceReference(Settings);
	FImageMetrics Shown, Hidden;
	ASSERT_OK(CompareImages(Pipeline, Reference, Shown));
	ASSERT_OK(CompareImages(Opaque, Reference, Hidden));
	PrintFigure(fmt::format("glass against the reference: relative square error {:.4f}, opaque {:.4f}", Shown.RelMse, Hidden.RelMse));
	EXPECT_LT(Shown.RelMse, 0.25 * Hidden.RelMse);
	EXPECT_NEAR(MeanGreen(Pipeline) / MeanGreen(Reference), 1.0, 0.03);
}

TEST_F(FTransmissionPassTest, AnyPictureSizeIsComplete)
{
	ASSERT_TRUE(Load("glass"));
	for (const glm::uvec2 Size : {glm::uvec2(1, 1), glm::uvec2(131, 73), glm::uvec2(3, 40)})
	{
		const FImage Picture = RenderLighting(MakeView(Size.x, Size.y));
		for (const float Value : Picture.Pixels) { ASSERT_TRUE(std::isfinite(Value)) << Size.x; }
	}
}
} // namespace

} // namespace Lantern
