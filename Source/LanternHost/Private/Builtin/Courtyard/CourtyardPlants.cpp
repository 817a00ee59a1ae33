// Potted trees, cypresses, ivy, flowers and fallen leaves: cards with alpha-tested sprays of leaves.
#include <cmath>
#include <vector>

#include <glm/gtc/constants.hpp>

#include "Builtin/Courtyard/CourtyardParts.h"
#include "TangentSpace.h"

namespace Lantern::Builtin
{

namespace
{

glm::vec3 RandomDirection(FRandomStream& Random)
{
	const float Y = Random.Between(-1, 1), Angle = Random.Between(0, glm::two_pi<float>());
	const float R = std::sqrt(std::max(0.0f, 1 - Y * Y));
	return {R * std::cos(Angle), Y, R * std::sin(Angle)};
}

/// A card from its stem along Up; Normal is what it is lit by, which need not be its own: the crown's looks rounder.
void AddCard(FMeshBuilder& Mesh, const glm::vec3& Stem, const glm::vec3& Up, const glm::vec3& Facing, float Size, const glm::vec3& Normal)
{
	const glm::vec3 Side = glm::normalize(glm::cross(Up, Facing)) * Size * 0.5f, Top = Up * Size;
	const uint32_t A = Mesh.AddVertex(Stem - Side, Normal, {0, 1}), B = Mesh.AddVertex(Stem + Side, Normal, {1, 1});
	const uint32_t C = Mesh.AddVertex(Stem + Side + Top, Normal, {1, 0}), D = Mesh.AddVertex(Stem - Side + Top, Normal, {0, 0});
	// The front is on the side of the normal, since a back face would turn it round.
	const glm::vec3 Front = glm::cross(Side, Top);
	if (glm::dot(Front, Normal) >= 0)
	{
		Mesh.AddTriangle(A, B, C);
		Mesh.AddTriangle(A, C, D);
	}
	else
	{
		Mesh.AddTriangle(A, C, B);
		Mesh.AddTriangle(A, D, C);
	}
}

void AddCrown(FMeshBuilder& Mesh, const glm::vec3& Center, const glm::vec3& Radii, int Count, float Size, uint32_t Seed)
{
	FRandomStream Random(Seed);
	for (int I = 0; I < Count; ++I)
	{
		const glm::vec3 Direction = RandomDirection(Random);
		const float Depth = 0.55f + 0.45f * std::sqrt(Random.NextFloat());
		const glm::vec3 Stem = Center + Direction * Radii * Depth;
		const glm::vec3 Up = glm::normalize(Direction + RandomDirection(Random) * 0.8f + glm::vec3(0, 0.25f, 0));
		const glm::vec3 Facing = RandomDirection(Random);
		const float Shade = Random.Between(0.7f, 1.0f) * (0.55f + 0.45f * Depth);
		Mesh.SetColor(glm::vec3(Shade));
		if (glm::length(glm::cross(Up, Facing)) > 0.2f)
		{
			AddCard(Mesh, Stem, Up, Facing, Size * Random.Between(0.75f, 1.2f), glm::normalize(Direction + Up * 0.4f));
		}
	}
	Mesh.SetColor(glm::vec3(1));
}

void AddTrunk(FMeshBuilder& Mesh, const glm::vec3& Top, float Radius)
{
	std::vector<glm::vec3> Path;
	std::vector<float> Radii;
	for (int I = 0; I <= 8; ++I)
	{
		const float T = float(I) / 8;
		Path.emplace_back(Top.x * T + 0.05f * std::sin(T * 5), Top.y * T, Top.z * T + 0.04f * std::sin(T * 7 + 1));
		Radii.push_back(Radius * (1.15f - 0.6f * T));
	}
	Mesh.AddTube(Path, Radii, 10);
	for (int Branch = 0; Branch < 6; ++Branch)
	{
		const float Angle = float(Branch) * 2.4f, T = 0.72f + 0.04f * float(Branch);
		const glm::vec3 Start = Top * T, Out(std::cos(Angle), 1.1f, std::sin(Angle));
		const glm::vec3 Limb[] = {Start, Start + Out * 0.25f, Start + Out * 0.48f + glm::vec3(0, 0.1f, 0)};
		const float LimbRadii[] = {Radius * 0.5f, Radius * 0.35f, Radius * 0.15f};
		Mesh.AddTube(Limb, LimbRadii, 7);
	}
}

void AddPot(const FCourtyard& Yard, FMeshBuilder& Mesh, float Scale)
{
	Mesh.BeginSection(Yard.M.Terracotta);
	std::vector<glm::vec2> Profile = {{0.0f, 0}, {0.24f, 0}, {0.24f, 0}, {0.26f, 0.03f}, {0.34f, 0.35f}, {0.37f, 0.48f}, {0.37f, 0.48f},
	    {0.42f, 0.49f}, {0.43f, 0.53f}, {0.42f, 0.58f}, {0.42f, 0.58f}, {0.36f, 0.58f}, {0.36f, 0.58f}, {0.35f, 0.50f}};
	for (glm::vec2& P : Profile) { P *= Scale; }
	Mesh.AddLathe(Profile, 32);
	Mesh.BeginSection(Yard.M.Earth);
	Mesh.AddDisk({0, 0.52f * Scale, 0}, {0, 1, 0}, 0.36f * Scale, 24);
}

void AddTrees(const FCourtyard& Yard)
{
	FMeshBuilder Mesh("potted tree");
	AddPot(Yard, Mesh, 1.25f);
	Mesh.BeginSection(Yard.M.Bark);
	AddTrunk(Mesh, {0.06f, 2.3f, 0.03f}, 0.07f);
	Mesh.BeginSection(Yard.M.Leaves);
	AddCrown(Mesh, {0.06f, 2.75f, 0.03f}, {0.95f, 0.85f, 0.95f}, 620, 0.42f, 3);
	const int32_t Tree = Yard.Builder.AddMesh(Mesh);
	const glm::vec2 Places[] = {{-5.2f, -5.2f}, {5.2f, -5.2f}, {-5.2f, 4.6f}, {1.9f, -6.3f}, {-1.9f, -6.3f}};
	for (int I = 0; I < 5; ++I)
	{
		Yard.Builder.AddNode("tree", Tree, {Places[I].x, 0, Places[I].y}, float(I) * 1.7f, glm::vec3(0.92f + 0.05f * float(I % 3)));
	}
}

void AddCypresses(const FCourtyard& Yard)
{
	FMeshBuilder Mesh("cypress");
	Mesh.BeginSection(Yard.M.Bark);
	AddTrunk(Mesh, {0.0f, 1.2f, 0.0f}, 0.14f);
	Mesh.BeginSection(Yard.M.Cypress);
	FRandomStream Random(29);
	for (int I = 0; I < 900; ++I)
	{
		const float T = Random.NextFloat(), Angle = Random.Between(0, glm::two_pi<float>());
		const float Radius = 0.85f * std::pow(std::sin(glm::pi<float>() * std::min(0.06f + 0.94f * T, 0.99f)), 0.7f) * (1.0f - 0.45f * T);
		const glm::vec3 Out(std::cos(Angle), 0, std::sin(Angle));
		const glm::vec3 Stem = Out * Radius * Random.Between(0.6f, 1.0f) + glm::vec3(0, 0.5f + 6.6f * T, 0);
		const float Shade = Random.Between(0.6f, 1.0f);
		Mesh.SetColor(glm::vec3(Shade));
		const glm::vec3 Up = glm::normalize(Out * 0.45f + glm::vec3(Random.Between(-0.3f, 0.3f), 1, Random.Between(-0.3f, 0.3f)));
		AddCard(Mesh, Stem, Up, glm::normalize(Out + RandomDirection(Random) * 0.6f), Random.Between(0.55f, 0.9f),
		    glm::normalize(Out + glm::vec3(0, 0.35f, 0)));
	}
	const int32_t Cypress = Yard.Builder.AddMesh(Mesh);
	FRandomStream Places(41);
	for (int I = 0; I < 22; ++I)
	{
		// In a loose row beyond the arcade, and some further out; none where it would shade the yard's arches.
		const bool bNear = I < 7;
		const float X = bNear ? -24.0f - Places.Between(0, 4) : -Places.Between(28, 90);
		const float Z = bNear ? -17.0f + float(I) * 2.6f : Places.Between(-60, 10);
		Yard.Builder.AddNode("cypress", Cypress, {X, -0.1f, Z}, Places.Between(0, 6), glm::vec3(Places.Between(0.7f, 1.15f)));
	}
}

/// Vines that wander up a wall in the xy plane facing +z.
int32_t MakeIvy(const FCourtyard& Yard, uint32_t Seed, float Height, float Spread)
{
	FMeshBuilder Mesh("ivy");
	Mesh.BeginSection(Yard.M.Ivy);
	FRandomStream Random(Seed);
	for (int Vine = 0; Vine < 9; ++Vine)
	{
		glm::vec2 P(Random.Between(-0.3f, 0.3f), 0.0f);
		float Angle = Random.Between(-0.6f, 0.6f);
		const float Reach = Height * Random.Between(0.45f, 1.0f);
		while (P.y < Reach && std::abs(P.x) < Spread)
		{
			Angle = glm::clamp(Angle + Random.Between(-0.45f, 0.45f), -1.2f, 1.2f);
			P += 0.05f * glm::vec2(std::sin(Angle), std::cos(Angle));
			const float LeafAngle = Random.Between(-2.2f, 2.2f);
			const glm::vec3 Up = glm::normalize(glm::vec3(std::sin(LeafAngle), std::cos(LeafAngle), Random.Between(0.1f, 0.5f)));
			const glm::vec3 Facing = glm::normalize(glm::vec3(Random.Between(-0.5f, 0.5f), Random.Between(-0.1f, 0.6f), 1));
			const glm::vec3 Stem(P + glm::vec2(Random.Between(-0.12f, 0.12f), Random.Between(-0.12f, 0.12f)), Random.Between(0.02f, 0.12f));
			Mesh.SetColor(glm::vec3(Random.Between(0.65f, 1.0f)));
			AddCard(Mesh, Stem, Up, Facing, Random.Between(0.16f, 0.30f), glm::normalize(Facing + Up * 0.3f));
		}
	}
	return Yard.Builder.AddMesh(Mesh);
}

void AddIvy(const FCourtyard& Yard)
{
	constexpr float Q = glm::half_pi<float>();
	const int32_t Tall = MakeIvy(Yard, 61, 6.2f, 2.2f), Short = MakeIvy(Yard, 67, 3.6f, 1.3f);
	// On the face of the corner piers and up the wall above.
	Yard.Builder.AddNode("ivy", Tall, {YardHalf - 0.35f, 0.3f, -YardHalf + 0.31f});
	Yard.Builder.AddNode("ivy", Tall, {-YardHalf + 0.4f, 0.3f, -YardHalf + 0.31f}, 0.0f, {-1, 0.9f, 1});
	Yard.Builder.AddNode("ivy", Short, {YardHalf - 0.31f, 0.3f, -YardHalf + 1.2f}, -Q);
	Yard.Builder.AddNode("ivy", Short, {-YardHalf + 0.31f, 0.3f, 3.6f}, Q);
}

void AddFlowers(const FCourtyard& Yard)
{
	FMeshBuilder Mesh("flower pot");
	AddPot(Yard, Mesh, 0.62f);
	Mesh.BeginSection(Yard.M.Flower);
	AddCrown(Mesh, {0, 0.42f, 0}, {0.24f, 0.20f, 0.24f}, 60, 0.26f, 71);
	const int32_t Pot = Yard.Builder.AddMesh(Mesh);
	constexpr float In = YardHalf - 0.45f;
	for (int I = 0; I < BayCount - 1; ++I)
	{
		const float T = (float(I) - float(BayCount - 2) / 2) * BayWidth;
		Yard.Builder.AddNode("flowers", Pot, {T, GalleryHeight, -In - 0.05f}, float(I));
		Yard.Builder.AddNode("flowers", Pot, {In + 0.05f, GalleryHeight, T}, float(I) + 0.5f);
	}
	FMeshBuilder Box("window box");
	Box.BeginSection(Yard.M.Wood);
	Box.AddBeveledBox({-0.5f, 0, -0.1f}, {0.5f, 0.18f, 0.1f}, 0.01f);
	Box.BeginSection(Yard.M.Flower);
	AddCrown(Box, {0, 0.2f, 0}, {0.46f, 0.14f, 0.12f}, 90, 0.22f, 73);
	const int32_t BoxMesh = Yard.Builder.AddMesh(Box);
	for (int I = 0; I < BayCount; I += 2)
	{
		const float T = (float(I) - float(BayCount - 1) / 2) * BayWidth;
		Yard.Builder.AddNode("window box", BoxMesh, {T, ArcadeTop + 0.95f, -YardHalf + 0.12f});
	}
}

void AddFallenLeaves(const FCourtyard& Yard)
{
	FMeshBuilder Mesh("fallen leaves");
	Mesh.BeginSection(Yard.M.Leaves);
	FRandomStream Random(83);
	for (int I = 0; I < 26; ++I)
	{
		const float Angle = Random.Between(0, glm::two_pi<float>());
		const glm::vec3 Up(std::cos(Angle), Random.Between(0.02f, 0.15f), std::sin(Angle));
		Mesh.SetColor({1.0f, Random.Between(0.4f, 0.8f), 0.4f});
		AddCard(Mesh, {Random.Between(-1.1f, 1.1f), 0.012f, Random.Between(-1.1f, 1.1f)}, glm::normalize(Up), {0, 1, 0},
		    Random.Between(0.10f, 0.2f), {0, 1, 0});
	}
	const int32_t Leaves = Yard.Builder.AddMesh(Mesh);
	const glm::vec2 Places[] = {{-5.0f, -4.6f}, {5.0f, -4.4f}, {-4.6f, 4.2f}, {2.4f, -5.6f}, {3.8f, 4.2f}, {-1.5f, 3.2f}};
	for (int I = 0; I < 6; ++I) { Yard.Builder.AddNode("fallen leaves", Leaves, {Places[I].x, 0, Places[I].y}, float(I) * 1.1f); }
}

} // namespace

void BuildPlants(const FCourtyard& Yard)
{
	AddTrees(Yard);
	AddCypresses(Yard);
	AddIvy(Yard);
	AddFlowers(Yard);
	AddFallenLeaves(Yard);
}

} // namespace Lantern::Builtin
