// Motion in double precision: rays against the scene's triangles, and where what they hit was in the frame before.
#pragma once

#include <optional>
#include <vector>

#include "LanternHost/HostScene.h"

namespace Lantern
{

/// Triangles of all objects at one moment, in the world.
struct FMotionSnapshot
{
	struct FObject
	{
		uint32_t Index = 0; ///< in the scene
		bool bMirrored = false;
		const FHostMesh* Mesh = nullptr;
		std::vector<glm::dvec3> Positions;
	};
	FView View;
	std::vector<FObject> Objects;
};
/// As the scene is now; skinned meshes are bent on the CPU (glTF 2.0, 3.7.3.3).
FMotionSnapshot TakeSnapshot(FHostScene& Scene, const FView& View);

/// A camera without a rounding.
class FExactCamera
{
public:
	explicit FExactCamera(const FView& View);
	glm::dvec3 MakeRay(glm::dvec2 Pixel) const; ///< one unit along the view
	/// xy: pixel, z: distance along the view. x and y mean something where z > 0.
	glm::dvec3 Project(const glm::dvec3& World) const;
	glm::dvec3 GetPosition() const { return View.Position; }

private:
	FView View;
	glm::dvec3 Right, Up, Forward;
	double TanX, TanY;
};

struct FExactMotion
{
	uint32_t Object = 0;         ///< index in the scene
	glm::dvec3 Point{0};         ///< seen now
	glm::dvec3 PreviousPoint{0}; ///< the same point of the surface, in the frame before
	glm::dvec2 Offset{0};        ///< of the point from the pixel's centre, pixels
	double Distance = 0;         ///< along the view
	glm::dvec2 Motion{0};        ///< pixels
	double PreviousDistance = 0; ///< along the view then
};
/// Of the surface in the centre of a pixel; nothing: the sky. Objects that Before does not have stand still.
std::optional<FExactMotion> FindMotion(
    const FMotionSnapshot& Before, const FMotionSnapshot& Now, const FSceneDescription& Scene, uint32_t X, uint32_t Y);

/// Of what a raster saw in a pixel, by the object and the distance along the view (metres, ± DistanceError) that it found:
/// the point nearest to the pixel's centre. A raster moves corners to a grid of subpixels; of a face that is seen nearly
/// edge-on, all that there is lies within a step of that grid, and which of it a pixel shows is the grid's to say.
/// Nothing: the object has no such point.
std::optional<FExactMotion> FindMotionAt(const FMotionSnapshot& Before, const FMotionSnapshot& Now, const FSceneDescription& Scene,
    uint32_t Object, double Distance, double DistanceError, uint32_t X, uint32_t Y);

} // namespace Lantern
