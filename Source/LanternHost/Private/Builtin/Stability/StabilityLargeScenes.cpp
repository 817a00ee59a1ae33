// Scenes too large for tables of a fixed size.
#include <cmath>

#include <glm/gtc/constants.hpp>

#include "Builtin/Random.h"
#include "Builtin/Stability/StabilityLaterScenes.h"
#include "Builtin/Stability/StabilityParts.h"

namespace Lantern::Builtin
{

namespace
{

constexpr float LandSize = 2000.0f;
constexpr uint32_t LandCells = 160;

float LandHeight(float X, float Z)
{
	return 14.0f * std::sin(X * 0.011f) * std::cos(Z * 0.013f) + 3.0f * std::sin(X * 0.05f + 1) * std::sin(Z * 0.043f);
}

int32_t AddLand(FSceneBuilder& Builder)
{
	FMeshBuilder Mesh("land");
	Mesh.BeginSection(AddPaint(Builder, "grass", {0.3f, 0.4f, 0.18f}, 0.9f));
	constexpr float Cell = LandSize / float(LandCells);
	for (uint32_t J = 0; J <= LandCells; ++J)
	{
		for (uint32_t I = 0; I <= LandCells; ++I)
		{
			const float X = -LandSize / 2 + Cell * float(I), Z = -LandSize / 2 + Cell * float(J);
			const glm::vec3 Normal(LandHeight(X - 1, Z) - LandHeight(X + 1, Z), 2, LandHeight(X, Z - 1) - LandHeight(X, Z + 1));
			Mesh.AddVertex({X, LandHeight(X, Z), Z}, glm::normalize(Normal), {X, Z});
		}
	}
	for (uint32_t J = 0; J < LandCells; ++J)
	{
		for (uint32_t I = 0; I < LandCells; ++I)
		{
			const uint32_t A = J * (LandCells + 1) + I, B = A + 1, C = A + LandCells + 1;
			Mesh.AddTriangle(A, C, B);
			Mesh.AddTriangle(B, C, C + 1);
		}
	}
	return Builder.AddMesh(Mesh);
}

} // namespace

FSceneDescription BuildStabilityHugeMesh()
{
	constexpr int Kinds = 40, Count = 2000;
	FSceneBuilder Builder("stability-hugemesh");
	const int32_t Land = AddLand(Builder);
	Builder.AddNode("land", Land);
	FRandomStream Random(15);
	std::vector<int32_t> Meshes;
	for (int I = 0; I < Kinds; ++I)
	{
		const glm::vec3 Color{Random.Between(0.2f, 0.8f), Random.Between(0.2f, 0.7f), Random.Between(0.2f, 0.6f)};
		FMeshBuilder Mesh("thing");
		Mesh.BeginSection(AddPaint(Builder, "thing", Color, Random.Between(0.3f, 0.9f)));
		const glm::vec3 Half{Random.Between(0.2f, 0.6f), Random.Between(0.3f, 1.1f), Random.Between(0.2f, 0.6f)};
		if (I % 3 == 0) { Mesh.AddSphere({0, Half.y, 0}, Half.y, 2); }
		else { Mesh.AddBeveledBox({-Half.x, -0.3f, -Half.z}, {Half.x, 2 * Half.y, Half.z}, 0.06f); }
		Meshes.push_back(Builder.AddMesh(Mesh));
	}
	for (int I = 0; I < Count; ++I)
	{
		// Denser towards the middle, where the camera is: some 180 within 50 m.
		const float Radius = 5.0f + 900.0f * std::pow(Random.NextFloat(), 1.25f), Angle = Random.Between(0, glm::two_pi<float>());
		const float X = Radius * std::cos(Angle), Z = Radius * std::sin(Angle);
		const float Yaw = Random.Between(0, glm::two_pi<float>()), Scale = Random.Between(0.6f, 1.6f);
		Builder.AddNode("thing", Meshes[size_t(I % Kinds)], {X, LandHeight(X, Z), Z}, Yaw, glm::vec3(Scale));
	}
	const double Ground = double(LandHeight(0, 0));
	Builder.AddCamera({0, Ground + 3.5, 0}, {14, Ground + 1.5, -20}, 60);
	Builder.SetLight({0.5f, -0.8f, 0.35f}, 4.0f, {0.45f, 0.6f, 0.9f});
	return std::move(Builder.Scene);
}

FSceneDescription BuildStabilityHash()
{
	constexpr float Length = 2000.0f, Block = 12.5f;
	FSceneBuilder Builder("stability-hash");
	FRandomStream Random(16);
	FMeshBuilder Road("road");
	Road.BeginSection(AddPaint(Builder, "road", glm::vec3(0.25f), 0.7f));
	for (float Z = 100; Z > -Length - 200; Z -= 100) { Road.AddQuad({-60, 0, Z}, {60, 0, Z}, {60, 0, Z - 100}, {-60, 0, Z - 100}); }
	Builder.AddNode("road", Builder.AddMesh(Road));
	std::vector<int32_t> Walls;
	for (int I = 0; I < 12; ++I)
	{
		const glm::vec3 Color{Random.Between(0.25f, 0.85f), Random.Between(0.25f, 0.8f), Random.Between(0.2f, 0.7f)};
		Walls.push_back(AddPaint(Builder, "wall", Color, Random.Between(0.3f, 0.9f)));
	}
	for (float Z = 50; Z > -Length - 150; Z -= Block)
	{
		for (const float Side : {-1.0f, 1.0f})
		{
			const float Near = Side * Random.Between(5.0f, 9.0f), Far = Side * Random.Between(14.0f, 30.0f);
			const glm::vec3 Min(std::min(Near, Far), 0, Z - Block * Random.Between(0.6f, 0.95f)),
			    Max(std::max(Near, Far), Random.Between(4.0f, 26.0f), Z);
			AddBoxNode(Builder, "block", Walls[size_t(Random.NextFloat() * 11.99f)], Min, Max);
		}
	}
	Builder.AddCamera({0, 5, 0}, {0, 4.6, -10}, 70);
	const auto Camera = int32_t(Builder.Scene.Nodes.size() - 1);
	AddKeys(Builder, Camera, EAnimationPath::Translation, 10.0f, {{0, 5, 0, 0}, {0, 5, -Length, 0}});
	Builder.SetLight({0.6f, -0.9f, 0.3f}, 4.0f, {0.45f, 0.6f, 0.9f});
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
