// A hall with 640 lamps in which nothing moves.
#include "Builtin/Random.h"
#include "Builtin/Stability/StabilityParts.h"
#include "Builtin/Stability/StabilityRoom.h"
#include "Builtin/Stability/StabilityScenes.h"

namespace Lantern::Builtin
{

FSceneDescription BuildStabilityBoiling()
{
	FSceneBuilder Builder("stability-boiling");
	AddRoom(Builder, AddPaint(Builder, "wall", glm::vec3(0.55f), 0.5f), {-20, 0, -8}, {20, 5, 8});
	const int32_t Column = AddPaint(Builder, "column", glm::vec3(0.6f), 0.35f);
	for (int I = 0; I < 27; ++I)
	{
		const glm::vec3 At(-18.0f + 4.5f * float(I % 9), 0, -5.0f + 5.0f * float(I / 9));
		AddBoxNode(Builder, "column", Column, At - glm::vec3(0.35f, 0, 0.35f), At + glm::vec3(0.35f, 5, 0.35f));
	}
	FRandomStream Random(640);
	for (int I = 0; I < 640; ++I)
	{
		const glm::vec3 At{-19.5f + float(I % 40) + Random.Between(-0.3f, 0.3f), Random.Between(0.4f, 4.6f),
		    -7.5f + float(I / 40) + Random.Between(-0.3f, 0.3f)};
		const glm::vec3 Color{Random.Between(0.2f, 1.0f), Random.Between(0.2f, 1.0f), Random.Between(0.2f, 1.0f)};
		Builder.AddPointLight("lamp", At, 0.35f * Color * Random.Between(0.3f, 1.7f));
	}
	Builder.AddCamera({-18.8, 1.9, 7.2}, {2, 1.2, -3}, 60);
	SetDarkness(Builder, -1.0f);
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
