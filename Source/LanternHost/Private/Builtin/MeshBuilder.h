// Builds FHostMesh from shapes. Fronts are counter-clockwise. Shapes bring their normals and texture coordinates; tangents are computed at
// the end.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "LanternHost/SceneDescription.h"

namespace Lantern::Builtin
{

class FMeshBuilder
{
public:
	explicit FMeshBuilder(std::string Name) { Mesh.Name = std::move(Name); }

	/// Begins a section of this material, to which all that follows belongs. Each call begins a new section.
	FMeshBuilder& BeginSection(int32_t Material);
	/// Transforms positions and normals of all that follows, not texture coordinates.
	FMeshBuilder& SetTransform(const glm::mat4& InTransform);
	/// Multiplies the texture coordinates of the shapes below, which are in metres.
	FMeshBuilder& SetTexelScale(float InScale);
	FMeshBuilder& SetColor(const glm::vec3& InColor);

	uint32_t AddVertex(const glm::vec3& Position, const glm::vec3& Normal, const glm::vec2& UV);
	void AddTriangle(uint32_t A, uint32_t B, uint32_t C);

	/// Adds a flat quad with counter-clockwise corners. Texture coordinates are positions in metres along the two axes that the quad
	/// faces least.
	void AddQuad(const glm::vec3& P0, const glm::vec3& P1, const glm::vec3& P2, const glm::vec3& P3);
	/// Adds a flat quad with u and v from 0 to 1.
	void AddUnitQuad(const glm::vec3& P0, const glm::vec3& P1, const glm::vec3& P2, const glm::vec3& P3);
	/// Adds a box that faces outwards, or inwards if bInward.
	void AddBox(const glm::vec3& Min, const glm::vec3& Max, bool bInward = false);
	/// Adds a box whose edges are cut off at 45° by Bevel metres, so that they catch light as real edges do.
	void AddBeveledBox(const glm::vec3& Min, const glm::vec3& Max, float Bevel);
	/// Turns a profile (radius, height), from bottom to top, about the y axis. The surface is smooth except where two successive points
	/// of the profile are equal.
	void AddLathe(std::span<const glm::vec2> Profile, int Segments);
	/// Adds a subdivided icosahedron with vertices at Radius.
	void AddSphere(const glm::vec3& Center, float Radius, int Subdivisions, bool bInward = false);
	/// Adds a disk about Center that faces Normal.
	void AddDisk(const glm::vec3& Center, const glm::vec3& Normal, float Radius, int Segments);
	/// Adds a tube along a path, with a radius for each of its points.
	void AddTube(std::span<const glm::vec3> Path, std::span<const float> Radii, int Segments);

	/// Sum of the triangles' areas so far.
	double ComputeArea() const;
	void Scale(float Factor);

	FHostMesh Build();

private:
	void AddLatheBand(
	    const glm::vec2& A, const glm::vec2& B, const glm::vec2& NormalA, const glm::vec2& NormalB, float VA, float VB, int Segments);

	FHostMesh Mesh;
	std::vector<glm::vec3> Normals;
	std::vector<glm::vec2> UVs;
	std::vector<glm::vec3> Colors;
	glm::mat4 Transform{1};
	glm::mat3 NormalTransform{1};
	glm::vec3 Color{1};
	float TexelScale = 1.0f;
};

} // namespace Lantern::Builtin
