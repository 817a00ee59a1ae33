// Textures seen in mirrors: at the level of detail of what a pixel covers there (r.RT.Rays.Cones).
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "SignalFixture.h"

namespace Lantern
{

namespace
{
class FRayConeTest : public FSignalTest
{
protected:
	void SetUp() override
	{
		FSignalTest::SetUp();
		SetVariable("r.RT.GI", "3");
		SetVariable("r.RT.GI.Cells.Capacity", "65536");
		SetVariable("r.RT.Reflections", "1");
		SetVariable("r.RT.Reflections.Denoise", "0");
		SetVariable("r.RT.Lights.Emissive", "0"); // what rays find, and nothing else
	}
	/// A mirror before the camera that shows a board behind it, which shines in squares: Squares of them along its side.
	void LoadBoard(float Squares)
	{
		constexpr uint32_t Size = 64;
		FTestScene Scene("board");
		FHostImage Image;
		Image.Name = "squares";
		Image.Width = Image.Height = Size;
		for (uint32_t I = 0; I < Size * Size; ++I)
		{
			const auto Value = static_cast<uint8_t>((I % Size / (Size / 2) + I / Size / (Size / 2)) % 2 * 255);
			for (const uint8_t Channel : {Value, Value, Value, uint8_t(255)}) { Image.Rgba.push_back(Channel); }
		}
		Scene.Scene.Images.push_back(std::move(Image));
		Scene.Scene.Textures.push_back({.Image = 0});
		const int32_t Bright = Scene.AddLambert(glm::vec3(0), glm::vec3(1), true);
		FHostTextureSlot& Slot = Scene.Scene.Materials.back().Slots[TEXTURE_EMISSIVE];
		Slot.Texture = 0;
		Slot.Transform = {0.5f * Squares, 0, 0, 0.5f * Squares}; // two squares a side in the texture
		FHostMaterial Silver;
		Silver.Roughness = 0.0f;
		const int32_t Mirror = Scene.AddMaterial(Silver);
		Scene.AddNode(Scene.AddMesh({{Mirror, {{-9, -9, -3}, {9, -9, -3}, {9, 9, -3}, {-9, 9, -3}}}}));
		// The scale is the object's: areas are those of the world.
		Scene.AddNode(
		    Scene.AddMesh({{Bright, {{10, -10, 1}, {-10, -10, 1}, {-10, 10, 1}, {10, 10, 1}}}}), glm::scale(glm::dmat4(1), glm::dvec3(4)));
		ASSERT_TRUE(Load(std::move(Scene.Scene)));
		SetSun(0.0, 0.0f);
		SetSky(glm::vec3(0));
	}
	static FView LookAtMirror() { return LookAt({0, 0, 0}, {0.3, 0.2, -3}, 0.7f, 96, 54); }
	FImage RenderMirror(const char* Cones, const char* Path)
	{
		SetVariable("r.RT.Rays.Cones", Cones);
		SetVariable("r.RT.Reflections.Path", Path);
		return RenderSignal(ESignal::Reflections, LookAtMirror(), 1, 6);
	}
	/// Standard deviation over the mean.
	static double GetSpread(const FImage& Image)
	{
		const double Mean = MeanGreen(Image);
		double Squares = 0.0;
		for (size_t I = 1; I < Image.Pixels.size(); I += Image.Channels) { Squares += std::pow(double(Image.Pixels[I]) - Mean, 2.0); }
		return std::sqrt(Squares / double(Image.GetPixelCount())) / Mean;
	}
};

// Many squares in a pixel: half of the light, in each.
TEST_F(FRayConeTest, WhatIsFinerThanAPixelIsAveraged)
{
	ASSERT_NO_FATAL_FAILURE(LoadBoard(4000.0f));
	const FImage With = RenderMirror("1", "1"), Without = RenderMirror("0", "1"), Query = RenderMirror("1", "2");
	PrintFigure(fmt::format("mean {:.3f}, spread {:.3f}; at the finest level {:.3f}, spread {:.3f}", MeanGreen(With), GetSpread(With),
	    MeanGreen(Without), GetSpread(Without)));
	EXPECT_NEAR(MeanGreen(With), 0.5, 0.02);
	EXPECT_LT(GetSpread(With), 0.1);
	EXPECT_GT(GetSpread(Without), 0.5) << "the test could not fail";
	EXPECT_EQ(FractionDiffering(With, Query, 1e-3), 0.0);
}

// Squares of some pixels stay as they are, but for their borders.
TEST_F(FRayConeTest, WhatIsCoarserStaysSharp)
{
	ASSERT_NO_FATAL_FAILURE(LoadBoard(40.0f));
	const FImage With = RenderMirror("1", "1"), Without = RenderMirror("0", "1");
	const double Others = FractionDiffering(With, Without, 0.1);
	PrintFigure(fmt::format(
	    "{:.1f} % of the pixels are others; spread {:.3f}, at the finest level {:.3f}", 100 * Others, GetSpread(With), GetSpread(Without)));
	EXPECT_LT(Others, 0.25);
	EXPECT_GT(GetSpread(With), 0.85 * GetSpread(Without));
}

} // namespace
} // namespace Lantern
