// A turning fan over a floor: moving shadows.
#include <cmath>

#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>

#include "Builtin/Stability/StabilityParts.h"
#include "Builtin/Stability/StabilityScenes.h"

namespace Lantern::Builtin
{

FSceneDescription BuildStabilityFan(bool bLamp)
{
	FSceneBuilder Builder("stability-fan");
	AddGround(Builder, AddPaint(Builder, "floor", glm::vec3(0.6f), 0.3f), 12.0f);
	FMeshBuilder Fan("fan");
	Fan.BeginSection(AddPaint(Builder, "blade", {0.3f, 0.3f, 0.35f}, 0.5f));
	for (int I = 0; I < 4; ++I)
	{
		Fan.SetTransform(glm::mat4_cast(glm::angleAxis(glm::half_pi<float>() * float(I), glm::vec3(0, 1, 0))));
		Fan.AddBox({0.1f, -0.01f, -0.16f}, {1.1f, 0.01f, 0.16f});
	}
	const int32_t Node = Builder.AddNode("fan", Builder.AddMesh(Fan), {0, 1.6f, 0});
	std::vector<glm::vec4> Turns;
	for (int I = 0; I <= 4; ++I)
	{
		Turns.emplace_back(0, std::sin(glm::pi<float>() * float(I) / 4), 0, std::cos(glm::pi<float>() * float(I) / 4));
	}
	AddKeys(Builder, Node, EAnimationPath::Rotation, 1.0f, std::move(Turns));
	Builder.AddCamera({0, 1.3, 2.4}, {0, 0, 0.1}, 60);
	Builder.SetLight({0.05f, -1, 0.1f}, 4.0f, {0.3f, 0.4f, 0.6f});
	Builder.Scene.DefaultSunDiameter = 2.0f;
	if (bLamp) { LightByLamp(Builder, {0, 0, 0}, 10.0f); }
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
