// The alpha test evaluated as the shader does it, in fp32, with a sampler of the test's own.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "LanternScene/Opacity/OpacityClassifier.h"

namespace Lantern::Test
{

struct FTestAlpha
{
	uint32_t Width = 1, Height = 1;
	std::vector<uint8_t> Alpha;
	FAlphaTexels GetTexels() const { return {Alpha.data(), Width, Height, 1}; }
	uint8_t At(uint32_t X, uint32_t Y) const { return Alpha[size_t(Y) * Width + X]; }
};

inline FVertexAttributes MakeVertex(glm::vec2 UV, uint32_t Alpha = 255)
{
	FVertexAttributes Vertex{};
	Vertex.UV0 = UV;
	Vertex.UV1 = glm::vec2(1000.0f); // whoever reads the wrong set sees it
	Vertex.Color = (Alpha << 24) | 0x00ffffffu;
	return Vertex;
}

/// Vulkan 1.3, "Wrapping Operation", of a texel index.
inline uint32_t WrapTexel(int64_t Index, int64_t Size, ERTAddress Address)
{
	if (Address == ERTAddress::Clamp) { return static_cast<uint32_t>(std::clamp<int64_t>(Index, 0, Size - 1)); }
	if (Address == ERTAddress::Repeat) { return static_cast<uint32_t>((Index % Size + Size) % Size); }
	const int64_t Period = (Index % (2 * Size) + 2 * Size) % (2 * Size) - Size;
	return static_cast<uint32_t>(Size - 1 - (Period >= 0 ? Period : -(1 + Period)));
}

/// Sub-texel steps: 0 for exact weights; GPUs round coordinates to 1/256 of a texel.
inline float SampleAlpha(const FTestAlpha& Texture, const FAlphaTest& Test, glm::vec2 UV, double Steps)
{
	const auto Round = [&](double X) { return Steps > 0.0 ? std::floor(X * Steps + 0.5) / Steps : X; };
	const double X = Round(double(UV.x) * Texture.Width), Y = Round(double(UV.y) * Texture.Height);
	const auto Texel = [&](double U, double V) {
		return Texture.At(WrapTexel(static_cast<int64_t>(std::floor(U)), Texture.Width, Test.AddressU),
		           WrapTexel(static_cast<int64_t>(std::floor(V)), Texture.Height, Test.AddressV)) /
		       255.0;
	};
	if (!Test.bLinear) { return static_cast<float>(Texel(X, Y)); }
	const double X0 = std::floor(X - 0.5), Y0 = std::floor(Y - 0.5), A = X - 0.5 - X0, B = Y - 0.5 - Y0;
	const double Top = (1 - A) * Texel(X0, Y0) + A * Texel(X0 + 1, Y0);
	const double Bottom = (1 - A) * Texel(X0, Y0 + 1) + A * Texel(X0 + 1, Y0 + 1);
	return static_cast<float>((1 - B) * Top + B * Bottom);
}

/// IsHitCutAway of Shaders/Materials/Standard.glsl.
inline bool IsCutAway(
    const FTestAlpha* Texture, const FAlphaTest& Test, const FVertexAttributes (&V)[3], glm::vec2 Barycentrics, double Steps)
{
	const float W[3] = {1.0f - Barycentrics.x - Barycentrics.y, Barycentrics.x, Barycentrics.y};
	glm::vec2 UV(0.0f);
	float VertexAlpha = 0.0f;
	for (int I = 0; I < 3; ++I)
	{
		UV += W[I] * (Test.bUV1 ? V[I].UV1 : V[I].UV0);
		VertexAlpha += W[I] * static_cast<float>(V[I].Color >> 24u);
	}
	const glm::vec4& T = Test.UVTransform;
	UV = glm::vec2(T.x * UV.x + T.y * UV.y, T.z * UV.x + T.w * UV.y) + Test.UVOffset;
	float Opacity = Test.BaseAlpha * (VertexAlpha * (1.0f / 255.0f));
	if (Texture) { Opacity *= SampleAlpha(*Texture, Test, UV, Steps); }
	return Opacity < Test.Cutoff;
}

/// Islands of full and no alpha with soft and hard borders, so that all classes occur.
inline FTestAlpha MakeRandomAlpha(std::mt19937& Random)
{
	FTestAlpha Texture;
	Texture.Width = 1 + Random() % 65;
	Texture.Height = 1 + Random() % 65;
	Texture.Alpha.resize(size_t(Texture.Width) * Texture.Height, Random() % 2 ? 255 : 0);
	for (uint32_t Island = Random() % 6; Island > 0; --Island)
	{
		const uint32_t X0 = Random() % Texture.Width, Y0 = Random() % Texture.Height;
		const uint32_t X1 = std::min<uint32_t>(Texture.Width, X0 + 1 + Random() % Texture.Width);
		const uint32_t Y1 = std::min<uint32_t>(Texture.Height, Y0 + 1 + Random() % Texture.Height);
		const uint8_t Value = Random() % 3 ? (Random() % 2 ? 255 : 0) : static_cast<uint8_t>(Random());
		for (uint32_t Y = Y0; Y < Y1; ++Y)
		{
			std::fill(Texture.Alpha.begin() + Y * Texture.Width + X0, Texture.Alpha.begin() + Y * Texture.Width + X1, Value);
		}
	}
	return Texture;
}

} // namespace Lantern::Test
