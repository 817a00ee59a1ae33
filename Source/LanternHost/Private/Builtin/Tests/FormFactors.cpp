// Two unit squares, whose form factor is known.
#include "Builtin/Tests/TestParts.h"
#include "Builtin/Tests/TestScenes.h"

namespace Lantern::Builtin
{

FSceneDescription BuildFormFactors(bool bPerpendicular)
{
	FSceneBuilder Builder("formfactors");
	FMeshBuilder Receiver("receiver");
	Receiver.BeginSection(Builder.AddLambert("receiver", glm::vec3(FloorAlbedo)));
	Receiver.AddQuad({-0.5f, 0, 0.5f}, {0.5f, 0, 0.5f}, {0.5f, 0, -0.5f}, {-0.5f, 0, -0.5f});
	Builder.AddNode("receiver", Builder.AddMesh(Receiver));
	FMeshBuilder Emitter("emitter");
	Emitter.BeginSection(AddEmitter(Builder));
	if (bPerpendicular) { Emitter.AddQuad({-0.5f, 0, -0.5f}, {0.5f, 0, -0.5f}, {0.5f, 1, -0.5f}, {-0.5f, 1, -0.5f}); }
	else { Emitter.AddQuad({-0.5f, 1, -0.5f}, {0.5f, 1, -0.5f}, {0.5f, 1, 0.5f}, {-0.5f, 1, 0.5f}); }
	Builder.AddNode("emitter", Builder.AddMesh(Emitter));
	// From between the squares: at half a metre and 90° the square fills a square picture.
	Builder.AddCamera({0, 0.5, 0}, {0, 0, 0}, 90, {0, 0, -1});
	Darken(Builder);
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
