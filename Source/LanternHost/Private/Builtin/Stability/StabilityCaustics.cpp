// A pool of liquid metal that reflects the sun to a wall.
#include <cmath>

#include <glm/gtc/constants.hpp>

#include "Builtin/Stability/StabilityParts.h"
#include "Builtin/Stability/StabilityScenes.h"

namespace Lantern::Builtin
{

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
