// A chamber that the sun reaches only by five bounces.
#include "Builtin/Stability/StabilityParts.h"
#include "Builtin/Stability/StabilityRoom.h"
#include "Builtin/Stability/StabilityScenes.h"

namespace Lantern::Builtin
{

FSceneDescription BuildStabilityTemple()
{
	FSceneBuilder Builder("stability-temple");
	const int32_t Stone = Builder.AddLambert("stone", glm::vec3(0.85f));
	AddGround(Builder, Builder.AddLambert("sand", {0.6f, 0.5f, 0.35f}), 60.0f, -0.25f);
	// Light enters at the front, goes round the inner room to its door at the back, and then past a screen. No straight line takes
	// any of these corners.
	AddRoom(Builder, Stone, {-5.2f, 0, -5.2f}, {5.2f, 4.6f, 5.2f}, {EOpening::Front, 0, 2.2f, 0, 4.2f});
	AddRoom(Builder, Stone, {-3, 0.2f, -3}, {3, 3.8f, 3}, {EOpening::Back, -1.3f, 1.2f, 0.2f, 3.4f});
	AddBoxNode(Builder, "screen", Stone, {-3.1f, 0.1f, -1.4f}, {1.7f, 3.9f, -1.2f});
	AddBoxNode(Builder, "altar", Builder.AddLambert("altar", {0.75f, 0.35f, 0.25f}), {-1.4f, 0.2f, 0.6f}, {-0.4f, 1.2f, 1.4f});
	Builder.AddCamera({2.4, 1.9, 0.0}, {-1.2, 1.1, 1.8}, 65);
	Builder.SetLight({0.1f, -0.7f, -1}, 8.0f, glm::vec3(0));
	Builder.Scene.DefaultExposure = 9.0f;
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
