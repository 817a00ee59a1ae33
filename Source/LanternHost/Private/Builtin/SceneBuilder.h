// Puts a scene together by code.
#pragma once

#include <string>

#include <glm/glm.hpp>

#include "Builtin/MeshBuilder.h"
#include "LanternHost/SceneDescription.h"

namespace Lantern::Builtin
{

class FSceneBuilder
{
public:
	explicit FSceneBuilder(std::string Name) { Scene.Name = std::move(Name); }

	int32_t AddMaterial(const FHostMaterial& Material);
	/// Adds a pure Lambert material, without any specular layer.
	int32_t AddLambert(const char* Name, const glm::vec3& Albedo, const glm::vec3& Emission = glm::vec3(0));
	int32_t AddImage(FHostImage&& Image); ///< returns the index of a repeating texture of it
	int32_t AddMesh(FMeshBuilder& Builder);

	int32_t AddNode(const char* Name, int32_t Mesh, const glm::vec3& Position = glm::vec3(0), float YawRadians = 0.0f,
	    const glm::vec3& Scale = glm::vec3(1), int32_t Parent = -1);
	/// Adds a camera that looks from one point to another. The picture's up is as near to Up as it can be.
	void AddCamera(const glm::dvec3& From, const glm::dvec3& To, float FovYDegrees, const glm::dvec3& Up = {0, 1, 0});
	int32_t AddPointLight(const char* Name, const glm::vec3& Position, const glm::vec3& Candela, float Range = 0.0f);
	/// Sets the sun, with the direction in which its light travels, and a constant sky. Zeros mean darkness.
	void SetLight(const glm::vec3& SunDirection, float SunIrradiance, const glm::vec3& Sky);

	FSceneDescription Scene;
};

} // namespace Lantern::Builtin
