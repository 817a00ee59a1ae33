// Specular lobes lit by diffuse GI's paths: closed form, the reference, and the composite without reflections.
#include <cmath>

#include "SignalFixture.h"

namespace Lantern
{

namespace
{
class FRoughSpecularTest : public FSignalTest
{
protected:
	static FHostMaterial MakeMaterial(const glm::vec3& Color, float Metallic, float Roughness)
	{
		FHostMaterial Material;
		Material.BaseColor = glm::vec4(Color, 1.0f);
		Material.Metallic = Metallic;
		Material.Roughness = Roughness;
		return Material;
	}
	/// A floor before a wall, with a box of light above: what a lobe sees depends on where it looks. Roughness: of the floor.
	[[nodiscard]] bool LoadCorner(float Roughness)
	{
		FTestScene Scene("corner");
		const int32_t Floor = Scene.AddMaterial(MakeMaterial({0.4f, 0.4f, 0.4f}, 0.0f, Roughness)),
		              Wall = Scene.AddMaterial(MakeMaterial({0.8f, 0.2f, 0.1f}, 1.0f, 0.7f)),
		              Lamp = Scene.AddLambert(glm::vec3(0), glm::vec3(6, 5, 4), true);
		Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Floor, 2.0f), FTestScene::MakeFloor(Lamp, 0.4f, 1.6f, {0.8f, -0.6f}),
		    {Wall, {{-2, 0, -1.5f}, {2, 0, -1.5f}, {2, 1.4f, -1.5f}, {-2, 1.4f, -1.5f}}}}));
		if (!Load(std::move(Scene.Scene))) { return false; }
		SetSun(0.533, 2.0f);
		SetSky({0.1f, 0.2f, 0.4f});
		SetIndirect(16, 2);
		SetVariable("r.RT.Reflections", "0");
		return true;
	}
	static FView See(uint32_t Scale = 1) { return LookAt({-0.4, 0.7, 2.2}, {0, 0.3, -0.6}, 0.9f, 48 * Scale, 27 * Scale); }
};

// Case 19: over its albedo, every lobe shows a sky of 1 as 1, as far as the albedo's fit goes (SpecularAlbedo, 2.3 %).
TEST_F(FRoughSpecularTest, FurnaceOfMetalsAndDielectrics)
{
	for (const float Metallic : {0.0f, 1.0f})
	{
		for (const float Roughness : {0.1f, 0.5f, 0.75f, 1.0f})
		{
			FTestScene Plane("plane");
			const int32_t Material = Plane.AddMaterial(MakeMaterial({0.9f, 0.6f, 0.3f}, Metallic, Roughness));
			Plane.AddNode(Plane.AddMesh({FTestScene::MakeFloor(Material, 2.0f)}));
			ASSERT_TRUE(Load(std::move(Plane.Scene)));
			SetSky(glm::vec3(1));
			SetIndirect(16, 1);
			SetVariable("r.RT.Reflections", "0");
			for (const double Mu : {0.3, 0.8})
			{
				const FView View = LookAt(4.0 * glm::dvec3(0, Mu, std::sqrt(1.0 - Mu * Mu)), {0, 0, 0}, glm::radians(0.05f), 32, 32);
				const std::string Name = fmt::format("metalness {}, roughness {}, mu {}", Metallic, Roughness, Mu);
				ExpectClosedForm(Name.c_str(), EstimateFrames(ESignal::RoughSpecular, View, 8), 1.0, 0.025);
			}
		}
	}
}

// With light of a lamp that light sampling finds, by direct light or by the paths themselves.
TEST_F(FRoughSpecularTest, CornerAsTheReference)
{
	ASSERT_TRUE(LoadCorner(0.6f));
	ExpectUnbiased("corner", ESignal::RoughSpecular, See(), 32, 256, 3, 0.01);
	SetVariable("r.RT.Lights.Emissive", "0");
	ExpectUnbiased("corner, lamp found by paths", ESignal::RoughSpecular, See(), 32, 256, 3, 0.01);
}

// No ray follows the specular lobe, and yet the picture has its light.
TEST_F(FRoughSpecularTest, WholeFrameAsTheReference)
{
	ASSERT_TRUE(LoadCorner(0.6f));
	ExpectUnbiased("corner, whole frame", ESignal::Frame, See(), 32, 256, 3, 0.01);
}

// Lobes narrower than the filter can follow have the mean of a wider one.
TEST_F(FRoughSpecularTest, NarrowLobesAreWidened)
{
	ASSERT_TRUE(LoadCorner(0.2f));
	const double Wide = MeanGreen(RenderSignal(ESignal::RoughSpecular, See(), 16));
	ASSERT_TRUE(LoadCorner(0.05f));
	EXPECT_NEAR(MeanGreen(RenderSignal(ESignal::RoughSpecular, See(), 16)) / Wide, 1.0, 0.01);
}

// Where every surface has its reflections traced, nobody needs it.
TEST_F(FRoughSpecularTest, OnlyWhereReflectionsAreNotTraced)
{
	ASSERT_TRUE(LoadCorner(0.6f));
	EXPECT_TRUE(HasSignal(ESignal::RoughSpecular, See()));
	SetVariable("r.RT.Reflections", "2");
	EXPECT_FALSE(HasSignal(ESignal::RoughSpecular, See()));
	SetVariable("r.RT.Reflections.MaxRoughness", "0.5");
	EXPECT_TRUE(HasSignal(ESignal::RoughSpecular, See()));
	SetVariable("r.RT.GI.RoughSpecular", "0");
	EXPECT_FALSE(HasSignal(ESignal::RoughSpecular, See()));
	SetVariable("r.RT.GI.RoughSpecular", "1");
	SetVariable("r.RT.GI", "0");
	EXPECT_FALSE(HasSignal(ESignal::RoughSpecular, See()));
}

// One pixel of four traces; radiance cells end the paths; the filter runs.
TEST_F(FRoughSpecularTest, SparseAndFiltered)
{
	ASSERT_TRUE(LoadCorner(0.6f));
	const FView View = See(4); // edges, at which pixels have few neighbours, are a small part of it
	const double Reference = MeanGreen(TraceSignal(ESignal::RoughSpecular, View, 64));
	SetIndirect(1, 1);
	SetVariable("r.RT.Reflections", "0");
	SetVariable("r.RT.GI", "3");
	SetVariable("r.RT.GI.Rate", "2");
	SetVariable("r.RT.GI.Denoise", "1");
	(void)RenderSignal(ESignal::RoughSpecular, View, 60);
	EXPECT_NEAR(MeanGreen(RenderSignal(ESignal::RoughSpecular, View, 60, 60)) / Reference, 1.0, 0.02);
}

} // namespace
} // namespace Lantern
