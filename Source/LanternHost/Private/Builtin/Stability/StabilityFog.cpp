// A dark hall with a shaft of sun and a sealed chamber.
#include "Builtin/Stability/StabilityParts.h"
#include "Builtin/Stability/StabilityRoom.h"
#include "Builtin/Stability/StabilityScenes.h"

namespace Lantern::Builtin
{

FSceneDescription BuildStabilityFog()
{
	FSceneBuilder Builder("stability-fog");
	const int32_t Wall = Builder.AddLambert("wall", glm::vec3(0.3f));
	AddRoom(Builder, Wall, {-4, 0, -6}, {4, 5, 6}, {EOpening::Front, -1.5f, 0.8f, 2.6f, 4.4f});
	// From wall to wall: what is behind it is sealed.
	AddBoxNode(Builder, "inner wall", Wall, {1.6f, -0.1f, -6.1f}, {1.8f, 5.1f, 6.1f});
	AddBoxNode(Builder, "block", Wall, {-2.6f, 0, -2.6f}, {-1.2f, 1.2f, -1.2f});
	FMeshBuilder Board("board");
	Board.BeginSection(Builder.AddLambert("board", {0.35f, 0.25f, 0.15f}));
	Board.AddBox({-0.5f, -1.2f, -0.05f}, {0.5f, 1.2f, 0.05f});
	const glm::vec3 From(-3.2f, 3.5f, 6.6f), To(0.2f, 3.5f, 6.6f);
	const int32_t Node = Builder.AddNode("board", Builder.AddMesh(Board), From);
	AddKeys(Builder, Node, EAnimationPath::Translation, 2.0f, {glm::vec4(From, 0), glm::vec4(To, 0), glm::vec4(From, 0)});
	Builder.AddCamera({0.9, 1.6, -5.4}, {-1.6, 2.0, 2.5}, 75);
	Builder.SetLight({0.05f, -0.55f, -1}, 30.0f, glm::vec3(0.2f));
	Builder.Scene.DefaultExposure = 2.5f;
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
