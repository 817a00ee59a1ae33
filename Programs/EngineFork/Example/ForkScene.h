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
	double Near = 0.5, Far = 1024.0;                           ///< metres
	glm::dvec2 Jitter{0};                                      ///< of the picture, pixels, right and down
};

struct FForkScene
{
	std::vector<FBox> Boxes;
	FReed Reed;
	glm::dvec3 SunDirection{0, -1, 0}; ///< direction in which the light travels, unit length
	std::array<FCamera, 2> Cameras;    ///< two views of one scene, as of two players
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

/// Projects view space (x right, y up, z backwards) to Vulkan's clip space: 0 at the near plane, 1 at the far plane, no jitter.
glm::mat4 GetViewToClip(const FCamera& Camera, double Aspect);
/// Rotates the world to view space.
glm::dmat3 GetWorldToView(const FCamera& Camera);

} // namespace Fork
