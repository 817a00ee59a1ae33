// A plane on which all pixels are alike.
#include "Builtin/Stability/StabilityParts.h"
#include "Builtin/Stability/StabilityScenes.h"

namespace Lantern::Builtin
{

FSceneDescription BuildStabilityFlat(bool bMetal)
{
	FSceneBuilder Builder("stability-flat");
	AddGround(Builder, bMetal ? AddMetal(Builder, "mirror", glm::vec3(1), 0.0f) : Builder.AddLambert("grey", glm::vec3(0.5f)), 1000.0f);
	Builder.AddCamera({0, 2, 0}, {0, 0, -0.4}, 60);
	Builder.SetLight({0.3f, -1, -0.3f}, 4.0f, glm::vec3(1));
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
