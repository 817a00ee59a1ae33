// A room with three walls of mirrors and one lamp: light that leaves a mirror must not be cut short.
#include "Builtin/Stability/StabilityParts.h"
#include "Builtin/Stability/StabilityRoom.h"
#include "Builtin/Stability/StabilityScenes.h"

namespace Lantern::Builtin
{

FSceneDescription BuildStabilityMirrorRoom(float Brightness)
{
	FSceneBuilder Builder("stability-mirrorroom");
	AddRoom(Builder, AddPaint(Builder, "plaster", {0.7f, 0.66f, 0.6f}, 0.7f), {-3, 0, -3}, {3, 2.8f, 3});
	const int32_t Silver = AddMetal(Builder, "silver", glm::vec3(0.9f), 0.0f);
	AddBoxNode(Builder, "left mirror", Silver, {-3, 0.1f, -2.9f}, {-2.95f, 2.7f, 2.9f});
	AddBoxNode(Builder, "right mirror", Silver, {2.95f, 0.1f, -2.9f}, {3, 2.7f, 2.9f});
	AddBoxNode(Builder, "back mirror", Silver, {-2.9f, 0.1f, -3}, {2.9f, 2.7f, -2.95f});
	AddBoxNode(Builder, "red block", AddPaint(Builder, "red", {0.7f, 0.25f, 0.15f}, 0.5f), {-1.6f, 0, -1.4f}, {-0.7f, 1.2f, -0.5f});
	AddBoxNode(Builder, "blue block", AddPaint(Builder, "blue", {0.2f, 0.3f, 0.65f}, 0.5f), {0.6f, 0, -0.6f}, {1.6f, 0.7f, 0.4f});
	constexpr float Radius = 0.15f, Candela = 30.0f;
	Builder.AddPointLight("lamp", {0.2f, 2.2f, 0.8f}, glm::vec3(Brightness * Candela / (3.14159265f * Radius * Radius)));
	Builder.Scene.Lights.back().Type = LIGHT_SPHERE;
	Builder.Scene.Lights.back().Size = {Radius, 0};
	Builder.AddCamera({-0.6, 1.6, 2.6}, {0.3, 0.9, -2}, 70);
	SetDarkness(Builder, -2.0f);
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
