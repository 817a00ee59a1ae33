// Smooth light over a floor and a corner, in which seams show.
#include "Builtin/Stability/StabilityParts.h"
#include "Builtin/Stability/StabilityScenes.h"

namespace Lantern::Builtin
{

FSceneDescription BuildStabilitySeams()
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
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
