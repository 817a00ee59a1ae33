// The picture itself, carried over along its motion vectors.
#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "MotionFixture.h"
#include "Support/TestScene.h"

namespace Lantern
{

namespace
{

using FMotionPictureTest = FMotionTestBase;

/// Light of its own in a pattern that is smooth and different everywhere.
int32_t AddPattern(FTestScene& Scene)
{
	constexpr uint32_t Size = 128;
	FHostImage Image;
	Image.Name = "pattern";
	Image.Width = Image.Height = Size;
	for (uint32_t I = 0; I < Size * Size; ++I)
	{
		const double U = 2.0 * std::numbers::pi * (I % Size) / Size, V = 2.0 * std::numbers::pi * (I / Size) / Size;
		for (const double Value : {std::sin(2.0 * U), std::cos(3.0 * V), std::sin(U + 2.0 * V)})
		{
			Image.Rgba.push_back(static_cast<uint8_t>(127.5 + 110.0 * Value));
		}
		Image.Rgba.push_back(255);
	}
	FHostTexture Texture;
	Texture.Image = static_cast<int32_t>(Scene.Scene.Images.size());
	Texture.bRepeatU = Texture.bRepeatV = false;
	Scene.Scene.Images.push_back(std::move(Image));
	Scene.Scene.Textures.push_back(Texture);
	const int32_t Material = Scene.AddLambert(glm::vec3(0), glm::vec3(1), true);
	Scene.Scene.Materials.back().Slots[TEXTURE_EMISSIVE].Texture = static_cast<int32_t>(Scene.Scene.Textures.size()) - 1;
	return Material;
}

glm::vec3 SampleBilinear(const FImage& Image, glm::vec2 Pixel)
{
	const glm::vec2 At = Pixel - 0.5f, Low = glm::floor(At), F = At - Low;
	const auto Texel = [&](int X, int Y) {
		return glm::vec3(Image.At(static_cast<uint32_t>(X), static_cast<uint32_t>(Y), 0),
		    Image.At(static_cast<uint32_t>(X), static_cast<uint32_t>(Y), 1),
		    Image.At(static_cast<uint32_t>(X), static_cast<uint32_t>(Y), 2));
	};
	const int X = static_cast<int>(Low.x), Y = static_cast<int>(Low.y);
	return glm::mix(glm::mix(Texel(X, Y), Texel(X + 1, Y), F.x), glm::mix(Texel(X, Y + 1), Texel(X + 1, Y + 1), F.x), F.y);
}

/// Whether a filter at Pixel reaches nothing but the plane.
bool IsCovered(const FImage& Image, glm::vec2 Pixel)
{
	for (const glm::vec2 Corner : {glm::vec2(-2), glm::vec2(2, -2), glm::vec2(-2, 2), glm::vec2(2)})
	{
		const glm::vec2 P = Pixel + Corner;
		const bool bInside = P.x >= 0 && P.y >= 0 && P.x < float(Image.Width) && P.y < float(Image.Height);
		if (!bInside || !(Image.At(uint32_t(P.x), uint32_t(P.y), 0) + Image.At(uint32_t(P.x), uint32_t(P.y), 1) > 0)) { return false; }
	}
	return true;
}

// The picture itself, carried over: a plane with a pattern moves, turns and grows before a moving camera.
TEST_F(FMotionPictureTest, PicturesAreCarriedOver)
{
	FTestScene Plane("plane");
	const int32_t Mesh = Plane.AddMesh({{AddPattern(Plane), {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}}});
	Plane.AddNode(Mesh);
	ASSERT_TRUE(Load(std::move(Plane.Scene)));
	const auto Draw = [&](double Time, std::vector<glm::vec4>& Motion) {
		const FView View = MakeCamera({0.1 * Time, 0.05 * Time, 2.6}, {0.02 * Time, 0, 0});
		const glm::dmat4 Turned =
		    glm::rotate(glm::translate(glm::dmat4(1), {0.09 * Time, -0.04 * Time, 0.1 * Time}), 0.06 * Time, {0.3, 0.5, 0.8});
		GetScene().SetTransform(0, glm::scale(Turned, glm::dvec3(1.0 + 0.05 * Time)));
		TRTRef<IRTBuffer> Buffer;
		GetEngine().ExtraPasses = [&](FFrameContext& Context, const FGBuffer& GBuffer, const FFrameOutputs&) {
			Read(Context, GBuffer.Motion, Buffer);
		};
		FImage Picture = RenderLighting(View);
		Motion = Take<glm::vec4>(Buffer.Get(), View);
		return Picture;
	};
	std::vector<glm::vec4> Motion;
	(void)Draw(-1.0, Motion); // the engine's first frame puts the plane where its node says
	const FImage Before = Draw(0.0, Motion), Now = Draw(1.0, Motion);
	double Squares = 0.0, SquaresStill = 0.0, Worst = 0.0;
	size_t Seen = 0;
	for (uint32_t Y = 0; Y < Height; ++Y)
	{
		for (uint32_t X = 0; X < Width; ++X)
		{
			const glm::vec4& M = Motion[Y * Width + X];
			const glm::vec2 Here = glm::vec2(X, Y) + 0.5f, There = Here + glm::vec2(M);
			if (M.w == 0.0f || !IsCovered(Now, Here) || !IsCovered(Before, There)) { continue; }
			++Seen;
			const glm::vec3 Color = SampleBilinear(Now, Here);
			const float Error = glm::length(SampleBilinear(Before, There) - Color),
			            Still = glm::length(SampleBilinear(Before, Here) - Color);
			Squares += Error * Error;
			SquaresStill += Still * Still;
			Worst = std::max(Worst, double(Error));
		}
	}
	const double Rms = std::sqrt(Squares / double(Seen)), RmsStill = std::sqrt(SquaresStill / double(Seen));
	PrintFigure(
	    fmt::format("picture carried over: {} pixels, rms {:.5f} (without motion {:.4f}), worst {:.4f}", Seen, Rms, RmsStill, Worst));
	EXPECT_GT(Seen, Width * Height / 10);
	EXPECT_GT(RmsStill, 0.1) << "it must move to be carried over";
	EXPECT_LT(Rms, 0.02 * RmsStill);
}

} // namespace
} // namespace Lantern
