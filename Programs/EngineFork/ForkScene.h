// What the engine shows: boxes and a sun, simple enough that the right shadow is known in closed form.
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

struct FCamera
{
	glm::dvec3 Position{0};
	glm::dvec3 Forward{0, 0, -1}, Right{1, 0, 0}, Up{0, 1, 0}; ///< orthonormal
	double FovY = 1.0;
	double Near = 0.1;
};

struct FForkScene
{
	std::vector<FBox> Boxes;
	glm::dvec3 SunDirection{0, -1, 0}; ///< in which the light travels, unit length
	FCamera Camera;
};

/// A floor, a floating cube, a pillar that may be deformed, a slab that casts no shadow, and a cut-out cube, all moved
/// by Offset.
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

/// From −HalfSize to HalfSize.
FBoxMesh MakeBoxMesh(glm::vec3 HalfSize = glm::vec3(1));

/// Of positions relative to the camera; Vulkan's clip space, reversed depth without a far plane.
glm::mat4 GetRelativeToClip(const FCamera& Camera, double Aspect);

enum class EExpectation : uint8_t
{
	Unsure, ///< an edge of a box or of a shadow is near
	Sky,
	Lit,
	Shadowed,
};

/// The truth for the pixel, found by intersecting boxes in double precision.
EExpectation ExpectPixel(const FForkScene& Scene, uint32_t X, uint32_t Y, uint32_t Width, uint32_t Height);

} // namespace Fork
