// A long street that the camera flies through at 200 m/s.
#include <algorithm>

#include "Builtin/Random.h"
#include "Builtin/Stability/StabilityParts.h"
#include "Builtin/Stability/StabilityScenes.h"

namespace Lantern::Builtin
{

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
