// The engine's meshes as the plugin wants them: an array for each attribute.
#pragma once

#include <vector>

#include "Example/ForkScene.h"
#include "LanternModule/Module.h"

namespace Fork
{

/// Owns the arrays that Describe points to.
struct FMeshArrays
{
	explicit FMeshArrays(const FBoxMesh& Box);
	explicit FMeshArrays(const FReedMesh& Reed); ///< as it stands
	FMeshArrays() = default;
	Lantern::FRTModuleMesh Describe(const char* Name, bool bDeformable) const;

	std::vector<glm::vec3> Positions, Normals;
	std::vector<glm::vec2> UVs;
	std::vector<uint32_t> Indices;
};

/// A sheet across x and y, from −1 to 1.
FMeshArrays MakePaneArrays();

/// The reed, which the engine's GPU skins. It bends within its bounds.
Lantern::FRTModuleMesh DescribeReed(const FMeshArrays& Reed);

} // namespace Fork
