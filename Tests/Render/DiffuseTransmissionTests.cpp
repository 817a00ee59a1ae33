// Light that scatters through surfaces: closed forms of the reference, and frames against it.
//
// A sheet of share t and colours c (front) and b (back) sends (1 − t) c of the light on its own side to the viewer, and t b of the light
// behind. Both are Lambert lobes.
#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "SignalFixture.h"
#include "TransmissionFixture.h"

namespace Lantern
{

namespace
{
constexpr double Tolerance = 0.005;
constexpr float Share = 0.6f;
constexpr glm::vec3 FrontColor{0.2f, 0.5f, 0.7f}, BackColor{0.9f, 0.4f, 0.1f};

FHostMaterial MakePaper(float Specular = 0.0f)
{
	FHostMaterial Paper;
	Paper.BaseColor = glm::vec4(FrontColor, 1.0f);
	Paper.Metallic = 0.0f;
	Paper.Roughness = 0.7f;
	Paper.Specular = Specular;
	Paper.bDoubleSided = true;
	Paper.DiffuseTransmission = Share;
	Paper.DiffuseTransmissionColor = BackColor;
	return Paper;
}

class FDiffuseTransmissionTest : public FSignalTest
{
protected:
	/// A sheet at z = 0, that faces the camera and fills its picture.
	void LoadSheet(const FHostMaterial& Material, glm::vec3 Sky)
	{
		FTestScene Scene("sheet");
		Scene.AddNode(Scene.AddMesh({MakeWall(Scene.AddMaterial(Material), 4.0f, 0.0f)}));
		ASSERT_TRUE(Load(Scene.Scene));
		SetSun(0.0, 0.0f);
		SetSky(Sky);
	}
	static FView LookAtSheet() { return LookAt({0, 0, 4}, {0, 0, 0}, glm::radians(10.0f), 32, 32); }
	static void AddLamp(const glm::dvec3& Position, float Radius = 0.0f)
	{
		GetScene().GetScene().AddLight(MakeLamp(Position, glm::vec3(6.0f), Radius));
	}
	/// Tilted sheets on a floor, and a post behind one, whose shadow it shows.
	void LoadScreens()
	{
		FTestScene Scene("screens");
		const int32_t Floor = Scene.AddLambert(glm::vec3(0.5f)), Post = Scene.AddLambert(glm::vec3(0.3f), glm::vec3(0), true);
		const int32_t Screen = Scene.AddMesh({MakeWall(Scene.AddMaterial(MakePaper(1.0f)), 0.8f, 0.0f)});
		Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Floor, 8.0f)}));
		for (const double X : {-1.1, 0.9})
		{
			const glm::dmat4 Place = glm::translate(glm::dmat4(1), glm::dvec3(X, 0.75, 0));
			Scene.AddNode(Screen, glm::rotate(Place, -0.3 * X, glm::dvec3(0.3, 1, 0)));
		}
		Scene.AddNode(Scene.AddMesh({{Post, {{-1.2f, 0, -0.9f}, {-1.0f, 0, -0.9f}, {-1.0f, 2.0f, -0.9f}, {-1.2f, 2.0f, -0.9f}}}}));
		ASSERT_TRUE(Load(std::move(Scene.Scene)));
		SetSun(0.5, 4.0f, {0.3, -0.8, 1.0});
		SetSky(glm::vec3(0.3f));
	}
	static FView LookAtScreens(uint32_t Width = 64, uint32_t Height = 36)
	{
		return LookAt({0, 1.3, 3.6}, {0, 0.6, 0}, 0.75f, Width, Height);
	}
};

TEST_F(FDiffuseTransmissionTest, EvenSkyLightsBothSides)
{
	ASSERT_NO_FATAL_FAILURE(LoadSheet(MakePaper(), glm::vec3(1)));
	const double Expected = (1.0 - Share) * FrontColor.g + Share * BackColor.g;
	ExpectClosedForm("sheet under an even sky", EstimateMean(LookAtSheet(), 64, 1), Expected, Tolerance);
	SetVariable("r.RT.Debug.DiffuseTransmission", "0");
	const FEstimate Faulty = EstimateMean(LookAtSheet(), 64, 1);
	EXPECT_LT(Faulty.Mean, 0.7 * Expected) << "the planted fault shows";
}

/// Under a dielectric layer the sum of both sides is below what the layer lets through, and no energy comes from nowhere.
TEST_F(FDiffuseTransmissionTest, LayerKeepsEnergy)
{
	FHostMaterial White = MakePaper(1.0f);
	White.BaseColor = glm::vec4(1);
	White.DiffuseTransmissionColor = glm::vec3(1);
	ASSERT_NO_FATAL_FAILURE(LoadSheet(White, glm::vec3(1)));
	const FEstimate Scatters = EstimateMean(LookAtSheet(), 256, 1);
	White.DiffuseTransmission = 0.0f;
	ASSERT_NO_FATAL_FAILURE(LoadSheet(White, glm::vec3(1)));
	const FEstimate Reflects = EstimateMean(LookAtSheet(), 256, 1);
	PrintFigure(fmt::format("white sheet {:.4f}, without transmission {:.4f}", Scatters.Mean, Reflects.Mean));
	EXPECT_NEAR(Scatters.Mean, Reflects.Mean, 0.005) << "where light comes from makes no difference to a sheet that is white on both sides";
}

TEST_F(FDiffuseTransmissionTest, SunShinesFromBehind)
{
	ASSERT_NO_FATAL_FAILURE(LoadSheet(MakePaper(), glm::vec3(0)));
	const glm::dvec3 Direction = glm::normalize(glm::dvec3(0.3, -0.4, 1.0)); // towards the camera
	const double Expected = 4.0 * Direction.z * Share * BackColor.g / Pi;
	for (const double Diameter : {0.0, 0.5})
	{
		SetSun(Diameter, 4.0f, Direction);
		ExpectClosedForm("sun from behind", EstimateMean(LookAtSheet(), 16, 1), Expected, Tolerance);
		const FImage Frame = RenderLighting(LookAtSheet());
		EXPECT_NEAR(MeanGreen(Frame), Expected, 0.01 * Expected) << "frames";
	}
}

/// Whatever its normal, what lets light through is marked, and shows the sun behind it.
TEST_F(FDiffuseTransmissionTest, EveryNormalIsMarked)
{
	constexpr int Side = 24;
	FTestScene Scene("facets");
	const int32_t Paper = Scene.AddMaterial(MakePaper());
	std::vector<FTestScene::FQuad> Facets;
	for (int I = 0; I < Side * Side; ++I)
	{
		const glm::vec3 Center(0.1f * float(I % Side - Side / 2), 0.1f * float(I / Side - Side / 2), 0);
		const glm::vec3 Normal = glm::normalize(glm::vec3(std::sin(1.3f * float(I)), std::cos(2.1f * float(I)), 1.6f));
		const glm::vec3 X = 0.03f * glm::normalize(glm::cross(glm::vec3(0, 1, 0), Normal)), Y = glm::cross(Normal, X);
		Facets.push_back({Paper, {Center - X - Y, Center + X - Y, Center + X + Y, Center - X + Y}});
	}
	Scene.AddNode(Scene.AddMesh(Facets));
	ASSERT_TRUE(Load(std::move(Scene.Scene)));
	SetSun(0.0, 4.0f, {0, 0, 1});
	SetVariable("r.RT.Shadow.Denoise", "0");
	const FImage Picture = RenderSignal(ESignal::SunShadow, LookAt({0, 0, 4}, {0, 0, 0}, 0.6f, 256, 256));
	EXPECT_EQ(std::count(Picture.Pixels.begin(), Picture.Pixels.end(), 1.0f), std::ptrdiff_t(Picture.Pixels.size()));
}

TEST_F(FDiffuseTransmissionTest, LampShinesFromBehind)
{
	ASSERT_NO_FATAL_FAILURE(LoadSheet(MakePaper(), glm::vec3(0)));
	AddLamp({0, 0, -2});
	const FView View = LookAt({0, 0, 4}, {0, 0, 0}, glm::radians(0.5f), 32, 32);
	const double Expected = 6.0 / 4.0 * Share * BackColor.g / Pi;
	ExpectClosedForm("lamp behind", EstimateMean(View, 16, 1), Expected, Tolerance);
	EXPECT_NEAR(MeanGreen(RenderLighting(View)), Expected, 0.01 * Expected) << "frames";
	SetVariable("r.RT.Lights", "0");
	EXPECT_NEAR(MeanGreen(RenderLighting(View)), Expected, 0.01 * Expected) << "without rays";
}

TEST_F(FDiffuseTransmissionTest, SunAsTheReference)
{
	ASSERT_NO_FATAL_FAILURE(LoadScreens());
	SetVariable("r.RT.Shadow.Denoise", "0");
	ExpectUnbiased("sun on screens", ESignal::SunShadow, LookAtScreens(), 8, 8, 1, 0.01);
}

TEST_F(FDiffuseTransmissionTest, LampsAsTheReference)
{
	ASSERT_NO_FATAL_FAILURE(LoadScreens());
	SetSun(0.0, 0.0f);
	SetVariable("r.RT.Lights.Denoise", "0");
	AddLamp({-1.0, 1.0, -1.6});
	AddLamp({0.7, 0.9, 1.2}, 0.1f);
	AddLamp({1.2, 1.4, -1.0}, 0.1f);
	ExpectUnbiased("lamps on screens", ESignal::LocalDiffuse, LookAtScreens(), 16, 32, 1, 0.01);
	SetVariable("r.RT.Lights.Exact", "1");
	ExpectUnbiased("lamps on screens, chosen", ESignal::LocalDiffuse, LookAtScreens(), 64, 32, 1, 0.015);
	SetVariable("r.RT.Lights.Candidates", "0");
	ExpectUnbiased("lamps on screens, by a walk", ESignal::LocalDiffuse, LookAtScreens(), 64, 32, 1, 0.015);
}

// An emitter parallel to a sheet: a ray that started behind the sheet and was as long as one from its front would end in the emitter.
TEST_F(FDiffuseTransmissionTest, PanelShinesFromBehind)
{
	FTestScene Scene("panel");
	Scene.AddNode(Scene.AddMesh({MakeWall(Scene.AddMaterial(MakePaper()), 4.0f, 0.0f)}));
	Scene.AddNode(Scene.AddMesh({MakeWall(Scene.AddLambert(glm::vec3(0), glm::vec3(5)), 0.5f, -0.5f)}));
	ASSERT_TRUE(Load(std::move(Scene.Scene)));
	SetSun(0.0, 0.0f);
	SetSky(glm::vec3(0));
	SetVariable("r.RT.Lights.Denoise", "0");
	const FView View = LookAt({0, 0, 4}, {0, 0, 0}, glm::radians(0.5f), 32, 32);
	// A square of side 1 at half its side, over its middle: of Hottel, four quarters of A / (1 + A²)^½ atan(B / (1 + A²)^½), twice.
	const double Root = std::sqrt(2.0), FormFactor = 4.0 * (1.0 / (2.0 * Pi)) * 2.0 * (1.0 / Root) * std::atan(1.0 / Root);
	const double Expected = 5.0 * FormFactor * Share * BackColor.g;
	ExpectClosedForm("panel behind paper", EstimateMean(View, 256, 1), Expected, 0.01);
	SetIndirect(1, 1);
	const FEstimate Frames = EstimateFrames(ESignal::LocalDiffuse, View, 64);
	const double Signal = 5.0 * FormFactor * Share * BackColor.g / ((1.0 - Share) * FrontColor.g + Share * BackColor.g);
	ExpectClosedForm("panel behind paper, frames", Frames, Signal, 0.015);
	const FEstimate Reference = EstimateSignal(ESignal::LocalDiffuse, View, 256, 1);
	ExpectClosedForm("panel behind paper, reference of the signal", Reference, Signal, 0.015);
}

/// What sends all of its diffuse light to the other side still has a specular lobe.
TEST_F(FDiffuseTransmissionTest, SpecularLobeOfTheFrontKeepsItsLight)
{
	FHostMaterial Silk = MakePaper(1.0f);
	Silk.DiffuseTransmission = 1.0f;
	ASSERT_NO_FATAL_FAILURE(LoadSheet(Silk, glm::vec3(1)));
	SetVariable("r.RT.GI", "3");
	SetVariable("r.RT.GI.Denoise", "0");
	for (const char* const Reuse : {"0", "1"})
	{
		SetVariable("r.RT.GI.Reuse", Reuse);
		for (const ESignal Signal : {ESignal::RoughSpecular, ESignal::DiffuseGI})
		{
			const double Mean = MeanGreen(RenderSignal(Signal, LookAtSheet(), 64));
			PrintFigure(fmt::format("{} of silk under a sky of 1, reuse {}: {:.4f}", GetSignalInfo(Signal).Name, Reuse, Mean));
			EXPECT_NEAR(Mean, 1.0, Signal == ESignal::DiffuseGI ? 0.01 : 0.03) << "fits of the lobe's albedo are off by up to 2 %";
		}
	}
}

TEST_F(FDiffuseTransmissionTest, IndirectLightAsTheReference)
{
	ASSERT_NO_FATAL_FAILURE(LoadScreens());
	SetIndirect(16, 2);
	ExpectUnbiased("GI of screens", ESignal::DiffuseGI, LookAtScreens(), 3, 48, 3, 0.01);
}

/// Paths of neighbours, a guide and a second lobe find what paths of all pixels find.
TEST_F(FDiffuseTransmissionTest, SharedPathsAsTheReference)
{
	ASSERT_NO_FATAL_FAILURE(LoadScreens());
	SetVariable("r.RT.GI.Denoise", "0");
	SetVariable("r.RT.GI", "3");
	SetVariable("r.RT.GI.Cells.Capacity", "65536");
	SetVariable("r.RT.GI.Guide", "1");
	for (const char* const Name : {"r.RT.GI.Reuse", "r.RT.GI.RoughSpecular"}) { SetVariable(Name, "1"); }
	RenderSignal(ESignal::DiffuseGI, LookAtScreens(), 60); // cells need some frames
	const FImage Frames = RenderSignal(ESignal::DiffuseGI, LookAtScreens(), 120, 60);
	const FImage Reference = TraceSignal(ESignal::DiffuseGI, LookAtScreens(), 256);
	const double Ratio = ComputeMeans(Frames).Luminance / ComputeMeans(Reference).Luminance;
	PrintFigure(fmt::format("GI of screens by cells and shared paths: {:.4f} of the reference", Ratio));
	EXPECT_NEAR(Ratio, 1.0, 0.02) << "the bias of cells that route 3 may have";
	SetVariable("r.RT.Debug.DiffuseTransmission", "0");
	const FImage Faulty = RenderSignal(ESignal::DiffuseGI, LookAtScreens(), 60, 180);
	EXPECT_LT(ComputeMeans(Faulty).Luminance / ComputeMeans(Reference).Luminance, 0.98) << "the planted fault shows";
}

/// A room that is lit through a wall of paper alone.
TEST_F(FDiffuseTransmissionTest, RoomBehindPaperAsTheReference)
{
	FTestScene Scene("paper room");
	const int32_t Wall = Scene.AddLambert(glm::vec3(0.6f), glm::vec3(0), true);
	const int32_t Paper = Scene.AddMaterial(MakePaper());
	const float S = 2.0f;
	Scene.AddNode(
	    Scene.AddMesh({{Wall, {{-S, 0, -S}, {-S, 0, S}, {S, 0, S}, {S, 0, -S}}}, {Wall, {{-S, S, -S}, {S, S, -S}, {S, S, S}, {-S, S, S}}},
	        {Wall, {{-S, 0, -S}, {S, 0, -S}, {S, S, -S}, {-S, S, -S}}}, {Wall, {{-S, 0, -S}, {-S, S, -S}, {-S, S, S}, {-S, 0, S}}},
	        {Wall, {{S, 0, -S}, {S, 0, S}, {S, S, S}, {S, S, -S}}}, {Paper, {{-S, 0, S}, {-S, S, S}, {S, S, S}, {S, 0, S}}}}));
	ASSERT_TRUE(Load(std::move(Scene.Scene)));
	SetSun(0.5, 20.0f, {0.2, -0.5, -1.0}); // on the paper, from outside
	SetSky(glm::vec3(0.5f));
	SetVariable("r.RT.GI", "3");
	SetVariable("r.RT.GI.Denoise", "0");
	SetVariable("r.RT.GI.Cells.Capacity", "65536");
	const FView View = LookAt({0, 1.0, 1.6}, {0.2, 0.8, -2}, 1.1f, 64, 36);
	RenderSignal(ESignal::DiffuseGI, View, 120);
	const FImage Frames = RenderSignal(ESignal::DiffuseGI, View, 60, 120);
	const FImage Reference = TraceSignal(ESignal::DiffuseGI, View, 256);
	const double Ratio = ComputeMeans(Frames).Luminance / ComputeMeans(Reference).Luminance;
	PrintFigure(fmt::format("room behind paper: {:.4f} of the reference", Ratio));
	EXPECT_GT(ComputeMeans(Reference).Luminance, 0.01);
	EXPECT_NEAR(Ratio, 1.0, 0.03) << "the bias of cells that gi.md allows: light of many bounces";
}

TEST_F(FDiffuseTransmissionTest, WholePictureAsTheReference)
{
	ASSERT_NO_FATAL_FAILURE(LoadScreens());
	AddLamp({-1.0, 1.0, -1.6});
	SetVariable("r.RT.GI", "3");
	SetVariable("r.RT.GI.Cells.Capacity", "65536");
	for (const char* const Half : {"0", "1"})
	{
		for (const char* const Name : {"r.RT.Lights.HalfResolution", "r.RT.GI.HalfResolution"}) { SetVariable(Name, Half); }
		FImage Picture;
		for (int Frame = 0; Frame < 60; ++Frame) { Picture = RenderLighting(LookAtScreens(96, 54)); }
		const FImage Reference = TraceReference(LookAtScreens(96, 54), 128);
		const double Ratio = ComputeMeans(Picture).Luminance / ComputeMeans(Reference).Luminance;
		PrintFigure(fmt::format("screens, half resolution {}: {:.4f} of the reference", Half, Ratio));
		EXPECT_NEAR(Ratio, 1.0, 0.02);
	}
}

/// Edited while it is drawn, a material looks as if it had been loaded so.
TEST_F(FDiffuseTransmissionTest, MaterialMayChange)
{
	FHostMaterial Paper = MakePaper();
	Paper.DiffuseTransmission = 0.0f;
	ASSERT_NO_FATAL_FAILURE(LoadSheet(Paper, glm::vec3(0)));
	SetSun(0.0, 4.0f, {0.3, -0.4, 1.0});
	EXPECT_EQ(MeanGreen(RenderLighting(LookAtSheet())), 0.0) << "the sun is behind";
	FRTScene& Scene = GetScene().GetScene();
	FMaterialData Data = Scene.GetMaterials()[0];
	Data.DiffuseTransmission = Share;
	Data.DiffuseTransmissionColor = BackColor;
	Scene.SetMaterial(0, Data);
	const double Expected = 4.0 * glm::normalize(glm::dvec3(0.3, -0.4, 1.0)).z * Share * BackColor.g / Pi;
	EXPECT_NEAR(MeanGreen(RenderLighting(LookAtSheet())), Expected, 0.01 * Expected);
	Data.DiffuseTransmission = 0.0f;
	Scene.SetMaterial(0, Data);
	EXPECT_EQ(MeanGreen(RenderLighting(LookAtSheet())), 0.0);
}

/// Off, a sheet looks as if its material said nothing of what scatters through.
TEST_F(FDiffuseTransmissionTest, VariableTurnsItOff)
{
	FHostMaterial Opaque = MakePaper(1.0f);
	ASSERT_NO_FATAL_FAILURE(LoadSheet(Opaque, glm::vec3(0.4f)));
	SetSun(0.0, 4.0f, {0.3, -0.4, 1.0});
	const FImage On = RenderLighting(LookAtSheet());
	SetVariable("r.RT.DiffuseTransmission", "0");
	const FImage Off = RenderLighting(LookAtSheet());
	Opaque.DiffuseTransmission = 0.0f;
	ASSERT_NO_FATAL_FAILURE(LoadSheet(Opaque, glm::vec3(0.4f)));
	SetSun(0.0, 4.0f, {0.3, -0.4, 1.0});
	const FImage Without = RenderLighting(LookAtSheet());
	EXPECT_LT(MaxDifference(Off, Without), 1e-3);
	EXPECT_GT(MeanGreen(On), 1.2 * MeanGreen(Off));
}

/// A scene without such materials has no plane for them, and its shaders know none.
TEST_F(FDiffuseTransmissionTest, NothingOfItWithoutSuchMaterials)
{
	FHostMaterial Opaque = MakePaper(1.0f);
	for (const float Of : {0.0f, Share})
	{
		Opaque.DiffuseTransmission = Of;
		ASSERT_NO_FATAL_FAILURE(LoadSheet(Opaque, glm::vec3(0.4f)));
		RenderLighting(LookAtSheet()); // which takes over the variables
		const FFrameFeatures Features;
		EXPECT_EQ(GetEngine().GetRenderer().HasBackPixels(GetScene().GetScene(), Features), Of > 0.0f);
		const FRTPSODesc Programs = GetEngine().GetRenderer().GetRayPrograms(GetScene().GetScene(), Features);
		for (const FRayType& Type : Programs.RayTypes)
		{
			if (!Type.ClosestHit) { continue; }
			const auto& Defines = Type.ClosestHit->Defines;
			const bool bKnows =
			    std::any_of(Defines.begin(), Defines.end(), [](const auto& Define) { return Define.first == "HAS_DIFFUSE_TRANSMISSION"; });
			if (Type.Name == "MATERIAL" || Type.Name == "STANDARD") { EXPECT_EQ(bKnows, Of > 0.0f) << Type.Name; }
		}
	}
}
} // namespace

} // namespace Lantern
