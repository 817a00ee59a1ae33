// Materials, triangles and lights at the edge of what divides by zero.
#include "Builtin/Stability/StabilityParts.h"
#include "Builtin/Stability/StabilityScenes.h"

namespace Lantern::Builtin
{

FSceneDescription BuildStabilityNan()
{
	FSceneBuilder Builder("stability-nan");
	AddGround(Builder, AddPaint(Builder, "floor", glm::vec3(0.5f), 0.0f), 20.0f);
	const int32_t Materials[] = {AddMetal(Builder, "mirror", glm::vec3(1), 0.0f), AddPaint(Builder, "glass-like", glm::vec3(0.2f), 0.0f),
	    AddMetal(Builder, "black metal", glm::vec3(0), 0.0f), AddPaint(Builder, "white", glm::vec3(1), 1.0f)};
	for (int I = 0; I < 4; ++I)
	{
		FMeshBuilder Sphere("sphere");
		Sphere.BeginSection(Materials[I]);
		Sphere.AddSphere(glm::vec3(0), 0.5f, 3);
		Builder.AddNode("sphere", Builder.AddMesh(Sphere), {float(I) * 1.2f - 1.8f, 0.5f, 0});
	}
	FMeshBuilder Odd("triangles without area");
	Odd.BeginSection(Materials[3]);
	for (const glm::vec3& End : {glm::vec3(1, 0.5f, 0.6f), glm::vec3(-1, 1.2f, 0.6f), glm::vec3(0)})
	{
		const uint32_t A = Odd.AddVertex({-1, 0.5f, 0.6f}, {0, 1, 0}, {0, 0}), B = Odd.AddVertex({-1, 0.5f, 0.6f}, {0, 1, 0}, {0, 0}),
		               C = Odd.AddVertex(End, {0, 0, 1}, {1, 0});
		Odd.AddTriangle(A, B, C);
		Odd.AddTriangle(A, A, A);
	}
	// Edge-on to the camera, at its very height.
	Odd.AddQuad({-0.3f, 1.5f, 1.2f}, {0.3f, 1.5f, 1.2f}, {0.3f, 1.5f, -3}, {-0.3f, 1.5f, -3});
	Builder.AddNode("odd", Builder.AddMesh(Odd));
	AddBoxNode(Builder, "lamp", Builder.AddLambert("lamp", glm::vec3(0), glm::vec3(1e6f)), {-2.6f, 0.2f, -1.2f}, {-2.4f, 0.4f, -1.0f});
	Builder.AddCamera({0, 1.5, 4}, {0, 0.5, 0}, 50);
	Builder.SetLight({0.3f, -1, -0.3f}, 1e6f, {0.5f, 0.7f, 1.0f});
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
