// Alpha-tested geometry told apart by opacity and cut into pieces: the same pictures with fewer alpha tests.
#include "LanternScene/Opacity/OpacityClassifier.h"
#include "Support/RenderFixture.h"
#include "Support/TestScene.h"

namespace Lantern
{

namespace
{
class FOpacityTest : public FRenderTest
{
protected:
	void SetUp() override
	{
		FRenderTest::SetUp();
		SetVariable("r.RT.Opacity.Count", "1");
		SetVariable("r.RT.Opacity.Pieces", "3");
	}
	void TearDown() override
	{
		SetVariable("r.RT.Opacity.Count", "0");
		SetVariable("r.RT.Opacity.Classify", "1");
		SetVariable("r.RT.Opacity.Pieces", "0");
		FRenderTest::TearDown();
	}
	/// The frame before builds.
	FImage CountShadow(const FView& View, bool bClassified, uint64_t& OutCalls)
	{
		SetVariable("r.RT.Opacity.Classify", bClassified ? "1" : "0");
		(void)RenderSunShadow(View, 1, 3);
		const uint64_t Before = GetCalls();
		FImage Image = RenderSunShadow(View, 1, 3);
		OutCalls = GetCalls() - Before;
		return Image;
	}
	static uint64_t GetCalls()
	{
		EXPECT_TRUE(GetEngine().GetRenderer().WaitForAll());
		return GetEngine().GetRenderer().GetAnyHits().Total;
	}
	void ExpectSame(const FView& View, double MostRatio, const std::string& What)
	{
		for (const char* Path : {"1", "2"})
		{
			SetVariable("r.RT.Shadow.Path", Path);
			uint64_t Plain = 0, Classified = 0;
			const FImage A = CountShadow(View, false, Plain), B = CountShadow(View, true, Classified);
			EXPECT_EQ(FractionDiffering(A, B, 0.0), 0.0) << What << ", path " << Path;
			const double Mean = MeanGreen(A);
			EXPECT_TRUE(Mean > 0.02 && Mean < 0.999) << "there must be light and shadow to tell: " << Mean;
			EXPECT_GT(Plain, 500u) << What;
			EXPECT_LE(static_cast<double>(Classified), MostRatio * static_cast<double>(Plain)) << What << ", path " << Path;
			PrintFigure(fmt::format("{}, path {}: {} of {} alpha tests", What, Path, Classified, Plain));
		}
	}
};

/// Cards over a floor: one whose alpha is a disk, seen from below in its shadow.
FTestScene MakeCards(glm::vec2 UVScale)
{
	FTestScene Cards("cards");
	const int32_t Floor = Cards.AddLambert(glm::vec3(0.5f)), Card = Cards.AddHalfCutLambert();
	FHostImage& Image = Cards.Scene.Images.back();
	for (int I = 0; I < 64 * 64; ++I)
	{
		const double X = I % 64 - 31.5, Y = I / 64 - 31.5;
		Image.Rgba[4 * I + 3] = X * X + Y * Y < 24.0 * 24.0 ? 255 : 0;
	}
	Cards.Scene.Textures.back().bNearest = false;
	Cards.Scene.Textures.back().bRepeatU = Cards.Scene.Textures.back().bRepeatV = true;
	Cards.Scene.Materials.back().Slots[TEXTURE_BASE_COLOR].Transform = glm::vec4(UVScale.x, 0, 0, UVScale.y);
	Cards.AddNode(Cards.AddMesh({FTestScene::MakeFloor(Floor, 20.0f)}));
	const int32_t Mesh = Cards.AddMesh({FTestScene::MakeFloor(Card, 1.0f, 2.0f)});
	for (int X = -2; X <= 2; ++X)
	{
		glm::dmat4 Matrix(1.0);
		Matrix[0] *= 1.0 + 0.1 * X;
		Matrix[3] = glm::dvec4(1.7 * X, 0.3 * X, 0.2 * X * X, 1.0);
		Cards.AddNode(Mesh, Matrix);
	}
	return Cards;
}
} // namespace

TEST_F(FOpacityTest, CourtyardIsTheSame)
{
	ASSERT_TRUE(Load("courtyard"));
	EXPECT_GT(GetScene().GetOpacity().Pieces, GetScene().GetOpacity().Counts.Mixed);
	SetSun(3.0);
	SetVariable("r.RT.Shadow.Samples", "4");
	ExpectSame(MakeView(192, 108), 0.6, "courtyard");
}

TEST_F(FOpacityTest, CardsAreTheSame)
{
	for (const glm::vec2 Scale : {glm::vec2(1), glm::vec2(2, -1), glm::vec2(0.7f, 1.3f)})
	{
		ASSERT_TRUE(Load(MakeCards(Scale).Scene));
		SetSun(2.0, 4.0f, {0.3, -1, 0.1});
		SetVariable("r.RT.Shadow.Samples", "4");
		const FView View = LookAt({0, 1.0, 6}, {0, 0, 0}, 1.2f, 128, 96);
		ExpectSame(View, 0.8, fmt::format("cards, texture {} × {}", Scale.x, Scale.y));
	}
}

TEST_F(FOpacityTest, WholeTrianglesAloneAreTheSame)
{
	SetVariable("r.RT.Opacity.Pieces", "0");
	// Only the disk's inside, and only what lies around it.
	for (const glm::vec2 Scale : {glm::vec2(0.02f), glm::vec2(1)})
	{
		FTestScene Cards = MakeCards(Scale);
		for (FVertexAttributes& Vertex : Cards.Scene.Meshes.back().Attributes)
		{
			Vertex.UV0 += Scale.x < 1.0f ? glm::vec2(25.0f) : glm::vec2(0.0f);
		}
		ASSERT_TRUE(Load(std::move(Cards.Scene)));
		EXPECT_EQ(GetScene().GetOpacity().Pieces, 0u);
		EXPECT_EQ(GetScene().GetOpacity().Counts.Opaque, Scale.x < 1.0f ? 2u : 0u);
		SetSun(2.0, 4.0f, {0.3, -1, 0.1});
		ExpectSame(LookAt({0, 1.0, 6}, {0, 0, 0}, 1.2f, 128, 96), Scale.x < 1.0f ? 0.0 : 1.0, "whole triangles");
	}
}

TEST_F(FOpacityTest, SolidWhereAlphaTestsAreOff)
{
	ASSERT_TRUE(Load(MakeCards(glm::vec2(1)).Scene));
	SetSun(0.0, 4.0f, {0.3, -1, 0.1});
	const FView View = LookAt({0, 1.0, 6}, {0, 0, 0}, 1.2f, 128, 96);
	uint64_t Calls = 0;
	const FImage Tested = CountShadow(View, true, Calls);
	for (const char* Path : {"1", "2"})
	{
		SetVariable("r.RT.Shadow.Path", Path);
		for (const auto& [Name, Off, On] : {std::tuple("r.RT.AlphaTest", "0", "1"), std::tuple("r.RT.Material.Override", "2", "0")})
		{
			SetVariable(Name, Off);
			SetVariable("r.RT.Opacity.Classify", "0");
			const FImage Plain = RenderSunShadow(View, 1, 3);
			SetVariable("r.RT.Opacity.Classify", "1");
			const FImage Solid = RenderSunShadow(View, 1, 3);
			EXPECT_EQ(FractionDiffering(Plain, Solid, 0.0), 0.0) << Name;
			EXPECT_LT(MeanGreen(Solid), MeanGreen(Tested)) << Name << ": cards are whole";
			SetVariable(Name, On);
			EXPECT_EQ(FractionDiffering(RenderSunShadow(View, 1, 3), Tested, 0.0), 0.0) << "and back";
		}
	}
}

TEST_F(FOpacityTest, ReferenceIsTheSame)
{
	ASSERT_TRUE(Load("courtyard"));
	SetSun(0.53);
	const FView View = MakeView(96, 54);
	SetVariable("r.RT.Opacity.Classify", "0");
	const FImage Plain = TraceReference(View, 2, 4);
	SetVariable("r.RT.Opacity.Classify", "1");
	const FImage Classified = TraceReference(View, 2, 4);
	// The same random numbers, and hits found in the same way: no path may go elsewhere.
	EXPECT_LE(MaxDifference(Plain, Classified), 1e-3);
}

} // namespace Lantern
