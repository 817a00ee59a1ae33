// A hall with 32 flickering lamps.
#include "Builtin/Stability/StabilityParts.h"
#include "Builtin/Stability/StabilityRoom.h"
#include "Builtin/Stability/StabilityScenes.h"

namespace Lantern::Builtin
{

FSceneDescription BuildStabilityFlicker()
{
	FSceneBuilder Builder("stability-flicker");
	AddRoom(Builder, AddPaint(Builder, "wall", glm::vec3(0.6f), 0.6f), {-8, 0, -4}, {8, 3.2f, 4});
	const int32_t Column = AddPaint(Builder, "column", {0.6f, 0.5f, 0.4f}, 0.4f);
	for (int I = 0; I < 6; ++I)
	{
		const glm::vec3 At(-6.5f + 2.6f * float(I), 0, I % 2 ? 1.1f : -1.4f);
		AddBoxNode(Builder, "column", Column, At - glm::vec3(0.2f, 0, 0.2f), At + glm::vec3(0.2f, 3.2f, 0.2f));
	}
	for (int I = 0; I < 32; ++I)
	{
		const int X = I % 8, Z = I / 8;
		const bool bFast = (X + Z) % 2 == 1;
		const glm::vec3 Color = bFast ? glm::vec3(1.5f, 2.2f, 3.0f) : glm::vec3(3.0f, 2.0f, 1.2f);
		Builder.AddPointLight("lamp", {-7.0f + 2.0f * float(X), 2.7f, -3.0f + 2.0f * float(Z)}, Color);
		// Eight phases: their sum hardly changes, what each lights does.
		AddFlicker(Builder, bFast ? 15.0f : 5.0f, float((X * 3 + Z) % 8) / 8.0f);
	}
	Builder.AddCamera({-7.2, 1.7, 3.4}, {1.5, 0.9, -1.2}, 65);
	SetDarkness(Builder, -1.5f);
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
