// Draws sprays of leaves into alpha-tested textures.
#include "Builtin/Courtyard/CourtyardFoliageTextures.h"

#include <cmath>
#include <vector>

#include <glm/gtc/constants.hpp>

#include "Builtin/ProceduralTextures.h"
#include "Builtin/Random.h"

namespace Lantern::Builtin
{

namespace
{

/// One leaf: a frame at its stem, and how it looks.
struct FLeaf
{
	glm::vec2 Stem, Direction; ///< Direction: unit
	float Length, Width;
	glm::vec3 Color;
};

/// Half the width of a leaf at T along it, 0 … 1.
float GetHalfWidth(ELeafKind Kind, float T)
{
	if (T <= 0.0f || T >= 1.0f) { return 0.0f; }
	switch (Kind)
	{
	case ELeafKind::Broad: return std::sin(glm::pi<float>() * std::pow(T, 0.75f));
	case ELeafKind::Ivy: return (1.0f - T) * (0.75f + 0.45f * std::cos(T * 9.0f)) * std::min(1.0f, T * 12.0f) * 1.1f;
	case ELeafKind::Needle: return std::sqrt(std::min(T * 4.0f, 1.0f - T));
	case ELeafKind::Flower: return std::sin(glm::pi<float>() * std::pow(T, 1.8f));
	}
	return 0.0f;
}

std::vector<FLeaf> ArrangeSpray(const glm::vec3& Color, int Count, float Length, float Width, uint32_t Seed)
{
	FRandomStream Random(Seed);
	std::vector<FLeaf> Leaves;
	for (int I = 0; I < Count; ++I)
	{
		const float Along = (float(I) + 0.5f) / float(Count);
		const float Side = I % 2 == 0 ? 1.0f : -1.0f;
		const float Angle = Side * Random.Between(0.5f, 1.3f) * (1.0f - 0.6f * Along);
		FLeaf Leaf;
		Leaf.Stem = {0.5f + 0.03f * std::sin(Along * 7.0f), 0.97f - 0.72f * Along};
		Leaf.Direction = {std::sin(Angle), -std::cos(Angle)};
		Leaf.Length = Length * Random.Between(0.75f, 1.1f);
		Leaf.Width = Width * Random.Between(0.8f, 1.15f);
		Leaf.Color = Color * Random.Between(0.7f, 1.25f) * glm::vec3(Random.Between(0.85f, 1.25f), 1.0f, 0.9f);
		Leaves.push_back(Leaf);
	}
	return Leaves;
}

std::vector<FLeaf> Arrange(ELeafKind Kind)
{
	switch (Kind)
	{
	case ELeafKind::Broad: return ArrangeSpray({0.24f, 0.38f, 0.08f}, 15, 0.34f, 0.085f, 5);
	case ELeafKind::Ivy: return ArrangeSpray({0.13f, 0.27f, 0.06f}, 9, 0.34f, 0.17f, 6);
	case ELeafKind::Needle: return ArrangeSpray({0.10f, 0.20f, 0.07f}, 46, 0.24f, 0.022f, 7);
	case ELeafKind::Flower: break;
	}
	std::vector<FLeaf> Petals;
	for (int Blossom = 0; Blossom < 5; ++Blossom)
	{
		const glm::vec2 Center(0.2f + 0.15f * float(Blossom), 0.3f + 0.38f * float((Blossom * 2) % 5) / 4.0f);
		for (int I = 0; I < 6; ++I)
		{
			const float Angle = glm::two_pi<float>() * float(I) / 6.0f;
			const glm::vec3 Color = Blossom % 2 == 0 ? glm::vec3(0.75f, 0.10f, 0.14f) : glm::vec3(0.85f, 0.62f, 0.65f);
			Petals.push_back({Center, {std::cos(Angle), std::sin(Angle)}, 0.12f, 0.05f, Color});
		}
	}
	const std::vector<FLeaf> Green = ArrangeSpray({0.10f, 0.22f, 0.05f}, 12, 0.25f, 0.06f, 8);
	Petals.insert(Petals.end(), Green.begin(), Green.end());
	return Petals;
}

FSurfacePoint EvaluateLeaves(const std::vector<FLeaf>& Leaves, ELeafKind Kind, const glm::vec2& P)
{
	FSurfacePoint S;
	// Transparent texels have the colour of their surroundings, so that filtering brings in no dark fringe.
	S.Albedo = Leaves[Leaves.size() / 2].Color;
	S.Alpha = 0.0f;
	S.Roughness = 0.6f;
	if (Kind != ELeafKind::Flower && P.y > 0.25f && std::abs(P.x - 0.5f - 0.03f * std::sin((0.97f - P.y) / 0.72f * 7.0f)) < 0.008f)
	{
		S.Albedo = {0.16f, 0.12f, 0.05f};
		S.Alpha = 1.0f;
	}
	for (const FLeaf& Leaf : Leaves)
	{
		const glm::vec2 D = P - Leaf.Stem;
		const float Along = glm::dot(D, Leaf.Direction) / Leaf.Length;
		const float Across = D.x * Leaf.Direction.y - D.y * Leaf.Direction.x;
		const float Half = Leaf.Width * GetHalfWidth(Kind, Along);
		if (std::abs(Across) < Half)
		{
			const float Vein = std::abs(Across) < 0.0035f ? 1.25f : 1.0f;
			const float Rib = 0.92f + 0.08f * std::sin((Along * 22.0f + std::abs(Across) / Leaf.Width * 3.0f) * 2.0f);
			S.Albedo = Leaf.Color * Vein * Rib * (Across > 0 ? 1.0f : 0.86f);
			S.Alpha = 1.0f;
			break;
		}
	}
	return S;
}

} // namespace

int32_t AddLeafMaterial(FSceneBuilder& Builder, ELeafKind Kind)
{
	constexpr const char* Names[] = {"leaves", "ivy", "cypress", "flowers"};
	const std::vector<FLeaf> Leaves = Arrange(Kind);
	FSurfaceDescription D;
	D.Name = Names[int(Kind)];
	D.bUnitUV = true;
	D.bNormalMap = false;
	D.bRoughnessMap = false;
	D.Size = 256;
	D.Evaluate = [&](const glm::vec2& P) { return EvaluateLeaves(Leaves, Kind, P); };
	FHostMaterial Material = MakeSurfaceMaterial(Builder, D);
	FHostTexture& Texture = Builder.Scene.Textures[size_t(Material.Slots[TEXTURE_BASE_COLOR].Texture)];
	Texture.bRepeatU = Texture.bRepeatV = false;
	Material.Name = D.Name;
	Material.AlphaMode = EAlphaMode::Mask;
	Material.bDoubleSided = true;
	return Builder.AddMaterial(Material);
}

} // namespace Lantern::Builtin
