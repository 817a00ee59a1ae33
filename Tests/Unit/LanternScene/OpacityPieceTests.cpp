// Pieces of mixed triangles: what they leave out is cut away by the alpha test, at every point.
#include <gtest/gtest.h>

#include "LanternScene/Opacity/OpacityPieces.h"
#include "OpacityTestTools.h"

namespace Lantern
{

using namespace Test;

namespace
{
bool IsInside(const glm::vec2* Corners, glm::vec2 Point)
{
	const auto Side = [&](int I) {
		const glm::dvec2 A(Corners[I]), B(Corners[(I + 1) % 3]);
		return (B.x - A.x) * (Point.y - A.y) - (B.y - A.y) * (Point.x - A.x);
	};
	return Side(0) >= 0.0 && Side(1) >= 0.0 && Side(2) >= 0.0;
}

double GetTwiceArea(const glm::vec2* C)
{
	const glm::dvec2 E1 = C[1] - C[0], E2 = C[2] - C[0];
	return E1.x * E2.y - E1.y * E2.x;
}

bool IsCovered(const FOpacityPieces& Pieces, glm::vec2 Point)
{
	for (size_t I = 0; I < Pieces.Corners.size(); I += 3)
	{
		if (IsInside(&Pieces.Corners[I], Point)) { return true; }
	}
	return false;
}

glm::vec2 MakePoint(std::mt19937& Random)
{
	std::uniform_real_distribution<float> Unit(0.0f, 1.0f);
	const float U = Unit(Random), V = Unit(Random);
	return U + V > 1.0f ? glm::vec2(1.0f - U, 1.0f - V) : glm::vec2(U, V);
}

/// A leaf: opaque within a circle that fills half of the card, 128 × 128.
FTestAlpha MakeLeaf()
{
	FTestAlpha Texture{128, 128, std::vector<uint8_t>(128 * 128)};
	for (int I = 0; I < 128 * 128; ++I)
	{
		const double X = I % 128 - 63.5, Y = I / 128 - 63.5;
		Texture.Alpha[I] = X * X + Y * Y < 50.0 * 50.0 ? 255 : 0;
	}
	return Texture;
}

struct FCard
{
	std::vector<FVertexAttributes> Vertices = {MakeVertex({0, 0}), MakeVertex({1, 0}), MakeVertex({1, 1}), MakeVertex({0, 1})};
	std::vector<glm::vec3> Positions = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
	std::vector<uint32_t> Indices = {0, 1, 2, 0, 2, 3};
};

FAlphaTest MakeLeafTest(const FAlphaPyramid& Pyramid)
{
	FAlphaTest Alpha;
	Alpha.Texture = &Pyramid;
	Alpha.bTextured = true;
	Alpha.AddressU = Alpha.AddressV = ERTAddress::Clamp;
	return Alpha;
}
} // namespace

TEST(FOpacityPieceTest, WhatIsLeftOutIsCutAway)
{
	std::mt19937 Random(30);
	std::uniform_real_distribution<float> Place(-1.0f, 2.0f);
	const ERTAddress Addresses[] = {ERTAddress::Repeat, ERTAddress::Clamp, ERTAddress::Mirror};
	uint32_t Ways = 0, LeftOut = 0;
	for (uint32_t Case = 0; Case < 800; ++Case)
	{
		const FTestAlpha Texture = MakeRandomAlpha(Random);
		const FAlphaPyramid Pyramid(Texture.GetTexels());
		FAlphaTest Alpha = MakeLeafTest(Pyramid);
		Alpha.AddressU = Addresses[Random() % 3];
		Alpha.AddressV = Addresses[Random() % 3];
		Alpha.bLinear = Random() % 2;
		Alpha.UVTransform = Random() % 2 ? glm::vec4(1, 0, 0, 1) : glm::vec4(0.6f, -0.8f, 0.8f, 0.6f);
		FVertexAttributes V[3];
		for (FVertexAttributes& Vertex : V) { Vertex = MakeVertex({Place(Random), Place(Random)}, Random() % 4 ? 255 : 160); }
		for (const FOpacityPieces& Way : MakeOpacityPieces(Alpha, V[0], V[1], V[2], Random() % 2 ? 32 : 64))
		{
			++Ways;
			for (uint32_t Sample = 0; Sample < 400; ++Sample)
			{
				const glm::vec2 Point = MakePoint(Random);
				if (!IsCovered(Way, Point))
				{
					++LeftOut;
					ASSERT_TRUE(IsCutAway(&Texture, Alpha, V, Point, Sample % 2 ? 256.0 : 0.0))
					    << "case " << Case << " at " << Point.x << ", " << Point.y;
				}
			}
		}
	}
	EXPECT_GT(Ways, 500u);
	EXPECT_GT(LeftOut, 10000u);
}

TEST(FOpacityPieceTest, WaysAreOrderedAndStateTheirArea)
{
	const FTestAlpha Leaf = MakeLeaf();
	const FAlphaPyramid Pyramid(Leaf.GetTexels());
	const FAlphaTest Alpha = MakeLeafTest(Pyramid);
	const FCard Card;
	const std::vector<FOpacityPieces> Ways = MakeOpacityPieces(Alpha, Card.Vertices[0], Card.Vertices[1], Card.Vertices[2]);
	ASSERT_GE(Ways.size(), 2u);
	float Share = 1.0f;
	for (const FOpacityPieces& Way : Ways)
	{
		EXPECT_LT(Way.Share, Share);
		Share = Way.Share;
		double Area = 0.0;
		for (size_t I = 0; I < Way.Corners.size(); I += 3)
		{
			EXPECT_GT(GetTwiceArea(&Way.Corners[I]), 0.0) << "winding";
			Area += GetTwiceArea(&Way.Corners[I]);
		}
		EXPECT_NEAR(Area, Way.Share, 0.02) << "but for overlaps";
		for (const glm::vec2 Corner : Way.Corners) { EXPECT_GT(std::min({Corner.x, Corner.y, 1.0f - Corner.x - Corner.y}), -2e-3f); }
	}
	// The circle covers 0.479 of the square; its half, of the triangle.
	EXPECT_GT(Share, 0.479f);
	EXPECT_LT(Share, 0.56f);
	EXPECT_LT(Ways.front().GetCount(), 8u);
}

TEST(FOpacityPieceTest, NothingToldMakesNoPieces)
{
	const FTestAlpha Leaf = MakeLeaf();
	const FAlphaPyramid Pyramid(Leaf.GetTexels());
	FAlphaTest Alpha = MakeLeafTest(Pyramid);
	const FVertexAttributes A = MakeVertex({0, 0}), B = MakeVertex({1, 0}), C = MakeVertex({0, 1});
	EXPECT_TRUE(MakeOpacityPieces(Alpha, A, B, B).empty()) << "no area in texels";
	EXPECT_TRUE(MakeOpacityPieces(Alpha, A, B, MakeVertex({NAN, 1})).empty());
	EXPECT_TRUE(MakeOpacityPieces(Alpha, A, B, MakeVertex({1e30f, 1e30f})).empty());
	Alpha.Cutoff = 0.0f;
	EXPECT_TRUE(MakeOpacityPieces(Alpha, A, B, C).empty()) << "all of it passes";
	Alpha.Texture = nullptr;
	EXPECT_TRUE(MakeOpacityPieces(Alpha, A, B, C).empty());
}

TEST(FOpacityPieceTest, PiecesGoWhereTheySaveMost)
{
	const FTestAlpha Leaf = MakeLeaf();
	const FAlphaPyramid Pyramid(Leaf.GetTexels());
	const FAlphaTest Alpha = MakeLeafTest(Pyramid);
	FCard Large, Small;
	for (glm::vec3& P : Small.Positions) { P *= 0.1f; }
	const auto MakeSource = [&](const FCard& Card, float Weight) {
		return FPieceSource{&Alpha, Card.Vertices.data(), Card.Positions.data(), Card.Indices, Weight};
	};
	const FPieceSource Sources[] = {MakeSource(Small, 1.0f), MakeSource(Large, 1.0f)};
	const std::vector<FOpacityPieceList> Few = CutOpacityPieces(Sources, 10);
	EXPECT_EQ(Few[0].GetCount(), 0u) << "a section without any cut is left as it is";
	EXPECT_GT(Few[1].GetCount(), 2u);
	EXPECT_LE(Few[1].GetCount(), 12u);
	// A thousand objects of the small one are worth more than one large one.
	const FPieceSource Weighted[] = {MakeSource(Small, 1000.0f), MakeSource(Large, 1.0f)};
	const std::vector<FOpacityPieceList> Other = CutOpacityPieces(Weighted, 10);
	EXPECT_GT(Other[0].GetCount(), Other[1].GetCount());
	EXPECT_EQ(CutOpacityPieces(Sources, 0)[1].GetCount(), 0u);
	const std::vector<FOpacityPieceList> Most = CutOpacityPieces(Sources, 1000000);
	EXPECT_GT(Most[0].GetCount(), 12u);
	EXPECT_LE(Most[0].GetCount() + Most[1].GetCount(), 4u * 64u) << "what saves nothing is not made";
}

TEST(FOpacityPieceTest, PiecesLieInTheirTriangles)
{
	const FTestAlpha Leaf = MakeLeaf();
	const FAlphaPyramid Pyramid(Leaf.GetTexels());
	const FAlphaTest Alpha = MakeLeafTest(Pyramid);
	FCard Card;
	Card.Indices.insert(Card.Indices.end(), {0, 1, 1}); // no area: stays whole
	const FPieceSource Sources[] = {{&Alpha, Card.Vertices.data(), Card.Positions.data(), Card.Indices, 1.0f}};
	const FOpacityPieceList List = CutOpacityPieces(Sources, 1000)[0];
	ASSERT_EQ(List.Positions.size(), List.Indices.size());
	ASSERT_GT(List.GetCount(), 3u);
	for (uint32_t Piece = 0; Piece < List.GetCount(); ++Piece)
	{
		const uint32_t* const C = &List.Indices[3 * Piece];
		const bool bFlat = C[1] == C[2];
		EXPECT_EQ(C[0], 0u);
		const glm::vec3* const P = &List.Positions[3 * Piece];
		const float Twice = glm::cross(P[1] - P[0], P[2] - P[0]).z;
		EXPECT_EQ(Twice > 0.0f, !bFlat) << "winding";
		for (int I = 0; I < 3; ++I)
		{
			EXPECT_EQ(P[I].z, 0.0f);
			const bool bUpper = C[1] == 2;
			EXPECT_LT(bUpper ? P[I].x - P[I].y : P[I].y - P[I].x, 0.01f) << "piece " << Piece;
		}
	}
	EXPECT_EQ(List.Positions.back(), Card.Positions[1]);
}

} // namespace Lantern
