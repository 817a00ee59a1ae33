// Classified triangles against the alpha test evaluated point by point.
#include <limits>
#include <set>

#include <gtest/gtest.h>

#include "OpacityTestTools.h"

namespace Lantern
{

using namespace Test;

namespace
{
constexpr uint32_t Cases = 4000;
constexpr uint32_t Samples = 600;

float Uniform(std::mt19937& Random, float Low, float High) { return std::uniform_real_distribution<float>(Low, High)(Random); }

FAlphaTest MakeRandomTest(std::mt19937& Random, const FAlphaPyramid& Pyramid)
{
	const ERTAddress Addresses[] = {ERTAddress::Repeat, ERTAddress::Clamp, ERTAddress::Mirror};
	const float Cutoffs[] = {-1.0f, 0.0f, 0.002f, 0.25f, 0.5f, 0.5f, 128.0f / 255.0f, 0.9f, 1.0f, 2.0f};
	FAlphaTest Alpha;
	Alpha.Texture = &Pyramid;
	Alpha.bTextured = true;
	Alpha.AddressU = Addresses[Random() % 3];
	Alpha.AddressV = Addresses[Random() % 3];
	Alpha.bLinear = Random() % 2;
	Alpha.bUV1 = Random() % 4 == 0;
	Alpha.BaseAlpha = Random() % 3 ? 1.0f : Uniform(Random, 0.0f, 2.0f);
	Alpha.Cutoff = Cutoffs[Random() % std::size(Cutoffs)];
	if (Random() % 2)
	{
		const float Angle = Uniform(Random, 0.0f, 6.3f), Scale = Uniform(Random, 0.1f, 3.0f);
		Alpha.UVTransform = Scale * glm::vec4(std::cos(Angle), std::sin(Angle), -std::sin(Angle), std::cos(Angle));
		Alpha.UVOffset = {Uniform(Random, -2.0f, 2.0f), Uniform(Random, -2.0f, 2.0f)};
	}
	return Alpha;
}

void MakeRandomTriangle(std::mt19937& Random, FVertexAttributes (&Out)[3])
{
	const float Sizes[] = {0.001f, 0.05f, 0.3f, 1.0f, 4.0f, 40.0f};
	const float Size = Sizes[Random() % std::size(Sizes)];
	const glm::vec2 Center(Uniform(Random, -2.0f, 3.0f), Uniform(Random, -2.0f, 3.0f));
	const uint32_t Kind = Random() % 8; // 0: a point; 1: a line
	for (FVertexAttributes& Vertex : Out)
	{
		glm::vec2 Away(Uniform(Random, -Size, Size), Uniform(Random, -Size, Size));
		Away = Kind == 0 ? glm::vec2(0) : Kind == 1 ? glm::vec2(Away.x, 0.5f * Away.x) : Away;
		Vertex = MakeVertex(Center + Away, Random() % 3 ? 255 : Random() % 256);
		Vertex.UV1 = Vertex.UV0 + 0.37f;
	}
}

glm::vec2 MakeBarycentrics(std::mt19937& Random, uint32_t Sample)
{
	const glm::vec2 Corners[] = {{0, 0}, {1, 0}, {0, 1}};
	if (Sample < 3) { return Corners[Sample]; }
	float U = Uniform(Random, 0.0f, 1.0f), V = Uniform(Random, 0.0f, 1.0f);
	if (U + V > 1.0f)
	{
		U = 1.0f - U;
		V = 1.0f - V;
	}
	// Borders are where mistakes are.
	switch (Sample % 5)
	{
	case 0: return {0.0f, V};
	case 1: return {U, 0.0f};
	case 2: return {U, 1.0f - U};
	default: return {U, V};
	}
}

EOpacity Classify(const FAlphaTest& Alpha, const FVertexAttributes (&V)[3]) { return ClassifyTriangle(Alpha, V[0], V[1], V[2]); }

/// Left half opaque, right half clear, 64 × 64.
FTestAlpha MakeHalves()
{
	FTestAlpha Texture{64, 64, std::vector<uint8_t>(64 * 64)};
	for (uint32_t I = 0; I < Texture.Alpha.size(); ++I) { Texture.Alpha[I] = I % 64 < 32 ? 255 : 0; }
	return Texture;
}

EOpacity ClassifyIn(const FAlphaTest& Alpha, glm::vec2 A, glm::vec2 B, glm::vec2 C, uint32_t VertexAlpha = 255)
{
	return ClassifyTriangle(Alpha, MakeVertex(A, VertexAlpha), MakeVertex(B, VertexAlpha), MakeVertex(C, VertexAlpha));
}

FAlphaTest MakeTest(const FAlphaPyramid& Pyramid)
{
	FAlphaTest Alpha;
	Alpha.Texture = &Pyramid;
	Alpha.bTextured = true;
	return Alpha;
}
} // namespace

TEST(FOpacityClassifierTest, NoSampledPointContradictsAClass)
{
	std::mt19937 Random(20);
	uint32_t Opaque = 0, Transparent = 0;
	for (uint32_t Case = 0; Case < Cases; ++Case)
	{
		const FTestAlpha Texture = MakeRandomAlpha(Random);
		const FAlphaPyramid Pyramid(Texture.GetTexels());
		const FAlphaTest Alpha = MakeRandomTest(Random, Pyramid);
		FVertexAttributes V[3];
		MakeRandomTriangle(Random, V);
		const EOpacity Class = Classify(Alpha, V);
		Opaque += Class == EOpacity::Opaque;
		Transparent += Class == EOpacity::Transparent;
		for (uint32_t Sample = 0; Sample < Samples && Class != EOpacity::Mixed; ++Sample)
		{
			const glm::vec2 Barycentrics = MakeBarycentrics(Random, Sample);
			for (const double Steps : {0.0, 256.0})
			{
				ASSERT_EQ(IsCutAway(&Texture, Alpha, V, Barycentrics, Steps), Class == EOpacity::Transparent)
				    << "case " << Case << " at " << Barycentrics.x << ", " << Barycentrics.y;
			}
		}
	}
	// The random scenes must not be such that everything is mixed.
	EXPECT_GT(Opaque, Cases / 10);
	EXPECT_GT(Transparent, Cases / 10);
}

TEST(FOpacityClassifierTest, MixedIsSaidOnlyWhereItIsNearlySo)
{
	// Without vertex alpha and soft texels, mixed must mean that points a texel around the triangle differ.
	std::mt19937 Random(21);
	uint32_t Mixed = 0, Unfounded = 0;
	for (uint32_t Case = 0; Case < 1500; ++Case)
	{
		FTestAlpha Texture = MakeRandomAlpha(Random);
		for (uint8_t& Alpha : Texture.Alpha) { Alpha = Alpha < 128 ? 0 : 255; }
		const FAlphaPyramid Pyramid(Texture.GetTexels());
		FAlphaTest Alpha = MakeRandomTest(Random, Pyramid);
		Alpha.Cutoff = 0.5f;
		Alpha.BaseAlpha = 1.0f;
		Alpha.bLinear = false;
		FVertexAttributes V[3];
		MakeRandomTriangle(Random, V);
		for (FVertexAttributes& Vertex : V) { Vertex.Color = ~0u; }
		if (Classify(Alpha, V) != EOpacity::Mixed) { continue; }
		++Mixed;
		bool bCut = false, bKept = false;
		for (uint32_t Sample = 0; Sample < 4000 && !(bCut && bKept); ++Sample)
		{
			FVertexAttributes Moved[3] = {V[0], V[1], V[2]};
			FAlphaTest Beside = Alpha;
			Beside.UVOffset += glm::vec2(Uniform(Random, -0.1f, 0.1f) / Texture.Width, Uniform(Random, -0.1f, 0.1f) / Texture.Height);
			(IsCutAway(&Texture, Beside, Moved, MakeBarycentrics(Random, Sample), 0.0) ? bCut : bKept) = true;
		}
		Unfounded += !(bCut && bKept);
	}
	EXPECT_GT(Mixed, 300u);
	// Slivers that sampling misses, and triangles over many repetitions.
	EXPECT_LE(Unfounded, Mixed / 25) << "of " << Mixed;
}

TEST(FOpacityClassifierTest, FootprintIsTheTriangleNotItsBox)
{
	const FTestAlpha Texture = MakeHalves();
	const FAlphaPyramid Pyramid(Texture.GetTexels());
	FAlphaTest Alpha = MakeTest(Pyramid);
	EXPECT_EQ(ClassifyIn(Alpha, {0.05f, 0.1f}, {0.4f, 0.1f}, {0.05f, 0.9f}), EOpacity::Opaque);
	EXPECT_EQ(ClassifyIn(Alpha, {0.55f, 0.1f}, {0.9f, 0.1f}, {0.55f, 0.9f}), EOpacity::Transparent);
	EXPECT_EQ(ClassifyIn(Alpha, {0.1f, 0.1f}, {0.9f, 0.1f}, {0.1f, 0.9f}), EOpacity::Mixed);
	// A triangle below the diagonal of a texture whose other half is clear.
	FTestAlpha Diagonal{64, 64, std::vector<uint8_t>(64 * 64)};
	for (uint32_t I = 0; I < 64 * 64; ++I) { Diagonal.Alpha[I] = I % 64 + I / 64 < 64 ? 255 : 0; }
	const FAlphaPyramid DiagonalPyramid(Diagonal.GetTexels());
	Alpha.Texture = &DiagonalPyramid;
	Alpha.AddressU = Alpha.AddressV = ERTAddress::Clamp;
	EXPECT_EQ(ClassifyIn(Alpha, {0.0f, 0.0f}, {0.95f, 0.0f}, {0.0f, 0.95f}), EOpacity::Opaque);
	EXPECT_EQ(ClassifyIn(Alpha, {1.0f, 1.0f}, {0.1f, 1.0f}, {1.0f, 0.1f}), EOpacity::Transparent);
	// Repeating, the filter reaches across the texture's border.
	Alpha.AddressU = Alpha.AddressV = ERTAddress::Repeat;
	EXPECT_EQ(ClassifyIn(Alpha, {0.0f, 0.0f}, {0.95f, 0.0f}, {0.0f, 0.95f}), EOpacity::Mixed);
}

TEST(FOpacityClassifierTest, FilterReachesHalfATexelFurther)
{
	const FTestAlpha Texture = MakeHalves();
	const FAlphaPyramid Pyramid(Texture.GetTexels());
	FAlphaTest Alpha = MakeTest(Pyramid);
	const float Edge = 31.8f / 64.0f; // in the last opaque column, beyond its centre
	EXPECT_EQ(ClassifyIn(Alpha, {0.1f, 0.1f}, {Edge, 0.2f}, {0.1f, 0.3f}), EOpacity::Mixed);
	Alpha.bLinear = false;
	EXPECT_EQ(ClassifyIn(Alpha, {0.1f, 0.1f}, {Edge, 0.2f}, {0.1f, 0.3f}), EOpacity::Opaque);
}

TEST(FOpacityClassifierTest, AddressModesDecideWhatLiesOutside)
{
	const FTestAlpha Texture = MakeHalves();
	const FAlphaPyramid Pyramid(Texture.GetTexels());
	FAlphaTest Alpha = MakeTest(Pyramid);
	const auto At = [&](ERTAddress Address, float U) {
		Alpha.AddressU = Address;
		return ClassifyIn(Alpha, {U, 0.3f}, {U + 0.1f, 0.3f}, {U, 0.4f});
	};
	EXPECT_EQ(At(ERTAddress::Repeat, 5.2f), EOpacity::Opaque);
	EXPECT_EQ(At(ERTAddress::Mirror, 5.2f), EOpacity::Transparent);
	EXPECT_EQ(At(ERTAddress::Clamp, 5.2f), EOpacity::Transparent);
	EXPECT_EQ(At(ERTAddress::Repeat, -2.3f), EOpacity::Transparent);
	EXPECT_EQ(At(ERTAddress::Mirror, -2.3f), EOpacity::Opaque);
	EXPECT_EQ(At(ERTAddress::Clamp, -2.3f), EOpacity::Opaque);
}

TEST(FOpacityClassifierTest, VertexAlphaAndBaseAlphaScaleTheTexture)
{
	FTestAlpha Texture{4, 4, std::vector<uint8_t>(16, 200)};
	const FAlphaPyramid Pyramid(Texture.GetTexels());
	FAlphaTest Alpha = MakeTest(Pyramid);
	EXPECT_EQ(ClassifyIn(Alpha, {0, 0}, {1, 0}, {0, 1}), EOpacity::Opaque);
	EXPECT_EQ(ClassifyIn(Alpha, {0, 0}, {1, 0}, {0, 1}, 100), EOpacity::Transparent);
	EXPECT_EQ(ClassifyTriangle(Alpha, MakeVertex({0, 0}, 100), MakeVertex({1, 0}), MakeVertex({0, 1})), EOpacity::Mixed);
	Alpha.BaseAlpha = 0.6f;
	EXPECT_EQ(ClassifyIn(Alpha, {0, 0}, {1, 0}, {0, 1}), EOpacity::Transparent);
	Alpha.BaseAlpha = -1.0f;
	EXPECT_EQ(ClassifyIn(Alpha, {0, 0}, {1, 0}, {0, 1}), EOpacity::Mixed);
	Alpha.bTextured = false;
	Alpha.Texture = nullptr;
	Alpha.BaseAlpha = 0.6f;
	EXPECT_EQ(ClassifyIn(Alpha, {0, 0}, {1, 0}, {0, 1}), EOpacity::Opaque);
	EXPECT_EQ(ClassifyIn(Alpha, {0, 0}, {1, 0}, {0, 1}, 128), EOpacity::Transparent);
}

TEST(FOpacityClassifierTest, WhatCannotBeToldIsMixed)
{
	const FTestAlpha Texture = MakeHalves();
	const FAlphaPyramid Pyramid(Texture.GetTexels());
	FAlphaTest Alpha = MakeTest(Pyramid);
	const float Infinity = std::numeric_limits<float>::infinity(), NaN = std::numeric_limits<float>::quiet_NaN();
	const float Largest = std::numeric_limits<float>::max();
	for (const float Bad : {Infinity, -Infinity, NaN, Largest, 1.0e12f, 5.0e8f})
	{
		for (const ERTAddress Address : {ERTAddress::Repeat, ERTAddress::Mirror})
		{
			Alpha.AddressU = Alpha.AddressV = Address;
			EXPECT_EQ(ClassifyIn(Alpha, {0.1f, 0.1f}, {Bad, 0.1f}, {0.1f, 0.2f}), EOpacity::Mixed) << Bad;
			EXPECT_EQ(ClassifyIn(Alpha, {Bad, 0.1f}, {Bad, 0.1f}, {Bad, 0.2f}), EOpacity::Mixed) << Bad;
		}
	}
	Alpha.BaseAlpha = NaN;
	EXPECT_EQ(ClassifyIn(Alpha, {0.1f, 0.1f}, {0.2f, 0.1f}, {0.1f, 0.2f}), EOpacity::Mixed);
	Alpha.BaseAlpha = 1.0f;
	Alpha.Cutoff = NaN;
	EXPECT_EQ(ClassifyIn(Alpha, {0.1f, 0.1f}, {0.2f, 0.1f}, {0.1f, 0.2f}), EOpacity::Mixed);
	Alpha = MakeTest(Pyramid);
	Alpha.Texture = nullptr; // it has one, but its texels are not at hand
	EXPECT_EQ(ClassifyIn(Alpha, {0.1f, 0.1f}, {0.2f, 0.1f}, {0.1f, 0.2f}), EOpacity::Mixed);
}

TEST(FOpacityClassifierTest, ReorderingKeepsEveryTriangle)
{
	std::mt19937 Random(22);
	for (uint32_t Round = 0; Round < 50; ++Round)
	{
		std::vector<uint32_t> Indices(3 * (Random() % 300));
		std::vector<EOpacity> Classes(Indices.size() / 3);
		std::multiset<std::array<uint32_t, 3>> Before[3], After[3];
		for (size_t T = 0; T < Classes.size(); ++T)
		{
			Classes[T] = static_cast<EOpacity>(Random() % 3);
			for (size_t I = 0; I < 3; ++I) { Indices[3 * T + I] = Random() % 100; }
			Before[static_cast<int>(Classes[T])].insert({Indices[3 * T], Indices[3 * T + 1], Indices[3 * T + 2]});
		}
		std::vector<uint16_t> Short(Indices.begin(), Indices.end());
		const FOpacityCounts Counts = ReorderByOpacity(std::span<uint32_t>(Indices), Classes);
		for (size_t T = 0; T < Classes.size(); ++T)
		{
			const int Class = T < Counts.Mixed                   ? int(EOpacity::Mixed)
			                  : T < Counts.Mixed + Counts.Opaque ? int(EOpacity::Opaque)
			                                                     : int(EOpacity::Transparent);
			After[Class].insert({Indices[3 * T], Indices[3 * T + 1], Indices[3 * T + 2]});
		}
		for (int Class = 0; Class < 3; ++Class) { EXPECT_EQ(Before[Class], After[Class]); }
		ReorderByOpacity(std::span<uint16_t>(Short), Classes);
		EXPECT_TRUE(std::equal(Short.begin(), Short.end(), Indices.begin(), Indices.end()));
	}
}

TEST(FOpacityClassifierTest, SectionIsOrderedAndItsNeighboursAreLeftAlone)
{
	const FTestAlpha Texture = MakeHalves();
	const FAlphaPyramid Pyramid(Texture.GetTexels());
	const FAlphaTest Alpha = MakeTest(Pyramid);
	std::vector<FVertexAttributes> Vertices;
	const auto Add = [&](float U, float Size) {
		for (const glm::vec2 Corner : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(0, 1)})
		{
			Vertices.push_back(MakeVertex(glm::vec2(U, 0.2f) + Size * Corner));
		}
	};
	for (const float U : {0.7f, 0.2f, 0.45f, 0.8f, 0.1f}) { Add(U, 0.1f); }
	std::vector<uint32_t> Indices(Vertices.size());
	for (uint32_t I = 0; I < Indices.size(); ++I) { Indices[I] = I; }
	FRTSectionInfo Section;
	Section.FirstIndex = 3; // the first triangle is another section's
	Section.IndexCount = 12;
	Section.bOpaque = false;
	const FOpacityCounts Counts = ClassifySection(Alpha, 77, Vertices.data(), Indices.data(), Section);
	EXPECT_EQ(Counts.Mixed, 1u);
	EXPECT_EQ(Section.OpaqueIndexCount, 6u);
	EXPECT_EQ(Section.TransparentIndexCount, 3u);
	EXPECT_EQ(Section.OpacityKey, 77u);
	EXPECT_EQ(Indices, (std::vector<uint32_t>{0, 1, 2, 6, 7, 8, 3, 4, 5, 12, 13, 14, 9, 10, 11}));
}

TEST(FOpacityClassifierTest, KeyFollowsWhatTheAlphaTestReads)
{
	FMaterialData Material{};
	Material.Flags = MATERIAL_MASKED;
	Material.Textures[TEXTURE_BASE_COLOR] = 5;
	const uint64_t Key = MakeOpacityKey(Material);
	EXPECT_NE(Key, 0u);
	const auto Differs = [&](auto Change) {
		FMaterialData Other = Material;
		Change(Other);
		return MakeOpacityKey(Other) != Key;
	};
	EXPECT_TRUE(Differs([](FMaterialData& M) { M.Flags = 0; }));
	EXPECT_TRUE(Differs([](FMaterialData& M) { M.AlphaCutoff = 0.4f; }));
	EXPECT_TRUE(Differs([](FMaterialData& M) { M.BaseColor.a = 0.9f; }));
	EXPECT_TRUE(Differs([](FMaterialData& M) { M.Textures[TEXTURE_BASE_COLOR] = 6; }));
	EXPECT_TRUE(Differs([](FMaterialData& M) { M.UVTransform[TEXTURE_BASE_COLOR].y = 1; }));
	EXPECT_TRUE(Differs([](FMaterialData& M) { M.UVOffset[TEXTURE_BASE_COLOR].x = 1; }));
	EXPECT_TRUE(Differs([](FMaterialData& M) { M.UVSets = 1u << TEXTURE_BASE_COLOR; }));
	EXPECT_FALSE(Differs([](FMaterialData& M) { M.BaseColor.r = 0.5f; }));
	EXPECT_FALSE(Differs([](FMaterialData& M) { M.Roughness = 0.5f; }));
	EXPECT_FALSE(Differs([](FMaterialData& M) { M.Flags |= MATERIAL_DOUBLE_SIDED; }));
	EXPECT_NE(MakeOpacityKey(Material, 1), Key);
}

} // namespace Lantern
