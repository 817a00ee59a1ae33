// The materials of the courtyard: stone, plaster, tiles, wood, metal, terracotta, water, cloth and ground.
#include "Builtin/Courtyard/CourtyardMaterials.h"

#include <cmath>

#include <glm/gtc/constants.hpp>

#include "Builtin/Courtyard/CourtyardFoliageTextures.h"
#include "Builtin/ProceduralTextures.h"
#include "Builtin/Random.h"

namespace Lantern::Builtin
{

namespace
{

float SmoothStep(float A, float B, float X)
{
	const float T = glm::clamp((X - A) / (B - A), 0.0f, 1.0f);
	return T * T * (3.0f - 2.0f * T);
}

/// A wall or floor of rectangular pieces: which piece a point is in, and how far from its edge, in metres.
struct FMasonry
{
	uint32_t Hash;
	float EdgeDistance;
};

/// Rows of pieces; every other row is shifted by half a piece if bBond.
FMasonry FindPiece(const glm::vec2& P, uint32_t Columns, uint32_t Rows, float Metres, bool bBond, uint32_t Seed)
{
	const float Y = P.y * float(Rows);
	const uint32_t Row = uint32_t(Y) % Rows;
	const float X = P.x * float(Columns) + (bBond && Row % 2 == 1 ? 0.5f : 0.0f);
	const uint32_t Column = uint32_t(X) % Columns;
	const float DX = std::min(X - std::floor(X), 1.0f - X + std::floor(X)) * Metres / float(Columns);
	const float DY = std::min(Y - std::floor(Y), 1.0f - Y + std::floor(Y)) * Metres / float(Rows);
	return {HashLattice(Column, Row, Seed), std::min(DX, DY)};
}

glm::vec3 Vary(const glm::vec3& Color, uint32_t Hash, float Amount)
{
	const float Bright = 1.0f + Amount * (HashToFloat(Hash) - 0.5f) * 2.0f;
	const float Warm = 0.25f * Amount * (HashToFloat(HashLattice(Hash, 3, 4)) - 0.5f);
	return Color * Bright * glm::vec3(1.0f + Warm, 1.0f, 1.0f - Warm);
}

int32_t AddAshlar(FSceneBuilder& Builder)
{
	FSurfaceDescription D;
	D.Name = "ashlar";
	D.Metres = 2.4f;
	D.Evaluate = [](const glm::vec2& P) {
		const FMasonry Piece = FindPiece(P, 4, 8, 2.4f, true, 11);
		const float Grain = SampleFractal(P, 16, 5, 0.6f, 21), Stain = SampleFractal(P, 3, 4, 0.5f, 22);
		const float Joint = 1.0f - SmoothStep(0.004f, 0.012f, Piece.EdgeDistance);
		FSurfacePoint S;
		S.Albedo = Vary({0.62f, 0.50f, 0.35f}, Piece.Hash, 0.16f) * (0.72f + 0.42f * Grain) * (0.82f + 0.3f * Stain);
		S.Albedo = glm::mix(S.Albedo, glm::vec3(0.40f, 0.35f, 0.28f), Joint * 0.8f);
		S.Height = 0.010f * Grain - 0.012f * Joint + 0.004f * HashToFloat(Piece.Hash);
		S.Roughness = 0.78f + 0.15f * Grain;
		return S;
	};
	return Builder.AddMaterial(MakeSurfaceMaterial(Builder, D));
}

int32_t AddTrim(FSceneBuilder& Builder)
{
	FSurfaceDescription D;
	D.Name = "limestone";
	D.Size = 256;
	D.Evaluate = [](const glm::vec2& P) {
		const float Grain = SampleFractal(P, 8, 5, 0.6f, 31), Vein = SampleFractal(P, 2, 4, 0.5f, 32);
		FSurfacePoint S;
		S.Albedo = glm::vec3(0.72f, 0.65f, 0.53f) * (0.78f + 0.22f * Grain + 0.15f * Vein);
		S.Height = 0.004f * Grain;
		S.Roughness = 0.6f + 0.2f * Grain;
		return S;
	};
	return Builder.AddMaterial(MakeSurfaceMaterial(Builder, D));
}

int32_t AddPlaster(FSceneBuilder& Builder)
{
	FSurfaceDescription D;
	D.Name = "plaster";
	D.Metres = 3.0f;
	D.Evaluate = [](const glm::vec2& P) {
		const float Trowel = SampleFractal(P, 6, 5, 0.55f, 41), Stain = SampleFractal(P, 2, 4, 0.6f, 42);
		const float Worn = SmoothStep(0.60f, 0.68f, SampleFractal(P, 3, 5, 0.55f, 43));
		FSurfacePoint S;
		S.Albedo = glm::mix(glm::vec3(0.74f, 0.43f, 0.20f), glm::vec3(0.80f, 0.55f, 0.30f), Stain);
		S.Albedo *= 0.82f + 0.3f * Trowel;
		S.Albedo = glm::mix(S.Albedo, glm::vec3(0.60f, 0.52f, 0.42f), Worn * 0.85f);
		S.Height = 0.008f * Trowel - 0.004f * Worn;
		S.Roughness = 0.88f;
		return S;
	};
	return Builder.AddMaterial(MakeSurfaceMaterial(Builder, D));
}

int32_t AddPaving(FSceneBuilder& Builder)
{
	FSurfaceDescription D;
	D.Name = "paving";
	D.Metres = 3.2f;
	D.Evaluate = [](const glm::vec2& P) {
		const FMasonry Piece = FindPiece(P, 4, 4, 3.2f, false, 51);
		const uint32_t Column = uint32_t(P.x * 4.0f), Row = uint32_t(P.y * 4.0f);
		const float Grain = SampleFractal(P, 16, 5, 0.55f, 52), Worn = SampleFractal(P, 4, 4, 0.5f, 53);
		const float Joint = 1.0f - SmoothStep(0.005f, 0.014f, Piece.EdgeDistance);
		const glm::vec3 Light(0.60f, 0.53f, 0.43f), Dark(0.36f, 0.27f, 0.21f);
		FSurfacePoint S;
		S.Albedo = Vary((Column + Row) % 2 == 0 ? Light : Dark, Piece.Hash, 0.18f) * (0.75f + 0.4f * Grain);
		S.Albedo = glm::mix(S.Albedo, glm::vec3(0.22f, 0.20f, 0.15f), Joint);
		S.Height = 0.005f * Grain - 0.010f * Joint + 0.003f * HashToFloat(Piece.Hash);
		S.Roughness = glm::mix(0.35f + 0.45f * Worn, 0.95f, Joint);
		return S;
	};
	return Builder.AddMaterial(MakeSurfaceMaterial(Builder, D));
}

int32_t AddRoofTile(FSceneBuilder& Builder)
{
	FSurfaceDescription D;
	D.Name = "roof tile";
	D.Size = 256;
	D.Metres = 1.5f;
	D.Evaluate = [](const glm::vec2& P) {
		const float Grain = SampleFractal(P, 12, 5, 0.6f, 61), Moss = SampleFractal(P, 4, 5, 0.6f, 62);
		FSurfacePoint S;
		S.Albedo = glm::mix(glm::vec3(0.50f, 0.17f, 0.07f), glm::vec3(0.62f, 0.29f, 0.13f), Grain);
		S.Albedo = glm::mix(S.Albedo, glm::vec3(0.27f, 0.24f, 0.14f), SmoothStep(0.55f, 0.8f, Moss));
		S.Height = 0.004f * Grain;
		S.Roughness = 0.85f;
		return S;
	};
	return Builder.AddMaterial(MakeSurfaceMaterial(Builder, D));
}

int32_t AddWood(FSceneBuilder& Builder, const char* Name, const glm::vec3& Color, uint32_t Seed)
{
	FSurfaceDescription D;
	D.Name = Name;
	D.Metres = 1.2f;
	D.Evaluate = [Color, Seed](const glm::vec2& P) {
		const uint32_t Plank = uint32_t(P.x * 8.0f);
		const float Edge = std::min(P.x * 8.0f - float(Plank), 1.0f + float(Plank) - P.x * 8.0f) * 0.15f;
		const float Shift = HashToFloat(HashLattice(Plank, 1, Seed));
		// Rings of a long grain: noise stretched along the plank.
		const float Bend = SampleFractal({P.x, P.y + Shift}, 4, 3, 0.5f, Seed);
		const float Grain = 0.5f + 0.5f * std::sin(glm::two_pi<float>() * (P.x * 24.0f + 3.0f * Bend + Shift * 7.0f));
		const float Fine = SampleNoise({P.x, P.y * 0.125f + Shift}, 256, Seed + 1);
		const float Gap = 1.0f - SmoothStep(0.001f, 0.005f, Edge);
		FSurfacePoint S;
		S.Albedo = Vary(Color, HashLattice(Plank, 2, Seed), 0.2f) * (0.62f + 0.28f * Grain + 0.25f * Fine);
		S.Albedo *= 1.0f - 0.8f * Gap;
		S.Height = 0.0012f * Grain + 0.0008f * Fine - 0.006f * Gap;
		S.Roughness = 0.55f + 0.25f * Fine;
		return S;
	};
	return Builder.AddMaterial(MakeSurfaceMaterial(Builder, D));
}

int32_t AddMetal(FSceneBuilder& Builder, const char* Name, const glm::vec3& Clean, const glm::vec3& Aged, float Age, uint32_t Seed)
{
	FSurfaceDescription D;
	D.Name = Name;
	D.Size = 256;
	D.bNormalMap = false;
	D.Evaluate = [=](const glm::vec2& P) {
		const float Patina = SmoothStep(0.62f - Age, 0.80f - Age, SampleFractal(P, 6, 6, 0.6f, Seed));
		FSurfacePoint S;
		S.Albedo = glm::mix(Clean, Aged, Patina);
		S.Metallic = 1.0f - Patina;
		S.Roughness = glm::mix(0.30f, 0.75f, Patina) + 0.15f * SampleFractal(P, 16, 3, 0.5f, Seed + 1);
		return S;
	};
	return Builder.AddMaterial(MakeSurfaceMaterial(Builder, D));
}

int32_t AddTerracotta(FSceneBuilder& Builder)
{
	FSurfaceDescription D;
	D.Name = "terracotta";
	D.Size = 256;
	D.Evaluate = [](const glm::vec2& P) {
		const float Grain = SampleFractal(P, 8, 6, 0.6f, 71), Lime = SampleFractal(P, 3, 5, 0.6f, 72);
		FSurfacePoint S;
		S.Albedo = glm::vec3(0.58f, 0.26f, 0.13f) * (0.75f + 0.4f * Grain);
		S.Albedo = glm::mix(S.Albedo, glm::vec3(0.66f, 0.55f, 0.45f), SmoothStep(0.55f, 0.75f, Lime) * 0.6f);
		S.Height = 0.002f * Grain;
		S.Roughness = 0.82f;
		return S;
	};
	return Builder.AddMaterial(MakeSurfaceMaterial(Builder, D));
}

int32_t AddWater(FSceneBuilder& Builder)
{
	FSurfaceDescription D;
	D.Name = "water";
	D.bRoughnessMap = false;
	D.Metres = 1.6f;
	D.Evaluate = [](const glm::vec2& P) {
		FSurfacePoint S;
		S.Albedo = {0.93f, 0.98f, 0.98f};
		S.Roughness = 0.02f;
		S.Height = 0.014f * SampleFractal(P, 5, 4, 0.45f, 81);
		return S;
	};
	FHostMaterial Material = MakeSurfaceMaterial(Builder, D);
	Material.Ior = 1.333f;
	Material.Transmission = 1.0f;
	Material.bSolid = true;
	Material.Extinction = {1.8f, 0.5f, 0.4f}; // a little green
	return Builder.AddMaterial(Material);
}

int32_t AddCloth(FSceneBuilder& Builder, const char* Name, const glm::vec3& Ground, const glm::vec3& Figure)
{
	FSurfaceDescription D;
	D.Name = Name;
	D.bUnitUV = true;
	D.bRoughnessMap = false;
	D.Evaluate = [=](const glm::vec2& P) {
		const float Border = std::min(std::min(P.x, 1.0f - P.x), P.y * 3.0f);
		const glm::vec2 C = (P - glm::vec2(0.5f, 0.42f)) * glm::vec2(1.0f, 3.0f);
		const float Angle = std::atan2(C.y, C.x), Radius = glm::length(C);
		// A sun of eight rays.
		const float Ray = 0.22f + 0.07f * std::cos(8.0f * Angle);
		const bool bFigure = Radius < Ray || (Border > 0.07f && Border < 0.11f);
		const float Weave = 0.5f + 0.25f * (std::sin(P.x * 800.0f) + std::sin(P.y * 2400.0f));
		FSurfacePoint S;
		S.Albedo = (bFigure ? Figure : Ground) * (0.85f + 0.15f * Weave);
		S.Height = 0.0006f * Weave;
		S.Roughness = 0.9f;
		return S;
	};
	FHostMaterial Material = MakeSurfaceMaterial(Builder, D);
	Material.bDoubleSided = true;
	return Builder.AddMaterial(Material);
}

int32_t AddGround(FSceneBuilder& Builder, const char* Name, const glm::vec3& A, const glm::vec3& B, uint32_t Seed)
{
	FSurfaceDescription D;
	D.Name = Name;
	D.Metres = 4.0f;
	D.bRoughnessMap = false;
	D.Evaluate = [=](const glm::vec2& P) {
		const float Fine = SampleFractal(P, 32, 4, 0.7f, Seed), Broad = SampleFractal(P, 4, 5, 0.5f, Seed + 7);
		FSurfacePoint S;
		S.Albedo = glm::mix(A, B, Broad) * (0.55f + 0.8f * Fine);
		S.Height = 0.03f * Fine;
		S.Roughness = 0.95f;
		return S;
	};
	return Builder.AddMaterial(MakeSurfaceMaterial(Builder, D));
}

/// Falling water, white with the air in it.
int32_t AddSpray(FSceneBuilder& Builder)
{
	FHostMaterial Material;
	Material.Name = "spray";
	Material.BaseColor = {0.70f, 0.80f, 0.84f, 1};
	Material.Metallic = 0.0f;
	Material.Roughness = 0.12f;
	Material.Ior = 1.333f;
	return Builder.AddMaterial(Material);
}

int32_t AddGlow(FSceneBuilder& Builder)
{
	FHostMaterial Material;
	Material.Name = "lantern pane";
	Material.BaseColor = {0.8f, 0.6f, 0.35f, 1};
	Material.Emissive = glm::vec3(1.0f, 0.55f, 0.20f) * 12.0f;
	Material.Metallic = 0.0f;
	Material.Roughness = 0.3f;
	return Builder.AddMaterial(Material);
}

} // namespace

FCourtyardMaterials MakeCourtyardMaterials(FSceneBuilder& Builder)
{
	FCourtyardMaterials M{};
	M.Ashlar = AddAshlar(Builder);
	M.Trim = AddTrim(Builder);
	M.Plaster = AddPlaster(Builder);
	M.Paving = AddPaving(Builder);
	M.RoofTile = AddRoofTile(Builder);
	M.Earth = AddGround(Builder, "earth", {0.14f, 0.09f, 0.05f}, {0.20f, 0.13f, 0.08f}, 91);
	M.Grass = AddGround(Builder, "meadow", {0.13f, 0.17f, 0.05f}, {0.30f, 0.27f, 0.10f}, 95);
	M.Wood = AddWood(Builder, "oak", {0.36f, 0.20f, 0.09f}, 101);
	M.DarkWood = AddWood(Builder, "shutter green", {0.10f, 0.19f, 0.14f}, 111);
	M.Iron = AddMetal(Builder, "wrought iron", {0.12f, 0.12f, 0.13f}, {0.12f, 0.07f, 0.05f}, 0.05f, 121);
	M.Bronze = AddMetal(Builder, "bronze", {0.72f, 0.46f, 0.22f}, {0.18f, 0.38f, 0.30f}, 0.12f, 131);
	M.Terracotta = AddTerracotta(Builder);
	M.Water = AddWater(Builder);
	M.Spray = AddSpray(Builder);
	M.Glow = AddGlow(Builder);
	M.Cloth = AddCloth(Builder, "red cloth", {0.55f, 0.04f, 0.04f}, {0.80f, 0.58f, 0.15f});
	M.ClothBlue = AddCloth(Builder, "blue cloth", {0.05f, 0.12f, 0.42f}, {0.80f, 0.62f, 0.22f});
	M.Bark = AddWood(Builder, "bark", {0.22f, 0.15f, 0.10f}, 141);
	M.Leaves = AddLeafMaterial(Builder, ELeafKind::Broad);
	M.Ivy = AddLeafMaterial(Builder, ELeafKind::Ivy);
	M.Cypress = AddLeafMaterial(Builder, ELeafKind::Needle);
	M.Flower = AddLeafMaterial(Builder, ELeafKind::Flower);
	return M;
}

} // namespace Lantern::Builtin
