// A dark hall with 24 tiny emitters.
#include <cmath>

#include "Builtin/Stability/StabilityParts.h"
#include "Builtin/Stability/StabilityScenes.h"

namespace Lantern::Builtin
{

FSceneDescription BuildStabilityCandles()
{
	FSceneBuilder Builder("stability-candles");
	FMeshBuilder Hall("hall");
	Hall.BeginSection(AddPaint(Builder, "stone", {0.6f, 0.55f, 0.5f}, 0.6f));
	Hall.AddBox({-4, 0, -6}, {4, 3.5f, 6}, true);
	Builder.AddNode("hall", Builder.AddMesh(Hall));
	const int32_t Wood = AddPaint(Builder, "wood", {0.35f, 0.2f, 0.1f}, 0.4f);
	AddBoxNode(Builder, "table", Wood, {-1, 0.9f, -4}, {1, 1, 2});
	FMeshBuilder Flame("flame");
	Flame.BeginSection(Builder.AddLambert("flame", glm::vec3(0), {40'000.0f, 28'000.0f, 12'000.0f}));
	const float Half = 0.5f * std::sqrt(1e-4f / 6.0f); // six faces: 1 cm²
	Flame.AddBox(glm::vec3(-Half), glm::vec3(Half));
	const int32_t FlameMesh = Builder.AddMesh(Flame);
	for (int I = 0; I < 24; ++I) { Builder.AddNode("candle", FlameMesh, {I % 2 ? 0.6f : -0.6f, 1.25f, -3.8f + 0.5f * float(I / 2)}); }
	Builder.AddCamera({2.5, 2, 5}, {-0.5, 1, -2}, 60);
	Builder.SetLight({0, -1, 0}, 0.0f, glm::vec3(0));
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
