// Culling for rays. Objects are left out by distance and angular size, with separate limits before and behind the camera.
// They are also left out by size on the screen, with a limit for shadow rays and one for all others. One rule on a bounding
// sphere does all of it: an object is kept up to a distance that grows with its radius.
#pragma once

#include <glm/glm.hpp>

#include "SceneTypes.h"

namespace Lantern
{

/// The camera of a frame.
struct FGatherView
{
	FGatherView() = default;
	FGatherView(const glm::dvec3& InPosition) : Position(InPosition) {}
	FGatherView(const glm::dvec3& InPosition, const glm::vec3& InForward) : Position(InPosition), Forward(InForward) {}
	/// FovY: radians. Height: pixels.
	FGatherView(const glm::dvec3& InPosition, const glm::vec3& InForward, float FovY, uint32_t Height);

	glm::dvec3 Position{0}; ///< in the world, metres; orthographic: the middle of what is seen
	glm::vec3 Forward{0, 0, -1};
	/// Height of a pixel at distance 1, or in metres if orthographic, for minimum screen sizes. 0: those do not apply.
	float PixelSize = 0.0f;
	uint32_t Height = 0; ///< of the picture, pixels: what is built first is what takes most of it
	/// What is seen has no point that it is seen from. Distances count from a sphere of radius Reach around it, in metres, nothing
	/// lies behind, and minimum screen sizes do not apply.
	bool bOrthographic = false;
	double Reach = 0.0;
	friend bool operator==(const FGatherView&, const FGatherView&) = default;
};

/// Values of the console variables r.RT.Culling and r.RT.Culling.….
struct FCullingSettings
{
	bool bEnabled = true;
	/// Objects that reach nearer than this are kept, metres.
	float Radius = 1000.0f, RadiusBehind = 500.0f;
	/// Beyond Radius, objects are kept if their angle from centre to rim is at least this. Degrees.
	float Angle = 0.25f, AngleBehind = 1.0f;
	/// Objects that are fewer pixels across are not seen by shadow rays, or by all other rays. 0: no limit.
	float ShadowMinPixels = 0.0f, VisibleMinPixels = 0.0f;
	friend bool operator==(const FCullingSettings&, const FCullingSettings&) = default;

	/// Returns the values of this frame. Render thread.
	static FCullingSettings FromConsole();
};

/// Radius of objects without known bounds: larger than any limit.
inline constexpr double UnboundedRadius = 1e18;

/// View and settings, prepared for tests of many spheres. Arrays have index 0 before the camera and 1 wholly behind it.
struct FCullingRule
{
	FCullingRule() = default; ///< keeps all objects
	FCullingRule(const FGatherView& View, const FCullingSettings& Settings);

	bool bCull = false;
	glm::dvec3 Eye{0};
	glm::dvec3 Forward{0, 0, -1};
	double Radius[2] = {0, 0};
	double InverseSine[2] = {1, 1}; ///< one over the sine of the angle
	/// A radius is large enough on the screen up to the distance radius · scale, if the limit is on.
	double VisibleScale = 0, ShadowScale = 0;
	bool bVisibleLimit = false, bShadowLimit = false;

	/// Returns the bits of an instance mask that a sphere keeps; 0: it is left out. MASK_CASTERS are kept or dropped
	/// together, and so are all others.
	uint8_t Test(const glm::dvec3& Center, double SphereRadius) const
	{
		if (!bCull) { return 0xff; }
		const glm::dvec3 Away = Center - Eye;
		const double Distance2 = glm::dot(Away, Away);
		const int Side = glm::dot(Away, Forward) < -SphereRadius ? 1 : 0;
		const double Near = Radius[Side] + SphereRadius, Large = SphereRadius * InverseSine[Side];
		const double Limit = Near > Large ? Near : Large;
		if (!(Distance2 <= Limit * Limit)) { return 0; }
		const double Visible = SphereRadius * VisibleScale, Shadow = SphereRadius * ShadowScale;
		uint8_t Bits = 0;
		if (!bVisibleLimit || Distance2 <= Visible * Visible) { Bits |= 0xff & ~MASK_CASTERS; }
		if (!bShadowLimit || Distance2 <= Shadow * Shadow) { Bits |= MASK_CASTERS; }
		return Bits;
	}
	/// Returns the size of a sphere on the screen: pixels across.
	float ScreenSize(const glm::dvec3& Center, double SphereRadius) const;

private:
	double PixelsPerSlope = 0.0;
	bool bOrthographic = false;
};

} // namespace Lantern
