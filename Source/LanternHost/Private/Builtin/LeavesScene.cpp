// A bower against the sun: leaves, a paper screen and a paper lantern, which light scatters through.
#include <cmath>

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "Builtin/LeavesScene.h"
#include "Builtin/ProceduralTextures.h"
#include "Builtin/Random.h"
#include "Builtin/SceneBuilder.h"

namespace Lantern::Builtin
{

namespace
{
struct FScattering
{
	float Share; ///< 0: none
	glm::vec3 Color;
};

void SetScattering(FHostMaterial& Material, const FScattering& Scattering)
{
	Material.DiffuseTransmission = Scattering.Share;
	Material.DiffuseTransmissionColor = Scattering.Color;
	Material.bDoubleSided = true;
}

int32_t AddPaper(FSceneBuilder& Builder, const char* Name, const glm::vec3& Color, const FScattering& Scattering)
{
	FHostMaterial Paper;
	Paper.Name = Name;
	Paper.BaseColor = glm::vec4(Color, 1.0f);
	Paper.Metallic = 0.0f;
	Paper.Roughness = 0.9f;
	SetScattering(Paper, Scattering);
	return Builder.AddMaterial(Paper);
}

/// One leaf, cut out of its quad: ribs are darker and a little higher.
int32_t AddLeafMaterial(FSceneBuilder& Builder, const FScattering& Scattering)
{
	FSurfaceDescription Leaf;
	Leaf.Name = "leaf";
	Leaf.Size = 256;
	Leaf.bUnitUV = true;
	Leaf.Evaluate = [](const glm::vec2& P) {
		const float Across = 2.0f * P.x - 1.0f, Along = P.y;
		const float Width = 0.85f * std::sin(glm::pi<float>() * std::pow(std::min(std::max(Along, 0.0f), 1.0f), 0.8f));
		const float Slant = Along * 9.0f - 3.5f * std::abs(Across);
		const bool bRib = std::abs(Across) < 0.035f || std::abs(Slant - std::round(Slant)) < 0.07f;
		FSurfacePoint Point;
		Point.Albedo = glm::mix(glm::vec3(0.1f, 0.24f, 0.045f), glm::vec3(0.2f, 0.3f, 0.1f), bRib ? 1.0f : 0.0f);
		Point.Height = bRib ? 0.0006f : 0.0f;
		Point.Roughness = 0.55f;
		Point.Alpha = std::abs(Across) < Width ? 1.0f : 0.0f;
		return Point;
	};
	Leaf.Metres = 0.16f;
	FHostMaterial Material = MakeSurfaceMaterial(Builder, Leaf);
	Material.AlphaMode = EAlphaMode::Mask;
	SetScattering(Material, Scattering);
	return Builder.AddMaterial(Material);
}

/// Leaves along a hanging branch. They droop, and face every way.
void AddBranch(FMeshBuilder& Leaves, const glm::vec3& Start, const glm::vec3& End, int Count, FRandomStream& Random)
{
	for (int I = 0; I < Count; ++I)
	{
		const float T = (float(I) + Random.NextFloat()) / float(Count), Sag = -0.5f * T * (1.0f - T);
		const glm::vec3 Place = glm::mix(Start, End, T) +
		                        glm::vec3(Random.Between(-0.18f, 0.18f), Sag + Random.Between(-0.2f, 0.1f), Random.Between(-0.18f, 0.18f));
		const float Size = Random.Between(0.1f, 0.19f);
		glm::mat4 Transform = glm::translate(glm::mat4(1), Place);
		Transform = glm::rotate(Transform, Random.Between(0.0f, glm::two_pi<float>()), {0, 1, 0});
		Transform = glm::rotate(Transform, Random.Between(1.6f, 2.9f), {1, 0, 0});
		Leaves.SetTransform(glm::scale(Transform, glm::vec3(Size)));
		Leaves.AddUnitQuad({-0.4f, 0, 0}, {0.4f, 0, 0}, {0.4f, 1, 0}, {-0.4f, 1, 0});
	}
}

void AddBower(FSceneBuilder& Builder, const FScattering& Scattering)
{
	const int32_t Wood = Builder.AddLambert("wood", {0.2f, 0.13f, 0.08f});
	FMeshBuilder Frame("frame");
	Frame.BeginSection(Wood);
	for (const float X : {-2.2f, 2.2f})
	{
		for (const float Z : {-2.6f, 0.6f}) { Frame.AddBox({X - 0.07f, 0, Z - 0.07f}, {X + 0.07f, 2.7f, Z + 0.07f}); }
	}
	for (int I = 0; I < 7; ++I)
	{
		const float Z = -2.7f + 0.58f * float(I);
		Frame.AddBox({-2.6f, 2.7f, Z - 0.04f}, {2.6f, 2.8f, Z + 0.04f});
	}
	Builder.AddNode("frame", Builder.AddMesh(Frame));
	FMeshBuilder Leaves("leaves");
	Leaves.BeginSection(AddLeafMaterial(Builder, Scattering));
	FRandomStream Random(7);
	for (int I = 0; I < 18; ++I)
	{
		const float X = -2.5f + 5.0f * float(I) / 17.0f;
		AddBranch(Leaves, {X, 2.85f, -2.8f}, {X + Random.Between(-0.5f, 0.5f), 2.85f, 0.9f}, 110, Random);
	}
	for (int I = 0; I < 9; ++I) // the side towards the sun hangs down
	{
		const float X = -2.4f + 4.8f * float(I) / 8.0f;
		if (I > 2 && I < 6) { continue; }
		AddBranch(Leaves, {X, 2.8f, -2.75f}, {X + Random.Between(-0.2f, 0.2f), Random.Between(0.8f, 1.5f), -2.7f}, 60, Random);
	}
	Leaves.SetTransform(glm::mat4(1));
	Builder.AddNode("leaves", Builder.AddMesh(Leaves));
}

/// A frame of paper with a potted plant's stalks behind it, whose shadows it shows.
void AddScreen(FSceneBuilder& Builder, const FScattering& Scattering)
{
	const int32_t Wood = Builder.AddLambert("dark wood", {0.12f, 0.07f, 0.04f});
	FMeshBuilder Paper("screen");
	Paper.BeginSection(AddPaper(Builder, "paper", {0.8f, 0.77f, 0.7f}, Scattering));
	Paper.AddQuad({-0.6f, 0.1f, 0}, {0.6f, 0.1f, 0}, {0.6f, 1.7f, 0}, {-0.6f, 1.7f, 0});
	Paper.BeginSection(Wood);
	for (const float X : {-0.62f, -0.21f, 0.2f, 0.6f}) { Paper.AddBox({X, 0, -0.02f}, {X + 0.025f, 1.74f, 0.02f}); }
	for (const float Y : {0.08f, 0.62f, 1.16f, 1.7f}) { Paper.AddBox({-0.6f, Y, -0.018f}, {0.6f, Y + 0.025f, 0.018f}); }
	Builder.AddNode("screen", Builder.AddMesh(Paper), {1.05f, 0, -1.5f}, 0.35f);
	FMeshBuilder Stalks("stalks");
	Stalks.BeginSection(Wood);
	FRandomStream Random(3);
	for (int I = 0; I < 7; ++I)
	{
		const float X = -0.35f + 0.11f * float(I);
		const glm::vec3 Path[] = {{X, 0, 0}, {X + Random.Between(-0.1f, 0.1f), 0.6f, 0}, {X + Random.Between(-0.25f, 0.25f), 1.2f, 0}};
		const float Radii[] = {0.018f, 0.014f, 0.006f};
		Stalks.AddTube(Path, Radii, 8);
	}
	Builder.AddNode("stalks", Builder.AddMesh(Stalks), {1.05f, 0, -1.85f}, 0.35f);
}

void AddLantern(FSceneBuilder& Builder, const FScattering& Scattering)
{
	FMeshBuilder Shade("lantern");
	Shade.BeginSection(AddPaper(Builder, "red paper", {0.75f, 0.3f, 0.18f}, Scattering));
	const glm::vec2 Profile[] = {{0.07f, -0.2f}, {0.15f, -0.15f}, {0.18f, -0.05f}, {0.18f, 0.05f}, {0.15f, 0.15f}, {0.07f, 0.2f}};
	Shade.AddLathe(Profile, 40);
	Builder.AddNode("lantern", Builder.AddMesh(Shade), {-0.95f, 1.55f, -1.1f});
	Builder.AddPointLight("candle", {-0.95f, 1.5f, -1.1f}, glm::vec3(0.6f, 0.42f, 0.22f), 8.0f);
}
} // namespace

FSceneDescription BuildLeavesScene(bool bScattering)
{
	const float Share = bScattering ? 1.0f : 0.0f;
	FSceneBuilder Builder("leaves");
	FMeshBuilder Ground("ground");
	Ground.BeginSection(Builder.AddLambert("gravel", {0.34f, 0.31f, 0.26f}));
	Ground.AddQuad({-20, 0, 20}, {20, 0, 20}, {20, 0, -20}, {-20, 0, -20});
	Builder.AddNode("ground", Builder.AddMesh(Ground));
	FMeshBuilder Wall("wall");
	Wall.BeginSection(Builder.AddLambert("wall", {0.55f, 0.5f, 0.44f}));
	Wall.AddBox({-4.2f, 0, 2.6f}, {4.2f, 3.2f, 2.8f});
	Wall.AddBox({-20, 0, -9.2f}, {20, 1.5f, -9});
	Builder.AddNode("wall", Builder.AddMesh(Wall));
	FMeshBuilder Bushes("bushes");
	Bushes.BeginSection(Builder.AddLambert("bush", {0.07f, 0.13f, 0.05f}));
	FRandomStream Random(11);
	for (int I = 0; I < 24; ++I)
	{
		const float Radius = Random.Between(0.5f, 1.3f);
		Bushes.AddSphere({-13.0f + 1.15f * float(I), 0.5f * Radius, Random.Between(-8.2f, -6.8f)}, Radius, 4);
	}
	Builder.AddNode("bushes", Builder.AddMesh(Bushes));
	AddBower(Builder, {0.55f * Share, {0.42f, 0.62f, 0.09f}});
	AddScreen(Builder, {0.5f * Share, {0.8f, 0.72f, 0.58f}});
	AddLantern(Builder, {0.5f * Share, {0.9f, 0.36f, 0.16f}});
	Builder.AddCamera({-0.25, 1.35, 2.3}, {0.0, 1.45, -1.5}, 58);
	Builder.SetLight(glm::normalize(glm::vec3(-0.35f, -0.75f, 1.0f)), 9.0f, {0.3f, 0.42f, 0.6f});
	Builder.Scene.DefaultExposure = 0.0f;
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
