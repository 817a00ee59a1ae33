// A corridor that light enters by one door alone.
#include "Builtin/Stability/StabilityParts.h"
#include "Builtin/Stability/StabilityRoom.h"
#include "Builtin/Stability/StabilityScenes.h"

namespace Lantern::Builtin
{

FSceneDescription BuildStabilityDoor()
{
	FSceneBuilder Builder("stability-door");
	const int32_t Plaster = AddPaint(Builder, "plaster", {0.75f, 0.72f, 0.66f}, 0.7f);
	constexpr float DoorX = -3.0f, Half = 0.6f, Top = 2.2f;
	AddRoom(Builder, Plaster, {-6, 0, -1}, {6, 2.6f, 1}, {EOpening::Back, DoorX, Half, 0, Top});
	AddRoom(Builder, Plaster, {-6, 0, -5.4f}, {0, 2.6f, -1.4f}, {EOpening::Front, DoorX, Half, 0, Top});
	AddBoxNode(Builder, "door", AddPaint(Builder, "door", {0.4f, 0.3f, 0.2f}, 0.5f), {DoorX - Half - 0.1f, -0.1f, -1.23f},
	    {DoorX + Half + 0.1f, Top + 0.1f, -1.17f});
	AddBoxNode(Builder, "crate", AddPaint(Builder, "crate", {0.3f, 0.45f, 0.65f}, 0.5f), {2.2f, 0, -0.9f}, {3.0f, 0.8f, -0.2f});
	// Beside the door, so that what it shines on lights the corridor, and it itself does not.
	constexpr float Radius = 0.08f, Candela = 120.0f;
	Builder.AddPointLight("lamp", {-0.6f, 2.2f, -2.0f}, glm::vec3(Candela / (3.14159265f * Radius * Radius)));
	Builder.Scene.Lights.back().Type = LIGHT_SPHERE;
	Builder.Scene.Lights.back().Size = {Radius, 0};
	Builder.AddCamera({-5.2, 1.6, 0.4}, {-2.4, 0.8, 1.0}, 70);
	SetDarkness(Builder, 0.0f);
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
