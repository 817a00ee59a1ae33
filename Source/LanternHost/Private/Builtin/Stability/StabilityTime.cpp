// Blocks on a plain under a sun that may move.
#include <cmath>

#include "Builtin/Random.h"
#include "Builtin/Stability/StabilityParts.h"
#include "Builtin/Stability/StabilityScenes.h"

namespace Lantern::Builtin
{

FSceneDescription BuildStabilityTime()
{
	FSceneBuilder Builder("stability-time");
	AddGround(Builder, AddPaint(Builder, "ground", glm::vec3(0.5f), 0.5f), 60.0f);
	const int32_t Materials[] = {AddPaint(Builder, "plaster", {0.8f, 0.75f, 0.7f}, 0.7f),
	    AddPaint(Builder, "brick", {0.6f, 0.3f, 0.2f}, 0.6f), AddPaint(Builder, "slate", {0.3f, 0.35f, 0.4f}, 0.3f)};
	FRandomStream Random(5);
	for (int I = 0; I < 9; ++I)
	{
		const glm::vec3 At(float(I % 3) * 3.0f - 3.0f, 0, float(I / 3) * 3.0f - 3.0f);
		const float Height = Random.Between(0.5f, 2.0f), Half = Random.Between(0.3f, 0.7f);
		AddBoxNode(Builder, "block", Materials[I % 3], At - glm::vec3(Half, 0, Half), At + glm::vec3(Half, Height, Half));
	}
	Builder.AddCamera({2, 7, 9}, {0, 0, 0}, 50);
	// Little sky: what is indirect comes from the sun, too.
	Builder.SetLight({-0.5f, -std::sqrt(3.0f) / 2, 0}, 4.0f, {0.015f, 0.02f, 0.03f});
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
