// Normals and tangents where a mesh brings none.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace Lantern
{

/// Some unit vector perpendicular to a unit vector.
glm::vec3 GetPerpendicular(const glm::vec3& N);

/// Adds up the (area-weighted) normals of the triangles around each vertex and normalises; +y where that is zero.
std::vector<glm::vec3> ComputeSmoothNormals(std::span<const glm::vec3> Positions, std::span<const uint32_t> Indices);

/// Per-vertex tangents by Lengyel's method ("Computing Tangent Space Basis Vectors for an Arbitrary Mesh", 2001):
/// the triangles' UV gradients summed per vertex, made perpendicular to the normal. w: sign of the
/// bitangent, which in glTF points towards smaller v.
std::vector<glm::vec4> ComputeTangents(std::span<const glm::vec3> Positions, std::span<const glm::vec3> Normals,
    std::span<const glm::vec2> UVs, std::span<const uint32_t> Indices);

} // namespace Lantern
