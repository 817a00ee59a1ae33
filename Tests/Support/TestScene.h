// Small scenes put together by a test.
#pragma once

#include "LanternHost/SceneDescription.h"

namespace Lantern
{

class FTestScene
{
public:
	explicit FTestScene(const char* Name) { Scene.Name = Name; }

	int32_t AddMaterial(const FHostMaterial& Material);
	/// Without any specular layer.
	int32_t AddLambert(const glm::vec3& Albedo, const glm::vec3& Emission = glm::vec3(0), bool bDoubleSided = false);
	/// A texture of which the left half of u is cut away by the alpha test, on a Lambert of 0.5.
	int32_t AddHalfCutLambert();
	/// Its normal map bends every normal the same way, along both tangent and bitangent.
	int32_t AddBumpyLambert(const glm::vec3& Albedo);
	/// A mesh of flat quads, one section each; corners counter-clockwise.
	struct FQuad
	{
		int32_t Material;
		glm::vec3 P[4];
	};
	int32_t AddMesh(const std::vector<FQuad>& Quads);
	int32_t AddNode(int32_t Mesh, const glm::dmat4& Matrix = glm::dmat4(1));
	void AddLight(const FHostLight& Light, const glm::dmat4& Matrix);
	/// A square of 2 · Half metres in the plane y = Height, facing up.
	static FQuad MakeFloor(int32_t Material, float Half, float Height = 0.0f, glm::vec2 Center = glm::vec2(0));

	FSceneDescription Scene;
};

/// The mesh seen in a mirror at x = 0: as good as a node with a scale of −1, but without one.
FHostMesh MakeMirrored(FHostMesh Mesh);

} // namespace Lantern
