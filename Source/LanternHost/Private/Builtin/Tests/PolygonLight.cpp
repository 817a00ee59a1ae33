// A unit square light above a floor.
#include "Builtin/Tests/TestParts.h"
#include "Builtin/Tests/TestScenes.h"

namespace Lantern::Builtin
{

FSceneDescription BuildPolygonLight(float X)
{
	FSceneBuilder Builder("polygonlight");
	AddFloor(Builder, FloorAlbedo);
	FMeshBuilder Mesh("emitter");
	Mesh.BeginSection(AddEmitter(Builder));
	Mesh.AddQuad({-0.5f, 1, -0.5f}, {0.5f, 1, -0.5f}, {0.5f, 1, 0.5f}, {-0.5f, 1, 0.5f});
	Builder.AddNode("emitter", Builder.AddMesh(Mesh));
	AddPointCamera(Builder, {X, 0, 0});
	Darken(Builder);
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
