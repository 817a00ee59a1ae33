// The sky's ambient light with the default settings, against the path tracer: interiors are dark, and metals in them are not black.
#include "Support/RenderFixture.h"
#include "Support/TestScene.h"

namespace Lantern
{

namespace
{

class FSkyAmbientTest : public FRenderTest
{
protected:
	/// A hall of 3 m × 3 m, 12 m deep, open at its front (z = 0) alone.
	static FSceneDescription MakeHall(bool bMetalFloor)
	{
		FTestScene Scene("hall");
		const int32_t Wall = Scene.AddLambert(glm::vec3(0.5f), glm::vec3(0), true);
		int32_t Floor = Wall;
		if (bMetalFloor)
		{
			FHostMaterial Metal;
			Metal.Name = "metal";
			Metal.BaseColor = {0.9f, 0.9f, 0.9f, 1.0f};
			Metal.Metallic = 1.0f;
			Metal.Roughness = 0.1f;
			Metal.bDoubleSided = true;
			Floor = Scene.AddMaterial(Metal);
		}
		constexpr float W = 1.5f, H = 3.0f, D = -12.0f;
		Scene.AddNode(Scene.AddMesh({{Floor, {{-W, 0, 0}, {W, 0, 0}, {W, 0, D}, {-W, 0, D}}},
		    {Wall, {{-W, H, D}, {W, H, D}, {W, H, 0}, {-W, H, 0}}}, {Wall, {{-W, 0, 0}, {-W, 0, D}, {-W, H, D}, {-W, H, 0}}},
		    {Wall, {{W, 0, D}, {W, 0, 0}, {W, H, 0}, {W, H, D}}}, {Wall, {{-W, 0, D}, {W, 0, D}, {W, H, D}, {-W, H, D}}}}));
		return Scene.Scene;
	}

	/// Mean of the plugin's picture by that of the reference.
	double GetRatio(const FView& View)
	{
		SetSun(0.53, 0.0f);
		SetSky(glm::vec3(1));
		SetVariable("r.RT.AO.Samples", "16");
		SetVariable("r.RT.AO.Denoise", "0");
		const double Plugin = MeanGreen(RenderLighting(View)), Reference = MeanGreen(TraceReference(View, 256));
		PrintFigure(fmt::format("plugin {:.4f}, reference {:.4f}, ratio {:.2f}", Plugin, Reference, Plugin / Reference));
		EXPECT_GT(Reference, 0.005);
		return Plugin / Reference;
	}
};

// A range of 2 m lets the sky light the whole hall: 24 times the reference.
TEST_F(FSkyAmbientTest, LightsNoInteriorThatTheSkyDoesNotSee)
{
	ASSERT_TRUE(Load(MakeHall(false)));
	const FView View = LookAt({0, 1, -3}, {0, 1.25, -12}, 1.0f, 32, 32);
	const double Ratio = GetRatio(View);
	EXPECT_GT(Ratio, 0.5);
	EXPECT_LT(Ratio, 2.0);
	SetVariable("r.RT.AO.Radius", "2");
	EXPECT_GT(GetRatio(View), 10.0) << "nothing here tells a long range from a short one";
}

// The lobe of a metal sees walls and hardly any sky. The stand-in for its reflection gives 0.45 of the reference, without surroundings 0.23.
TEST_F(FSkyAmbientTest, MetalIsNotBlackForWantOfAReflection)
{
	ASSERT_TRUE(Load(MakeHall(true)));
	const FView View = LookAt({0, 0.8, -4}, {0, 0, -7}, 0.5f, 32, 32);
	const double Ratio = GetRatio(View);
	EXPECT_GT(Ratio, 1.0 / 3.0);
	EXPECT_LT(Ratio, 3.0);
	SetVariable("r.RT.SkyAmbient.Surroundings", "0");
	EXPECT_LT(GetRatio(View), 0.3) << "nothing here needs a stand-in";
}

} // namespace
} // namespace Lantern
