// Textures by code: tileable noise, and surfaces that become colour, normal and roughness maps.
#pragma once

#include <functional>
#include <string>

#include <glm/glm.hpp>

#include "Builtin/SceneBuilder.h"

namespace Lantern::Builtin
{

/// Value noise without gradients over [0, 1)², repeating after 1, with this number of cells per edge. 0 to 1.
float SampleNoise(const glm::vec2& P, uint32_t Cells, uint32_t Seed);
/// Sum of octaves of value noise, each twice as fine and Gain times as strong. 0 to 1, mean ½.
float SampleFractal(const glm::vec2& P, uint32_t Cells, int Octaves, float Gain, uint32_t Seed);
/// A surface at one point. Height, in metres, gives the normal map.
struct FSurfacePoint
{
	glm::vec3 Albedo{0.5f}; ///< linear
	float Height = 0.0f;
	float Roughness = 0.8f;
	float Metallic = 0.0f;
	float Alpha = 1.0f;
};

struct FSurfaceDescription
{
	std::string Name;
	uint32_t Size = 512;  ///< texels
	float Metres = 1.0f;  ///< size of the texture, in the UV units of FMeshBuilder
	bool bUnitUV = false; ///< the mesh's coordinates run from 0 to 1 instead
	bool bNormalMap = true, bRoughnessMap = true;
	std::function<FSurfacePoint(const glm::vec2&)> Evaluate; ///< over [0, 1)², repeating; called from many threads
};

/// Makes a material with the maps of the surface.
FHostMaterial MakeSurfaceMaterial(FSceneBuilder& Builder, const FSurfaceDescription& Description);

} // namespace Lantern::Builtin
