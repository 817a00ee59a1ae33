// What the engine shows: boxes and a sun.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace Fork
{

struct FBox
{
	glm::dvec3 Centre{0};
	glm::dvec3 HalfSize{1};
	bool bCastsShadow = true;
	bool bCutOut = false;     ///< its material's alpha test lets all light through
	bool bDeformable = false; ///< has a mesh of its own, whose vertices may change
};

/// A post that bends in its middle. The engine's GPU skins it.
struct FReed
{
	glm::dvec3 Middle{0};
	double Bend = 0.0; ///< of the upper half, radians about z
};

struct FCamera
{
	glm::dvec3 Position{0};
	glm::dvec3 Forward{0, 0, -1}, Right{1, 0, 0}, Up{0, 1, 0}; ///< orthonormal
	double FovY = 1.0;                                         ///< vertical, radians
	double Near = 0.1;                                         ///< metres
};

struct FForkScene
{
	std::vector<FBox> Boxes;
	FReed Reed;
	glm::dvec3 SunDirection{0, -1, 0}; ///< direction in which the light travels, unit length
	FCamera Camera;
};

/// A floor, a floating cube, a deformable pillar, a slab that casts no shadow, a cut-out cube, and a reed. Offset moves all of them.
FForkScene MakeScene(glm::dvec3 Offset);

struct FVertex
{
	glm::vec3 Position, Normal;
};

struct FBoxMesh
{
	std::array<FVertex, 24> Vertices;
	std::array<uint32_t, 36> Indices; ///< counter-clockwise from outside
};

/// A box from −HalfSize to HalfSize.
FBoxMesh MakeBoxMesh(glm::vec3 HalfSize = glm::vec3(1));

struct FSkinVertex
{
	glm::vec3 Position; ///< relative to the reed's middle
	float Weight;       ///< of the bone that turns
};

struct FReedMesh
{
	std::vector<FSkinVertex> Vertices;
	std::vector<uint32_t> Indices; ///< counter-clockwise from outside
};

/// A post of rings without ends, from 2 m below its middle to 2 m above.
FReedMesh MakeReedMesh();
/// Linear blend of two bones, as Fork.comp does it.
glm::dvec3 SkinVertex(const FSkinVertex& Vertex, double Bend);

/// Projects positions relative to the camera to Vulkan's clip space, with reversed depth and no far plane.
glm::mat4 GetRelativeToClip(const FCamera& Camera, double Aspect);

} // namespace Fork
