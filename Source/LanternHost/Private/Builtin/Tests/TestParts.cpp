// Floors, emitters and cameras of the scenes in closed form.
#include "Builtin/Tests/TestParts.h"

namespace Lantern::Builtin
{

void AddFloor(FSceneBuilder& Builder, float Albedo)
{
	FMeshBuilder Mesh("floor");
	constexpr float S = FloorSize / 2;
	Mesh.BeginSection(Builder.AddLambert("floor", glm::vec3(Albedo)));
	Mesh.AddQuad({-S, 0, S}, {S, 0, S}, {S, 0, -S}, {-S, 0, -S});
	Builder.AddNode("floor", Builder.AddMesh(Mesh));
}

int32_t AddEmitter(FSceneBuilder& Builder) { return Builder.AddLambert("emitter", glm::vec3(0), glm::vec3(1)); }

void AddPointCamera(FSceneBuilder& Builder, const glm::dvec3& Point)
{
	Builder.AddCamera(Point + glm::dvec3(0, 0.3, 0.6), Point, PointFov);
}

void Darken(FSceneBuilder& Builder) { Builder.SetLight(Down, 0.0f, glm::vec3(0)); }

} // namespace Lantern::Builtin
