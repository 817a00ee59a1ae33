// A disk light above a floor, seen on its axis.
#include <algorithm>

#include "Builtin/Tests/TestParts.h"
#include "Builtin/Tests/TestScenes.h"

namespace Lantern::Builtin
{

FSceneDescription BuildDisk(float Height)
{
	FSceneBuilder Builder("disk");
	AddFloor(Builder, FloorAlbedo);
	FMeshBuilder Mesh("emitter");
	Mesh.BeginSection(AddEmitter(Builder));
	Mesh.AddDisk({0, Height, 0}, Down, 1.0f, 1024);
	Builder.AddNode("emitter", Builder.AddMesh(Mesh));
	const double Low = std::min(0.3, double(Height) * 0.4);
	Builder.AddCamera({0, Low, 2 * Low}, {0, 0, 0}, PointFov);
	Darken(Builder);
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
