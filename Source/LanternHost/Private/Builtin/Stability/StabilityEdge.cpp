// A table edge between sun and darkness, seen from any distance.
#include "Builtin/Stability/StabilityParts.h"
#include "Builtin/Stability/StabilityScenes.h"

namespace Lantern::Builtin
{

FSceneDescription BuildStabilityEdge(float Distance)
{
	FSceneBuilder Builder("stability-edge");
	AddGround(Builder, Builder.AddLambert("ground", glm::vec3(0.04f)), 400.0f, -17.0f);
	AddBoxNode(Builder, "top", Builder.AddLambert("table", {0.7f, 0.6f, 0.45f}), {-1.2f, 0, -1.2f}, {1.2f, 0.25f, 0});
	AddBoxNode(Builder, "mast", Builder.AddLambert("mast", glm::vec3(0.1f)), {-0.1f, -17, -0.7f}, {0.1f, 0, -0.5f});
	Builder.AddCamera(double(Distance) * glm::normalize(glm::dvec3(0.15, -0.27, 1)), {0, 0, 0}, 45);
	Builder.SetLight({-0.2f, -0.6f, -1}, 4.0f, glm::vec3(0));
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
