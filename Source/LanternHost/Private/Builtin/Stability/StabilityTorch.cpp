// A glowing torch that is carried through a dark corridor.
#include "Builtin/Stability/StabilityParts.h"
#include "Builtin/Stability/StabilityRoom.h"
#include "Builtin/Stability/StabilityScenes.h"

namespace Lantern::Builtin
{

FSceneDescription BuildStabilityTorch()
{
	FSceneBuilder Builder("stability-torch");
	AddRoom(Builder, AddPaint(Builder, "stone", {0.6f, 0.55f, 0.5f}, 0.8f), {-8, 0, -1.5f}, {8, 2.8f, 1.5f});
	const int32_t Pillar = AddPaint(Builder, "pillar", {0.45f, 0.5f, 0.55f}, 0.6f);
	for (int I = -3; I <= 3; ++I)
	{
		const float X = 2.0f * float(I);
		AddBoxNode(Builder, "pillar", Pillar, {X - 0.15f, 0, -1.5f}, {X + 0.15f, 2.8f, -1.2f});
	}
	FMeshBuilder Flame("flame");
	Flame.BeginSection(Builder.AddLambert("flame", glm::vec3(0.3f), {260.0f, 150.0f, 60.0f}));
	Flame.AddBox(glm::vec3(-0.1f), glm::vec3(0.1f));
	const glm::vec4 From(-6, 1.2f, -0.2f, 0), To(6, 1.2f, -0.2f, 0);
	const int32_t Node = Builder.AddNode("torch", Builder.AddMesh(Flame), glm::vec3(From));
	AddKeys(Builder, Node, EAnimationPath::Translation, 2.4f, {From, To});
	Builder.AddCamera({0, 2.3, 1.4}, {0, 0.4, -0.8}, 80);
	SetDarkness(Builder, -2.0f);
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
