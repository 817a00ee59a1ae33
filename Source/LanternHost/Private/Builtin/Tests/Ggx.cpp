// A metal plane under a uniform sky: the albedo of the GGX lobe.
#include <algorithm>
#include <cmath>

#include "Builtin/Tests/TestParts.h"
#include "Builtin/Tests/TestScenes.h"

namespace Lantern::Builtin
{

FSceneDescription BuildGgx(float Roughness, float Mu)
{
	FSceneBuilder Builder("ggx");
	FHostMaterial Metal;
	Metal.Name = "metal";
	Metal.Metallic = 1.0f;
	Metal.Roughness = Roughness;
	FMeshBuilder Mesh("plane");
	Mesh.BeginSection(Builder.AddMaterial(Metal));
	Mesh.AddQuad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1});
	Builder.AddNode("plane", Builder.AddMesh(Mesh));
	const double Sin = std::sqrt(std::max(0.0, 1.0 - double(Mu) * double(Mu)));
	Builder.AddCamera(4.0 * glm::dvec3(0, Mu, Sin), {0, 0, 0}, PointFov, {0, Sin, -double(Mu)});
	Builder.SetLight(Down, 0.0f, glm::vec3(1));
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
