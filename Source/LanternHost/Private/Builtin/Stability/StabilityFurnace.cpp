// Spheres of many roughnesses under a uniform sky.
#include <fmt/format.h>

#include "Builtin/Stability/StabilityParts.h"
#include "Builtin/Stability/StabilityScenes.h"

namespace Lantern::Builtin
{

FSceneDescription BuildStabilityFurnace()
{
	FSceneBuilder Builder("stability-furnace");
	for (int Metal = 0; Metal < 2; ++Metal)
	{
		for (int I = 0; I < 5; ++I)
		{
			const std::string Name = fmt::format("{} {}", Metal ? "metal" : "dielectric", I);
			FMeshBuilder Sphere(Name);
			const float Roughness = float(I) / 4.0f;
			Sphere.BeginSection(Metal ? AddMetal(Builder, Name.c_str(), glm::vec3(1), Roughness)
			                          : AddPaint(Builder, Name.c_str(), glm::vec3(1), Roughness));
			Sphere.AddSphere(glm::vec3(0), 1.0f, 4);
			Builder.AddNode(Name.c_str(), Builder.AddMesh(Sphere), {float(I - 2) * 4.0f, Metal ? -2.0f : 2.0f, 0});
		}
	}
	Builder.AddCamera({0, 0, 100}, {0, 0, 0}, 6.5);
	Builder.SetLight({0, -1, 0}, 0.0f, glm::vec3(1));
	return std::move(Builder.Scene);
}

} // namespace Lantern::Builtin
