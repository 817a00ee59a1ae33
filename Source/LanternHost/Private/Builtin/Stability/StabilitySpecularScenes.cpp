// Scenes of mirrors, glints and caustics.
#include <cmath>

#include <glm/gtc/constants.hpp>

#include "Builtin/Stability/StabilityLaterScenes.h"
#include "Builtin/Stability/StabilityParts.h"

namespace Lantern::Builtin
{

FSceneDescription BuildStabilityMirror()
{
	FSceneBuilder Builder("stability-mirror");
	AddGround(Builder, AddPaint(Builder, "floor", glm::vec3(0.45f), 0.5f), 14.0f);
	const int32_t Light = AddPaint(Builder, "light stripe", {0.7f, 0.65f, 0.55f}, 0.6f),
	              Dark = AddPaint(Builder, "dark stripe", {0.2f, 0.25f, 0.35f}, 0.6f);
	AddStripes(Builder, "wall behind", Light, Dark, {0, 1.5f, 4.5f}, {0, 0, -1}, 14.0f, 3.0f, 0.5f);
	AddBoxNode(Builder, "wall", AddPaint(Builder, "wall", {0.5f, 0.45f, 0.4f}, 0.7f), {-4, 0, -2.4f}, {4, 3.2f, -2.1f});
	const int32_t Silver = AddMetal(Builder, "silver", glm::vec3(0.95f), 0.0f);
	AddBoxNode(Builder, "mirror", Silver, {-2.8f, 0.5f, -2.1f}, {0.0f, 2.5f, -2.05f});
	FMeshBuilder Ball("ball");
	Ball.BeginSection(Silver);
	Ball.AddSphere(glm::vec3(0), 0.9f, 5);
	Builder.AddNode("convex mirror", Builder.AddMesh(Ball), {1.4f, 1.1f, -1.1f});
	FMeshBuilder Cube("mover");
	Cube.BeginSection(AddPaint(Builder, "mover", {0.9f, 0.35f, 0.1f}, 0.5f));
	Cube.AddBox(glm::vec3(-0.3f), glm::vec3(0.3f));
	const glm::vec4 From(-3, 0.7f, 0.6f, 0), To(3, 0.7f, 0.6f, 0);
	const int32_t Node = Builder.AddNode("mover", Builder.AddMesh(Cube), glm::vec3(From));
	AddKeys(Builder, Node, EAnimationPath::Translation, 1.5f, {From, To});
	Builder.AddCamera({0, 1.7, 3.6}, {-0.2, 1.2, -2}, 50);
	Builder.SetLight({-0.3f, -1, -0.35f}, 4.0f, {0.5f, 0.7f, 1.0f});
	Builder.Scene.DefaultSunDiameter = 1.0f;
	Builder.Scene.DefaultExposure = -0.7f;
	return std::move(Builder.Scene);
}

FSceneDescription BuildStabilityRailing(float Rows)
{
	constexpr float Distance = 6.0f, FovY = 40.0f;
	// Of a pixel at the railing's distance.
	const float Width = 2.0f * Distance * std::tan(glm::radians(FovY) / 2) / Rows;
	FSceneBuilder Builder("stability-railing");
	AddGround(Builder, AddPaint(Builder, "floor", {0.35f, 0.33f, 0.3f}, 0.7f), 60.0f);
	AddBoxNode(Builder, "wall", AddPaint(Builder, "wall", {0.12f, 0.14f, 0.18f}, 0.8f), {-8, 0, -5.2f}, {8, 5, -5});
	FMeshBuilder Railing("railing");
	Railing.BeginSection(AddMetal(Builder, "steel", glm::vec3(0.8f), 0.15f));
	const float Radius[2] = {Width / 2, Width / 2};
	const auto AddBar = [&](const glm::vec3& From, const glm::vec3& To) {
		const glm::vec3 Path[2] = {From, To};
		Railing.AddTube(Path, Radius, 12);
	};
	for (int I = -22; I <= 22; ++I)
	{
		// A little out of plumb, as no real one is exact: bars cross columns of pixels.
		const float X = 0.16f * float(I);
		AddBar({X, 0, 0}, {X + 0.02f * std::sin(float(I)), 1.9f, 0});
	}
	for (const float Y : {0.2f, 1.1f, 1.9f}) { AddBar({-3.8f, Y, 0}, {3.8f, Y, 0}); }
	Builder.AddNode("railing", Builder.AddMesh(Railing));
	Builder.AddCamera({0, 1.4, double(Distance)}, {0, 1.15, 0}, FovY);
	Builder.SetLight({-0.3f, -0.8f, -0.6f}, 4.0f, {0.25f, 0.35f, 0.5f});
	return std::move(Builder.Scene);
}

namespace
{

constexpr float WaveLength = 1.2f, WaveHeight = 0.018f;

/// y = a(sin kx + sin kz), larger than the pool by the wavelength that it travels.
void AddWaves(FSceneBuilder& Builder, int32_t Material, float Size)
{
	constexpr float K = glm::two_pi<float>() / WaveLength;
	const float Half = Size / 2 + WaveLength;
	const auto Count = uint32_t(2 * Half / (WaveLength / 24));
	FMeshBuilder Mesh("waves");
	Mesh.BeginSection(Material);
	for (uint32_t J = 0; J <= Count; ++J)
	{
		for (uint32_t I = 0; I <= Count; ++I)
		{
			const float X = -Half + 2 * Half * float(I) / float(Count), Z = -Half + 2 * Half * float(J) / float(Count);
			const glm::vec3 Normal(-WaveHeight * K * std::cos(K * X), 1, -WaveHeight * K * std::cos(K * Z));
			Mesh.AddVertex({X, WaveHeight * (std::sin(K * X) + std::sin(K * Z)), Z}, glm::normalize(Normal), {X, Z});
		}
	}
	for (uint32_t J = 0; J < Count; ++J)
	{
		for (uint32_t I = 0; I < Count; ++I)
		{
			const uint32_t A = J * (Count + 1) + I, B = A + 1, C = A + Count + 1, D = C + 1;
			Mesh.AddTriangle(A, C, B);
			Mesh.AddTriangle(B, C, D);
		}
	}
	// Starts half a wavelength off: the travel is centred on the pool.
	const glm::vec4 From(-WaveLength / 2, 0, 1.4f - WaveLength / 2, 0), To(WaveLength / 2, 0, 1.4f + WaveLength / 2, 0);
	const int32_t Node = Builder.AddNode("waves", Builder.AddMesh(Mesh), glm::vec3(From));
	AddKeys(Builder, Node, EAnimationPath::Translation, 1.5f, {From, To});
}

} // namespace

FSceneDescription BuildStabilityCaustics()
{
	FSceneBuilder Builder("stability-caustics");
	const int32_t Stone = Builder.AddLambert("stone", glm::vec3(0.6f));
	constexpr float Pool = 3.0f;
	AddWaves(Builder, AddMetal(Builder, "liquid metal", glm::vec3(0.9f), 0.0f), Pool);
	// A rim wide enough for the waves' mesh to pass under.
	constexpr float X = Pool / 2, Z0 = 1.4f - Pool / 2, Z1 = 1.4f + Pool / 2;
	AddBoxNode(Builder, "rim", Stone, {-X - 2.5f, -0.3f, Z0 - 2.5f}, {X + 2.5f, 0.06f, Z0});
	AddBoxNode(Builder, "rim", Stone, {-X - 2.5f, -0.3f, Z1}, {X + 2.5f, 0.06f, Z1 + 2.5f});
	AddBoxNode(Builder, "rim", Stone, {-X - 2.5f, -0.3f, Z0}, {-X, 0.06f, Z1});
	AddBoxNode(Builder, "rim", Stone, {X, -0.3f, Z0}, {X + 2.5f, 0.06f, Z1});
	AddBoxNode(Builder, "wall", Stone, {-3.5f, 0, -1.4f}, {3.5f, 3, -1.2f});
	AddBoxNode(Builder, "roof", Stone, {-3.5f, 3, -1.4f}, {3.5f, 3.15f, 2});
	Builder.AddCamera({0.4, 1.5, 4.6}, {0, 1.3, -1.2}, 50);
	Builder.SetLight({0, -0.7f, -1}, 8.0f, glm::vec3(0.02f));
	// Paths find the sun in the mirror by chance alone: as large as the pattern lets it be.
	Builder.Scene.DefaultSunDiameter = 4.0f;
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
