// The scene on the CPU, traced triangle by triangle: what a case knows of its scene without the code under test.
#pragma once

#include <optional>
#include <vector>

#include "LanternHost/SceneDescription.h"
#include "LanternRenderer/View.h"

namespace Lantern
{

struct FCpuHit
{
	double Distance = 0.0;
	glm::dvec3 Position{0};
	int32_t Node = -1;
};

/// A scene for brute-force rays. The cost of a ray is linear in the number of triangles, which suits small scenes. Rays hit front
/// and back faces.
class FCpuScene
{
public:
	FCpuScene(const FSceneDescription& Scene, double Time);
	/// Direction of unit length; Skip: a node that is not there, or −1.
	std::optional<FCpuHit> Trace(glm::dvec3 Origin, glm::dvec3 Direction, double MaxDistance = 1e30, int32_t Skip = -1) const;

private:
	struct FTriangle
	{
		glm::dvec3 P0, E1, E2;
		int32_t Node;
	};
	std::vector<FTriangle> Triangles;
};

/// Through a point of the picture, in pixels from its upper left corner.
glm::dvec3 GetRayDirection(const FView& View, glm::dvec2 Pixel);
/// Where a point is in the picture, in pixels; nothing behind the camera.
std::optional<glm::dvec2> Project(const FView& View, glm::dvec3 Point);

/// Pixels of View whose surface View Before did not see: outside its picture, or hidden. Sky is left out.
std::vector<uint8_t> FindDisoccluded(const FCpuScene& Scene, const FView& View, const FView& Before);
/// What each pixel's centre sees.
std::vector<std::optional<FCpuHit>> TracePicture(const FCpuScene& Scene, const FView& View, int32_t Skip = -1);

} // namespace Lantern
