// Triangles in the world, and rays through them in double precision: what the plugin's shadows are held against.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "LanternHost/SceneDescription.h"

namespace Lantern
{

/// A scene as triangles of the world: three corners each. They are what the raster draws, what the plugin is given, and, in double
/// precision, what the truth is.
struct FTriangleSoup
{
	std::vector<glm::vec3> Positions, Normals;
	uint32_t GetCount() const { return static_cast<uint32_t>(Positions.size() / 3); }
};

/// Takes all meshes at time 0, skins as they are bound, masked materials as if they were opaque.
FTriangleSoup MakeSoup(const FSceneDescription& Scene);

class FTriangleTruth
{
public:
	explicit FTriangleTruth(const FTriangleSoup& InSoup);
	/// Whether some triangle but Ignored lies on the ray from Origin on.
	bool IsBlocked(const glm::dvec3& Origin, const glm::dvec3& Direction, uint32_t Ignored) const;

	struct FPlanePoint
	{
		glm::dvec3 Point{0}, Normal{0}; ///< Normal: unit length, towards where the ray came from
		bool bInside = false;           ///< of the triangle
	};
	/// Where the ray meets the triangle's plane.
	FPlanePoint MeetPlane(uint32_t Triangle, const glm::dvec3& Origin, const glm::dvec3& Direction) const;

private:
	struct FNode
	{
		glm::dvec3 Min{1e300}, Max{-1e300};
		uint32_t First = 0, Count = 0; ///< Count 0: First is the left child, the right one follows it
	};
	void Build(uint32_t Node, uint32_t Begin, uint32_t End);
	/// Distance in lengths of Direction, u and v; negative distance: missed.
	glm::dvec3 Intersect(uint32_t Triangle, const glm::dvec3& Origin, const glm::dvec3& Direction) const;
	glm::dvec3 Corner(uint32_t Triangle, uint32_t I) const { return Soup.Positions[Triangle * 3 + I]; }

	const FTriangleSoup& Soup;
	std::vector<uint32_t> Order;
	std::vector<glm::dvec3> Centers;
	std::vector<FNode> Nodes;
};

} // namespace Lantern
