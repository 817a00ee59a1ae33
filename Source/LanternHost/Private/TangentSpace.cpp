// Generates tangents for vertices that have none.
#include "TangentSpace.h"

#include <cmath>

namespace Lantern
{

glm::vec3 GetPerpendicular(const glm::vec3& N)
{
	const glm::vec3 Axis = std::abs(N.x) < 0.7f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
	return glm::normalize(Axis - N * glm::dot(N, Axis));
}

std::vector<glm::vec3> ComputeSmoothNormals(std::span<const glm::vec3> Positions, std::span<const uint32_t> Indices)
{
	// Double precision, so that squares of coordinates near the limit of float do not overflow.
	std::vector<glm::dvec3> Sums(Positions.size(), glm::dvec3(0));
	for (size_t I = 0; I + 2 < Indices.size(); I += 3)
	{
		const glm::dvec3 A(Positions[Indices[I]]), B(Positions[Indices[I + 1]]), C(Positions[Indices[I + 2]]);
		const glm::dvec3 Normal = glm::cross(B - A, C - A);
		for (size_t Corner = 0; Corner < 3; ++Corner) { Sums[Indices[I + Corner]] += Normal; }
	}
	std::vector<glm::vec3> Normals(Positions.size());
	for (size_t I = 0; I < Sums.size(); ++I)
	{
		const double Length = glm::length(Sums[I]);
		Normals[I] = Length > 0 && std::isfinite(Length) ? glm::vec3(Sums[I] / Length) : glm::vec3(0, 1, 0);
	}
	return Normals;
}

std::vector<glm::vec4> ComputeTangents(std::span<const glm::vec3> Positions, std::span<const glm::vec3> Normals,
    std::span<const glm::vec2> UVs, std::span<const uint32_t> Indices)
{
	std::vector<glm::dvec3> Along(Positions.size(), glm::dvec3(0)), Across(Positions.size(), glm::dvec3(0));
	for (size_t I = 0; I + 2 < Indices.size(); I += 3)
	{
		const uint32_t A = Indices[I], B = Indices[I + 1], C = Indices[I + 2];
		const glm::dvec3 Origin = Positions[A];
		const glm::dvec3 E1 = glm::dvec3(Positions[B]) - Origin, E2 = glm::dvec3(Positions[C]) - Origin;
		const glm::dvec2 OriginUV = UVs[A];
		const glm::dvec2 D1 = glm::dvec2(UVs[B]) - OriginUV, D2 = glm::dvec2(UVs[C]) - OriginUV;
		const double Determinant = D1.x * D2.y - D2.x * D1.y;
		if (Determinant == 0 || !std::isfinite(Determinant)) { continue; }
		// Uses only the sign, since a division would let slivers in texture space outweigh everything else.
		const double Sign = Determinant > 0 ? 1.0 : -1.0;
		const glm::dvec3 Tangent = (E1 * D2.y - E2 * D1.y) * Sign;
		const glm::dvec3 Bitangent = (E2 * D1.x - E1 * D2.x) * Sign;
		for (const uint32_t Vertex : {A, B, C})
		{
			Along[Vertex] += Tangent;
			Across[Vertex] += Bitangent;
		}
	}
	std::vector<glm::vec4> Tangents(Positions.size());
	for (size_t I = 0; I < Tangents.size(); ++I)
	{
		const glm::dvec3 N(Normals[I]);
		const glm::dvec3 T = Along[I] - N * glm::dot(N, Along[I]);
		const double Length = glm::length(T);
		const bool bUsable = Length > 1e-300 && std::isfinite(Length);
		const glm::vec3 Unit = bUsable ? glm::vec3(T / Length) : GetPerpendicular(Normals[I]);
		// glTF's bitangent points up in the image, towards smaller v.
		const float Sign = glm::dot(glm::cross(N, T), Across[I]) > 0 ? -1.0f : 1.0f;
		Tangents[I] = glm::vec4(Unit, Sign);
	}
	return Tangents;
}

} // namespace Lantern
