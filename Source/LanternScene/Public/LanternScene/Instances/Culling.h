// Which objects rays may leave out: by distance and angular size, each with its own value before and behind the
// camera, and by size on the screen for each type of ray. All of it is one rule on a bounding sphere: an object
// counts while it is no farther away than a limit that grows with its radius.
#pragma once

#include <glm/glm.hpp>

#include "SceneTypes.h"

namespace Lantern
{

/// From where a frame looks.
struct FGatherView
{
	FGatherView() = default;
	FGatherView(const glm::dvec3& InPosition) : Position(InPosition) {}
	FGatherView(const glm::dvec3& InPosition, const glm::vec3& InForward, float InFovY, uint32_t InHeight)
	    : Position(InPosition),
	      Forward(InForward),
	      FovY(InFovY),
	      Height(InHeight)
	{}

	glm::dvec3 Position{0}; ///< in the world, metres
	glm::vec3 Forward{0, 0, -1};
	float FovY = 1.0f;   ///< radians
	uint32_t Height = 0; ///< pixels: for minimum screen sizes; 0: those do not apply
	friend bool operator==(const FGatherView&, const FGatherView&) = default;
};

/// The console variables r.RT.Culling and r.RT.Culling.….
struct FCullingSettings
{
	bool bEnabled = true;
	/// Everything that reaches nearer than this is kept, metres …
	float Radius = 1000.0f, RadiusBehind = 500.0f;
	/// … and beyond it what is seen under at least this angle (from its centre to its rim), degrees.
	float Angle = 0.25f, AngleBehind = 1.0f;
	/// Smaller on the screen than this many pixels across: not seen by shadow rays, not seen by all others. 0: all are.
	float ShadowMinPixels = 0.0f, VisibleMinPixels = 0.0f;
	friend bool operator==(const FCullingSettings&, const FCullingSettings&) = default;

	/// As of this frame. Render thread.
	static FCullingSettings FromConsole();
};

/// Stands for the radius of what has no known bounds: larger than any limit.
inline constexpr double UnboundedRadius = 1e18;

/// View and settings, prepared for many spheres. Index 0: before the camera, 1: wholly behind it.
struct FCullingRule
{
	FCullingRule() = default; ///< keeps all
	FCullingRule(const FGatherView& View, const FCullingSettings& Settings);

	bool bCull = false;
	glm::dvec3 Eye{0};
	glm::dvec3 Forward{0, 0, -1};
	double Radius[2] = {0, 0};
	double InverseSine[2] = {1, 1}; ///< one over the sine of the angle
	/// Distance up to which a radius is large enough on the screen: radius · PixelScale. Infinite: no such limit.
	double VisibleScale = 0, ShadowScale = 0;
	bool bVisibleLimit = false, bShadowLimit = false;

	/// Bits of an instance mask that a sphere keeps; 0: it is left out. The shadow bit is MASK_CASTS_SHADOW, all
	/// others go together.
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
		if (!bVisibleLimit || Distance2 <= Visible * Visible) { Bits |= 0xff & ~MASK_CASTS_SHADOW; }
		if (!bShadowLimit || Distance2 <= Shadow * Shadow) { Bits |= MASK_CASTS_SHADOW; }
		return Bits;
	}
	/// Pixels across.
	float ScreenSize(const glm::dvec3& Center, double SphereRadius) const;

private:
	double PixelsPerSlope = 0.0;
};

} // namespace Lantern
