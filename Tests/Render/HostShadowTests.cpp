// Sun shadows by a host's shadow map and rays, against the picture of rays alone. Both take the same random numbers, so that pixels that
// are traced are equal to the bit.
#include <fstream>

#include <glm/gtc/matrix_transform.hpp>

#include "LanternRenderer/HostShadow.h"
#include "Support/RenderFixture.h"
#include "Support/SharedFiles.h"
#include "Support/TestScene.h"

namespace Lantern
{

namespace
{
// Values of r.RT.HostShadow.
constexpr const char *NoMap = "0", *NoCasters = "1", *StillCasters = "2", *AllCasters = "3", *OtherCasters = "4";

class FHostShadowTest : public FRenderTest
{
protected:
	void SetUp() override
	{
		FRenderTest::SetUp();
		SetVariable("r.RT.Shadow.Denoise", "0");
		SetVariable("r.RT.HostShadow.Resolution", "1024");
		SetVariable("r.RT.HostShadow.Distance", "40");
	}
	static std::vector<FTestScene::FQuad> MakeBox(int32_t Material, glm::vec3 Min, glm::vec3 Max)
	{
		std::vector<FTestScene::FQuad> Out;
		for (int Axis = 0; Axis < 3; ++Axis)
		{
			for (const bool bFar : {false, true})
			{
				FTestScene::FQuad Quad{Material, {}};
				for (int Corner = 0; Corner < 4; ++Corner)
				{
					glm::vec3& P = Quad.P[bFar ? Corner : 3 - Corner];
					P[Axis] = bFar ? Max[Axis] : Min[Axis];
					P[(Axis + 1) % 3] = Corner == 1 || Corner == 2 ? Max[(Axis + 1) % 3] : Min[(Axis + 1) % 3];
					P[(Axis + 2) % 3] = Corner >= 2 ? Max[(Axis + 2) % 3] : Min[(Axis + 2) % 3];
				}
				Out.push_back(Quad);
			}
		}
		return Out;
	}
	/// A floor with a hall, a roof on a post, something that moves and a character: casters of each kind, near and high.
	void LoadYard()
	{
		FTestScene Yard("yard");
		const int32_t Grey = Yard.AddLambert(glm::vec3(0.5f));
		Yard.AddNode(Yard.AddMesh({FTestScene::MakeFloor(Grey, 30.0f)}));
		const std::pair<glm::vec3, glm::vec3> Boxes[] = {{{-6, 0, -4}, {-2, 3, -2}}, {{1, 2.5, -5}, {5, 2.7, -1}},
		    {{3, 0, -3}, {3.1, 2.5, -2.9}}, {{-1, 0.5, -1}, {0, 1.5, 0}}, {{1.5, 0, 0.5}, {2, 1.8, 1}}};
		for (const auto& [Min, Max] : Boxes) { Yard.AddNode(Yard.AddMesh(MakeBox(Grey, Min, Max))); }
		ASSERT_TRUE(Load(std::move(Yard.Scene)));
		SetMask(4, MASK_VISIBLE | MASK_SUN_MOVING);
		SetMask(5, MASK_VISIBLE | MASK_CHARACTER);
	}
	static void SetMask(size_t Draw, uint32_t Mask)
	{
		GetScene().GetScene().SetMask(GetScene().GetDraws()[Draw].Object, static_cast<uint8_t>(Mask));
	}
	static FView LookAtYard(uint32_t Width = 192, uint32_t Height = 108)
	{
		return LookAt({-1, 4, 8}, {-0.5, 0.5, -1}, 1.0f, Width, Height);
	}
	FImage Render(const char* Casters, const FView& View, uint32_t Frame = 0)
	{
		SetVariable("r.RT.HostShadow", Casters);
		return RenderSunShadow(View, 1, Frame);
	}
	/// Holds each kind of map against rays alone. At most 0.5 % of the pixels may differ at all: those at edges that the map has
	/// elsewhere, by less than a texel.
	void ExpectAsRays(const FView& View, const char* What)
	{
		const FImage Rays = Render(NoMap, View);
		ASSERT_TRUE(MeanGreen(Rays) > 0.2 && MeanGreen(Rays) < 0.95) << "there must be light and shadow: " << MeanGreen(Rays);
		EXPECT_EQ(Render(NoCasters, View).Pixels, Rays.Pixels) << What << ": all rays are traced";
		for (const char* const Casters : {StillCasters, AllCasters})
		{
			const double Differing = FractionDiffering(Render(Casters, View), Rays, 1e-3);
			PrintFigure(fmt::format("{}, map {}: {:.3f} % of the pixels differ", What, Casters, 100.0 * Differing));
			EXPECT_LE(Differing, 0.005) << What << ", casters " << Casters;
		}
	}
	/// Share of the pixels that ask for rays. A queue without room answers none of them: they are lit, or keep the frame before.
	double MeasureAsked(const char* Casters, const FView& View, glm::dvec3 Sun)
	{
		SetVariable("r.RT.HostShadow", Casters);
		const auto RenderWithoutRoom = [&](const char* PerPixel) {
			SetVariable("r.RT.Rays.QueuePerPixel", PerPixel); // another value, so that queues stay as small
			return RenderSunShadow(View);
		};
		EXPECT_OK(GetEngine().RenderFrame(LookAtYard(8, 8), 0.0, {}, nullptr)); // another size: nothing to keep
		const FImage Lit = RenderWithoutRoom("0.0002");
		SetSun(0.5, 4.0f, {0.01, 1, 0.02}); // from below: all is dark
		(void)RenderWithoutRoom("0.0003");
		SetSun(0.5, 4.0f, Sun);
		const FImage Kept = RenderWithoutRoom("0.0004");
		SetVariable("r.RT.Rays.QueuePerPixel", "2");
		double Asked = 0.0;
		for (size_t I = 0; I < Lit.Pixels.size(); ++I) { Asked += Lit.Pixels[I] == 1.0f && Kept.Pixels[I] == 0.0f ? 1.0 : 0.0; }
		return Asked / double(Lit.Pixels.size());
	}
};

TEST_F(FHostShadowTest, EqualsRays)
{
	ASSERT_NO_FATAL_FAILURE(LoadYard());
	for (const double Diameter : {0.0, 0.533, 4.0})
	{
		SetSun(Diameter, 4.0f, {0.25, -1.0, 0.35});
		SetVariable("r.RT.Shadow.Samples", "4");
		for (const char* const Path : {"1", "2"})
		{
			SetVariable("r.RT.Shadow.Path", Path);
			ExpectAsRays(LookAtYard(), fmt::format("sun of {}°, path {}", Diameter, Path).c_str());
		}
	}
	SetSun(0.533, 4.0f, {0.9, -0.5, 0.2}); // a low sun, whose map is at a slant
	ExpectAsRays(LookAtYard(), "low sun");
}

TEST_F(FHostShadowTest, EqualsRaysInTheCourtyard)
{
	ASSERT_TRUE(Load("courtyard"));
	ExpectAsRays(MakeView(192, 108), "courtyard");
}

// Rays that trace what the map holds, times the map: penumbrae are darker than they should be.
TEST_F(FHostShadowTest, PlantedFaultDoublesPenumbrae)
{
	ASSERT_NO_FATAL_FAILURE(LoadYard());
	SetSun(8.0, 4.0f);
	SetVariable("r.RT.Shadow.Samples", "16");
	const FView View = LookAtYard();
	const FImage Rays = Render(NoMap, View), Right = Render(AllCasters, View);
	EXPECT_LE(FractionDiffering(Right, Rays, 0.1), 0.005);
	SetVariable("r.RT.Debug.Shadow.HostMap.Held", "0");
	const FImage Doubled = Render(AllCasters, View);
	EXPECT_GT(FractionDiffering(Doubled, Rays, 0.1), 0.01) << "twice the limit at least";
	EXPECT_LT(MeanGreen(Doubled), MeanGreen(Rays) - 0.002);
}

// A caster that rays cannot meet, as a billboard: its shadow comes from the map, as wide as that of rays.
TEST_F(FHostShadowTest, OthersMultiply)
{
	ASSERT_NO_FATAL_FAILURE(LoadYard());
	SetSun(2.0, 4.0f);
	SetVariable("r.RT.Shadow.Samples", "64");
	SetVariable("r.RT.HostShadow.Resolution", "2048");
	const FView View = LookAtYard();
	const FImage Rays = Render(NoMap, View);
	SetMask(2, MASK_VISIBLE);
	const FImage Without = Render(NoMap, View), Map = Render(OtherCasters, View);
	EXPECT_GT(FractionDiffering(Without, Rays, 0.5), 0.01) << "the roof must be missed";
	const double Worst = MaxDifference(Shrink(Map, 4), Shrink(Rays, 4));
	PrintFigure(fmt::format("a billboard's shadow: 4 × 4 pixels off by {:.3f} at most", Worst));
	EXPECT_NEAR(MeanGreen(Map), MeanGreen(Rays), 0.003);
	// The filter takes 32 points of the disk, and one distance for all blockers.
	EXPECT_LE(FractionDiffering(Map, Rays, 0.2), 0.01);
}

TEST_F(FHostShadowTest, RaysAreSaved)
{
	ASSERT_NO_FATAL_FAILURE(LoadYard());
	const glm::dvec3 Sun(0.25, -1.0, 0.35);
	SetSun(0.5, 4.0f, Sun);
	SetVariable("r.RT.HostShadow.Resolution", "2048");
	const FView View = LookAtYard();
	const double All = MeasureAsked(NoMap, View, Sun), Held = MeasureAsked(AllCasters, View, Sun);
	PrintFigure(fmt::format("pixels that ask for rays: {:.3f} without a map, {:.3f} with one", All, Held));
	EXPECT_EQ(MeasureAsked(NoCasters, View, Sun), All) << "a map of nothing answers nothing";
	EXPECT_LT(Held, 0.25);
	// What moves is not on the map: rays look for it wherever the map is lit, and nowhere where it is dark.
	const double Still = MeasureAsked(StillCasters, View, Sun);
	EXPECT_LT(Still, All - 0.02);
	EXPECT_GT(Still, Held);
	// Texels larger than pixels do not answer for lit surfaces.
	SetVariable("r.RT.HostShadow.Resolution", "64");
	EXPECT_GT(MeasureAsked(AllCasters, View, Sun), 0.5 * All);
}

// An engine whose map is none of cascades: its file takes the place of the plugin's. Here the map is dark where x < 0, and unsure near 0.
TEST_F(FHostShadowTest, HostsBringTheirOwnShader)
{
	const FTemporaryFolder Folder;
	const std::string File = Folder / "VirtualShadowMap.glsl";
	std::ofstream(File) << R"(
#include "Library/GBuffer.glsl"
#include "Tiles/HostShadowAnswer.glsl"
FHostShadowAnswer ClassifyHostShadow(FAddress Data, FViewConstants View, FGBufferPoint Surface)
{
	float X = View.CameraPosition.x + Surface.Relative.x;
	return FHostShadowAnswer(abs(X) < 0.5 ? HOST_SHADOW_UNSURE : X < 0.0 ? HOST_SHADOW_DARK : HOST_SHADOW_LIT, 1.0);
}
bool IsHostShadowKept(FAddress Data) { return false; }
float FilterHostShadow(FAddress Data, FViewConstants View, FGBufferPoint Surface) { return 1.0; }
)";
	FRendererDesc Desc;
	Desc.ShaderFolders = {LANTERN_SOURCE_DIR "/Shaders"};
	Desc.ShaderHeaders = {MakeHostShadowHeader(File)};
	FSampleEngine Own(GetDevice(), Desc);
	FTestScene Flat("flat");
	Flat.AddNode(Flat.AddMesh({FTestScene::MakeFloor(Flat.AddLambert(glm::vec3(0.5f)), 8.0f)}));
	ASSERT_OK(Own.Load(std::move(Flat.Scene)));
	FSunLight Sun;
	Sun.Irradiance = 4.0f;
	Own.GetScene().SetSun(Sun);
	SetVariable("r.RT.HostShadow", AllCasters);
	FFrameCapture Capture;
	Capture.Signals.Add(ESignal::SunShadow);
	FCapturedFrame Out;
	ASSERT_OK(Own.RenderFrame(LookAt({0, 1, 0}, {0, 0, 0}, 2.0f * std::atan(2.0f), 64, 64), 0.0, Capture, &Out)); // 4 m across
	const FImage& Shadow = Out.Get(ESignal::SunShadow);
	for (uint32_t X = 0; X < 64; ++X) { ASSERT_EQ(Shadow.At(X, 32, 0), X < 24 ? 0.0f : 1.0f) << X; }
}

// Far from the world's origin, numbers of the map's matrix are large.
TEST_F(FHostShadowTest, FarFromOrigin)
{
	ASSERT_NO_FATAL_FAILURE(LoadYard());
	SetSun(0.533);
	const glm::dvec3 Far(30000.0, 0.0, -20000.0);
	(void)Render(NoMap, LookAtYard()); // the first frame places all as its time says
	for (size_t I = 0; I < GetScene().GetDraws().size(); ++I) { GetScene().SetTransform(I, glm::translate(glm::dmat4(1), Far)); }
	FView View = LookAtYard();
	View.Position += Far;
	ExpectAsRays(View, "36 km from the origin");
}

TEST_F(FHostShadowTest, OddSizes)
{
	ASSERT_NO_FATAL_FAILURE(LoadYard());
	SetSun(0.533);
	for (const char* const Resolution : {"16", "37", "777"})
	{
		SetVariable("r.RT.HostShadow.Resolution", Resolution);
		for (const char* const Cascades : {"1", "3"})
		{
			SetVariable("r.RT.HostShadow.Cascades", Cascades);
			ExpectAsRays(LookAtYard(67, 41), fmt::format("{} texels, {} cascades", Resolution, Cascades).c_str());
		}
	}
}

} // namespace
} // namespace Lantern
