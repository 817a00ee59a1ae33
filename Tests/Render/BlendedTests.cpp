// Surfaces that cover a share of their place: their layers in the picture and in the reference, and what they leave of the sun.
#include <glm/gtc/matrix_transform.hpp>

#include "Support/RenderFixture.h"
#include "TransmissionFixture.h"

namespace Lantern
{

namespace
{
struct FPane
{
	float Opacity, Emission;
};

class FBlendedTest : public FRenderTest
{
protected:
	static FHostMaterial MakeBlended(const FPane& Pane, glm::vec3 Color = glm::vec3(0))
	{
		FHostMaterial Material;
		Material.BaseColor = glm::vec4(Color, Pane.Opacity);
		Material.Emissive = glm::vec3(Pane.Emission);
		Material.Metallic = 0.0f;
		Material.Roughness = 1.0f;
		Material.Specular = 0.0f;
		Material.AlphaMode = EAlphaMode::Blend;
		Material.bDoubleSided = true;
		return Material;
	}
	/// Panes before a wall of 1 nit, the first one in front.
	bool LoadPanes(const std::vector<FPane>& Panes)
	{
		FTestScene Scene("Panes");
		Scene.AddNode(Scene.AddMesh({MakeWall(Scene.AddLambert(glm::vec3(0), glm::vec3(1)), 4.0f, -10.0f)}));
		for (size_t I = 0; I < Panes.size(); ++I)
		{
			Scene.AddNode(Scene.AddMesh({MakeWall(Scene.AddMaterial(MakeBlended(Panes[I])), 4.0f, -float(I))}));
		}
		const bool bLoaded = Load(Scene.Scene);
		SetSky(glm::vec3(0));
		return bLoaded;
	}
	static FView LookAtWall() { return LookAt({0, 0, 10}, {0, 0, -10}, glm::radians(0.5f), 16, 16); }
	static double MeanRed(const FImage& Image)
	{
		double Sum = 0.0;
		for (size_t I = 0; I < Image.Pixels.size(); I += Image.Channels) { Sum += double(Image.Pixels[I]); }
		return Sum * Image.Channels / double(Image.Pixels.size());
	}
	/// Porter and Duff 1984: each over what lies behind.
	static double Compose(const std::vector<FPane>& Panes)
	{
		double Behind = 1.0;
		for (size_t I = Panes.size(); I-- > 0;)
		{
			Behind = double(Panes[I].Opacity) * double(Panes[I].Emission) + (1.0 - double(Panes[I].Opacity)) * Behind;
		}
		return Behind;
	}
};

const std::vector<std::vector<FPane>> Stacks = {{{0.25f, 4.0f}}, {{0.5f, 3.0f}, {0.25f, 0.0f}}, {{0.25f, 0.0f}, {0.5f, 3.0f}},
    {{0.2f, 2.0f}, {0.6f, 0.5f}, {0.3f, 5.0f}}, {{0.1f, 8.0f}, {0.4f, 0.0f}, {0.2f, 3.0f}, {0.5f, 1.0f}}};

// Transmittance has eight bits in the picture. Two stacks hold the same panes in another order.
TEST_F(FBlendedTest, LayersAreComposedInTheirOrder)
{
	for (const char* Path : {"1", "2"})
	{
		SetVariable("r.RT.Transmission.Path", Path);
		for (const std::vector<FPane>& Panes : Stacks)
		{
			ASSERT_TRUE(LoadPanes(Panes));
			EXPECT_NEAR(MeanGreen(RenderLighting(LookAtWall())) / Compose(Panes), 1.0, 0.01) << Panes.size() << " panes, path " << Path;
		}
	}
	EXPECT_GT(std::abs(Compose(Stacks[1]) / Compose(Stacks[2]) - 1.0), 0.1) << "the order shows";
}

TEST_F(FBlendedTest, TheReferenceComposesThemAlike)
{
	for (const std::vector<FPane>& Panes : Stacks)
	{
		ASSERT_TRUE(LoadPanes(Panes));
		ExpectClosedForm("panes", EstimateMean(LookAtWall(), 256, 1), Compose(Panes), 0.005);
	}
}

TEST_F(FBlendedTest, WithoutTransmissionTheyAreCutAtHalf)
{
	SetVariable("r.RT.Transmission", "0");
	ASSERT_TRUE(LoadPanes({{0.4f, 3.0f}}));
	EXPECT_NEAR(MeanGreen(RenderLighting(LookAtWall())), 1.0, 0.01);
	ASSERT_TRUE(LoadPanes({{0.6f, 3.0f}}));
	EXPECT_NEAR(MeanGreen(RenderLighting(LookAtWall())), 3.0, 0.03);
}

// What covers all of its place is the raster's, with direct light and shadows as any surface has them. What covers nothing is nowhere.
TEST_F(FBlendedTest, SolidPartsAreAsOpaqueAndClearPartsAsNone)
{
	enum EKind
	{
		None,
		Opaque,
		Solid,
		Clear
	};
	FImage Pictures[4];
	for (const EKind Kind : {None, Opaque, Solid, Clear})
	{
		FTestScene Scene("Board");
		Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Scene.AddLambert(glm::vec3(0.6f)), 4.0f)}));
		FHostMaterial Board = MakeBlended({Kind == Clear ? 0.0f : 1.0f, 0.0f}, {0.7f, 0.3f, 0.2f});
		if (Kind == Opaque) { Board.AlphaMode = EAlphaMode::Opaque; }
		if (Kind != None) { Scene.AddNode(Scene.AddMesh({MakeWall(Scene.AddMaterial(Board), 1.0f, -1.0f)})); }
		ASSERT_TRUE(Load(Scene.Scene));
		SetSun(2.0, 4.0f, {-0.5, -1.0, -0.7});
		SetSky(glm::vec3(0.3f));
		SetVariable("r.RT.GI", "3");
		SetVariable("r.RT.GI.Cells.Capacity", "65536");
		GetEngine().SetFrameIndex(0);
		FView View = LookAt({0.4, 0.9, 1.6}, {0, 0.3, -1}, 1.0f, 64, 48);
		for (int Frame = 0; Frame < 16; ++Frame)
		{
			View.bCut = Frame == 0;
			Pictures[Kind] = RenderLighting(View);
		}
	}
	EXPECT_LT(FractionDiffering(Pictures[Solid], Pictures[Opaque], 0.05), 0.03) << "indirect light has other random numbers";
	EXPECT_LT(FractionDiffering(Pictures[Clear], Pictures[None], 0.05), 0.03);
	EXPECT_GT(FractionDiffering(Pictures[Opaque], Pictures[None], 0.05), 0.1) << "the board shows";
}

// Sun and lamp shine on a floor through a pane that covers 0.3 of its place.
TEST_F(FBlendedTest, ShadowsAreOfWhatIsCovered)
{
	const auto Measure = [&](ESignal Signal, bool bPane, uint32_t Light = LIGHT_SPHERE) {
		FTestScene Scene("Shadow");
		Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Scene.AddLambert(glm::vec3(0.5f)), 4.0f)}));
		if (bPane) { Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Scene.AddMaterial(MakeBlended({0.3f, 0.0f})), 4.0f, 2.0f)})); }
		FHostLight Lamp;
		Lamp.Type = Light;
		Lamp.Size = glm::vec2(0.1f);
		Lamp.Color = glm::vec3(1000);
		Scene.AddLight(Lamp, glm::translate(glm::dmat4(1), glm::dvec3(0, 3, 0)));
		if (!Load(Scene.Scene)) { return -1.0; }
		SetSun(0.5, 4.0f, {0.0, -1.0, 0.0});
		SetSky(glm::vec3(0));
		FView View = LookAt({0, 1.5, 2}, {0, 0, 0}, glm::radians(20.0f), 64, 48);
		FFrameCapture Capture;
		Capture.Signals.Add(Signal);
		FCapturedFrame Frame;
		double Sum = 0.0;
		constexpr int Frames = 48, WarmUp = 16;
		for (int I = 0; I < Frames; ++I)
		{
			View.bCut = I == 0;
			View.DeltaSeconds = 1.0f / 60.0f;
			EXPECT_OK(GetEngine().RenderFrame(View, 0.0, Capture, &Frame));
			Sum += I >= WarmUp ? MeanRed(Frame.Get(Signal)) / (Frames - WarmUp) : 0.0;
		}
		return Sum;
	};
	SetVariable("r.RT.Shadow.Denoise", "1");
	for (const char* Path : {"1", "2"})
	{
		SetVariable("r.RT.Shadow.Path", Path);
		for (const ESignal Signal : {ESignal::SunShadow, ESignal::LocalDiffuse})
		{
			const double Share = Measure(Signal, true) / Measure(Signal, false);
			PrintFigure(fmt::format("{} by path {}: {:.4f} of the light", GetSignalInfo(Signal).Pass, Path, Share));
			EXPECT_NEAR(Share, 0.7, 0.01);
		}
	}
	// No filter follows what shines from one point.
	const double OfPoint = Measure(ESignal::LocalDiffuse, true, LIGHT_POINT) / Measure(ESignal::LocalDiffuse, false, LIGHT_POINT);
	EXPECT_NEAR(OfPoint, 1.0, 0.005) << "rays through the edge of two triangles meet both";
	SetVariable("r.RT.Transmission.Shadows", "0");
	EXPECT_NEAR(Measure(ESignal::SunShadow, true), 1.0, 0.001) << "what leaves more than half casts none";
}

// Hard sun shadows have no filter behind them, and no noise.
TEST_F(FBlendedTest, HardShadowsHaveNoNoise)
{
	FTestScene Scene("Shadow");
	Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Scene.AddLambert(glm::vec3(0.5f)), 4.0f)}));
	Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Scene.AddMaterial(MakeBlended({0.3f, 0.0f})), 4.0f, 2.0f)}));
	ASSERT_TRUE(Load(Scene.Scene));
	SetSky(glm::vec3(0));
	for (const bool bSoft : {false, true})
	{
		SetSun(bSoft ? 0.5 : 0.0, 4.0f, {0.0, -1.0, 0.0});
		SetVariable("r.RT.Shadow.Denoise", bSoft ? "0" : "1");
		const FImage Shadow = RenderSignal(ESignal::SunShadow, LookAt({0, 1.5, 2}, {0, 0, 0}, glm::radians(20.0f), 32, 24));
		EXPECT_GT(MeanRed(Shadow), 0.99) << "but for rays through the edge of two triangles, which meet both";
	}
}

// The program leaves 0.7 of what the standard parameters cover wholly.
TEST_F(FBlendedTest, ShadowsAreOfTheProgramsOpacity)
{
	SetVariable("r.RT.Shadow.Denoise", "1");
	SetVariable("r.RT.Shadow.Path", "1"); // ray queries know the standard program alone
	FTestScene Scene("Shadow");
	Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Scene.AddLambert(glm::vec3(0.5f)), 4.0f)}));
	const int32_t Pane = Scene.AddMaterial(MakeBlended({1.0f, 0.0f}));
	Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Pane, 4.0f, 2.0f)}));
	ASSERT_TRUE(Load(Scene.Scene));
	SetSun(0.5, 4.0f, {0.0, -1.0, 0.0});
	SetSky(glm::vec3(0));
	const uint32_t Program = GetEngine().GetRenderer().GetPrograms().Add({.Name = "Thin", .Text = R"(
#include "Standard.glsl"
FMaterialSurface EvaluateMaterial(FMaterialData M, FMaterialInputs I, uint Override)
{
	FMaterialSurface S = EvaluateStandard(M, I, Override);
	S.Opacity = 0.3;
	return S;
}
)"});
	GetScene().GetScene().SetMaterialProgram(static_cast<uint32_t>(Pane), Program);
	const FView View = LookAt({0, 1.5, 2}, {0, 0, 0}, glm::radians(20.0f), 32, 24);
	EXPECT_NEAR(MeanRed(RenderSignal(ESignal::SunShadow, View, 48)), 0.7, 0.02);
}

// The sun lights the side that the camera sees. Cells that both sides share, or that know no side, would show half of it.
TEST_F(FBlendedTest, LayersAreLitAsInTheReference)
{
	FTestScene Scene("Lit");
	Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Scene.AddLambert(glm::vec3(0.4f)), 4.0f)}));
	Scene.AddNode(Scene.AddMesh({MakeWall(Scene.AddMaterial(MakeBlended({0.7f, 0.0f}, glm::vec3(0.8f))), 1.0f, 0.0f)}));
	ASSERT_TRUE(Load(Scene.Scene));
	SetSun(0.5, 4.0f, {0.1, -0.6, -1.0});
	SetSky(glm::vec3(0.2f));
	SetVariable("r.RT.GI", "3");
	SetVariable("r.RT.GI.Cells.Capacity", "65536");
	FView View = LookAt({0, 0.5, 3}, {0, 0.5, 0}, glm::radians(12.0f), 24, 24);
	FImage Picture;
	for (int Frame = 0; Frame < 48; ++Frame)
	{
		View.bCut = Frame == 0;
		View.DeltaSeconds = 1.0f / 60.0f;
		Picture = RenderLighting(View);
	}
	const double Reference = EstimateMean(View, 256, UnlimitedBounces).Mean;
	PrintFigure(fmt::format("layer over the reference: {:.4f}", MeanGreen(Picture) / Reference));
	EXPECT_NEAR(MeanGreen(Picture) / Reference, 1.0, 0.05);
}

// A decal lies so near to its wall that depth is not told apart, and cards of leaves are clear for the most part.
TEST_F(FBlendedTest, DecalsAndClearCardsShow)
{
	FTestScene Scene("Decal");
	Scene.AddNode(Scene.AddMesh({MakeWall(Scene.AddLambert(glm::vec3(0), glm::vec3(1)), 4.0f, -10.0f)}));
	Scene.AddNode(Scene.AddMesh({MakeWall(Scene.AddMaterial(MakeBlended({0.5f, 3.0f})), 4.0f, -9.9995f)}));
	const int32_t Clear = Scene.AddMaterial(MakeBlended({0.0f, 5.0f}));
	for (int I = 0; I < 20; ++I) { Scene.AddNode(Scene.AddMesh({MakeWall(Clear, 4.0f, -0.1f * float(I))})); }
	ASSERT_TRUE(Load(Scene.Scene));
	SetSky(glm::vec3(0));
	for (const char* Path : {"1", "2"})
	{
		SetVariable("r.RT.Transmission.Path", Path);
		EXPECT_NEAR(MeanGreen(RenderLighting(LookAtWall())), 2.0, 0.02) << "path " << Path;
	}
	ExpectClosedForm("decal behind clear cards", EstimateMean(LookAtWall(), 256, 1), 2.0, 0.005);
}

TEST_F(FBlendedTest, TransmissionCountsAlone)
{
	FHostMaterial Glass = MakeGlass();
	Glass.AlphaMode = EAlphaMode::Blend;
	Glass.BaseColor.a = 0.2f;
	FTestScene Scene("Glass");
	Scene.AddNode(Scene.AddMesh({MakeWall(Scene.AddLambert(glm::vec3(0), glm::vec3(1)), 4.0f, -10.0f)}));
	Scene.AddNode(Scene.AddMesh({MakeWall(Scene.AddMaterial(Glass), 4.0f, 0.0f)}));
	ASSERT_TRUE(Load(Scene.Scene));
	SetSky(glm::vec3(0));
	EXPECT_NEAR(MeanGreen(RenderLighting(LookAtWall())), (1.0 - GlassR) / (1.0 + GlassR), 0.003);
}

TEST_F(FBlendedTest, ReferenceShadowsAreOfWhatIsCovered)
{
	double Means[2] = {};
	for (const bool bPane : {false, true})
	{
		FTestScene Scene("Shadow");
		Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Scene.AddLambert(glm::vec3(0.5f)), 4.0f)}));
		if (bPane) { Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Scene.AddMaterial(MakeBlended({0.3f, 0.0f})), 4.0f, 3.0f)})); }
		ASSERT_TRUE(Load(Scene.Scene));
		SetSun(0.5, 4.0f, {0.0, -1.0, 0.0});
		SetSky(glm::vec3(0));
		Means[bPane] = EstimateMean(LookAt({0, 1, 1}, {0, 0, 0}, glm::radians(1.0f), 16, 16), 64, 1).Mean;
	}
	EXPECT_NEAR(Means[1] / Means[0], 0.7, 0.005);
}

// Half of a white pane reflects an even sky, and half shows it.
TEST_F(FBlendedTest, WhitePanesVanishInAnEvenSky)
{
	FTestScene Scene("Furnace");
	Scene.AddNode(Scene.AddMesh({MakeWall(Scene.AddMaterial(MakeBlended({0.5f, 0.0f}, glm::vec3(1))), 4.0f, 0.0f)}));
	ASSERT_TRUE(Load(Scene.Scene));
	SetSky(glm::vec3(1));
	ExpectClosedForm("pane", EstimateMean(LookAtWall(), 256), 1.0, 0.005);
}

} // namespace
} // namespace Lantern
