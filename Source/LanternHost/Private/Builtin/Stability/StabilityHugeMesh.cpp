// One mesh of 2 km with 2,000 small ones on it.
#include <cmath>

#include <glm/gtc/constants.hpp>

#include "Builtin/Random.h"
#include "Builtin/Stability/StabilityParts.h"
#include "Builtin/Stability/StabilityScenes.h"

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

} // namespace Lantern::Builtin
