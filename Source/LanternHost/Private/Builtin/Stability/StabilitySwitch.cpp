// A room with one lamp that is switched on and off.
#include "Builtin/Stability/StabilityParts.h"
#include "Builtin/Stability/StabilityRoom.h"
#include "Builtin/Stability/StabilityScenes.h"

namespace Lantern::Builtin
{

FSceneDescription BuildStabilitySwitch(float Period)
{
	FSceneBuilder Builder("stability-switch");
	AddRoom(Builder, AddPaint(Builder, "wall", {0.7f, 0.68f, 0.62f}, 0.7f), {-4, 0, -2.5f}, {4, 2.8f, 2.5f});
	AddBoxNode(Builder, "partition", AddPaint(Builder, "partition", {0.7f, 0.35f, 0.25f}, 0.7f), {0.4f, 0, -2.5f}, {0.6f, 2.8f, 1.0f});
	const int32_t Block = AddPaint(Builder, "block", {0.3f, 0.45f, 0.65f}, 0.5f);
	AddBoxNode(Builder, "near block", Block, {-2.4f, 0, -1.6f}, {-1.4f, 1.1f, -0.6f});
	AddBoxNode(Builder, "far block", Block, {1.9f, 0, -1.4f}, {2.7f, 0.8f, -0.6f});
	// With an extent: what has no chance in it is not accumulated.
	constexpr float Radius = 0.08f, Candela = 25.0f;
	Builder.AddPointLight("lamp", {-2.2f, 2.4f, 0.5f}, glm::vec3(Candela / (3.14159265f * Radius * Radius)));
	Builder.Scene.Lights.back().Type = LIGHT_SPHERE;
	Builder.Scene.Lights.back().Size = {Radius, 0};
	AddFlicker(Builder, 1.0f / Period, 0.0f);
	Builder.AddCamera({0.5, 1.7, 2.4}, {0.45, 0.8, -1.5}, 85);
	SetDarkness(Builder, -2.0f);
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
