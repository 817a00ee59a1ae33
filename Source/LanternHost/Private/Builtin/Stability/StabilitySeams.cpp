// Smooth light over a floor and a corner, in which seams show.
#include <cmath>

#include "Builtin/Stability/StabilityParts.h"
#include "Builtin/Stability/StabilityScenes.h"

namespace Lantern::Builtin
{

FSceneDescription BuildStabilitySeams(float Lamps)
{
	FSceneBuilder Builder("stability-seams");
	const int32_t Plain = AddPaint(Builder, "plain", glm::vec3(0.6f), 0.5f);
	AddGround(Builder, Plain, 30.0f);
	FMeshBuilder Roof("roof");
	Roof.BeginSection(Plain);
	Roof.AddBox({-12, 4, -12}, {0, 4.2f, 12});
	Builder.AddNode("roof", Builder.AddMesh(Roof));
	AddBoxNode(Builder, "wall", Plain, {-12, 0, -2.2f}, {12, 1.5f, -2});
	Builder.AddCamera({0, 3, 1.5}, {0, 0, -1}, 70);
	Builder.SetLight({0.02f, -1, 0.02f}, 4.0f, {0.5f, 0.7f, 1.0f});
	Builder.Scene.DefaultSunDiameter = 20.0f;
	if (Lamps < 1.0f) { return std::move(Builder.Scene); }
	for (int I = 0; I < 9; ++I)
	{
		const glm::vec3 At(-2.0f + 0.55f * float(I), 0, I % 2 ? -0.2f : -1.1f);
		AddBoxNode(Builder, "rod", Plain, At, At + glm::vec3(0.08f, 0.9f, 0.08f));
	}
	for (int I = 0; I < int(Lamps); ++I)
	{
		Builder.AddPointLight("lamp",
		    {-1.8f + 3.6f * (float(I) + 0.5f) / std::floor(Lamps), 1.6f + 0.2f * float(I % 3), I % 2 ? 0.9f : -1.5f},
		    glm::vec3(2.0f, 1.8f, 1.5f));
	}
	SetDarkness(Builder, -1.0f);
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
