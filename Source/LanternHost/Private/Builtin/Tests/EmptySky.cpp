// Nothing but sky.
#include "Builtin/SceneBuilder.h"
#include "Builtin/Tests/TestScenes.h"

namespace Lantern::Builtin
{

FSceneDescription BuildEmptySky()
{
	FSceneBuilder Builder("emptysky");
	Builder.AddLambert("unused", glm::vec3(0.5f));
	Builder.AddCamera({0, 0, 0}, {0, 0, -1}, 60);
	Builder.SetLight({0.25f, -1, 0.35f}, 4.0f, {0.5f, 0.7f, 1.0f});
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
