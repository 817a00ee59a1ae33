// From a host's projection and depth to what passes know. All conventions meet here and in Shaders/HostSurface: passes only see
// FView, with depth as near / distance.
#pragma once

#include "LanternRHI/RTInterfaces.h"
#include "LanternRenderer/View.h"

namespace Lantern
{

/// A projection in the host's own terms: clip = ViewToClip · view. View space has x to the right.
struct FHostProjection
{
	/// Rows: x, y, z and w of clip space, of which depth is z / w, from 0 to 1. No row may mix x with y, or depth with either.
	double ViewToClip[16] = {};
	bool bViewYDown = false;    ///< view space has y downwards; else upwards
	bool bViewZForward = false; ///< orthographic: the camera looks along +z; else along −z. A perspective says so by its w
	bool bClipYUp = false;      ///< y of clip space points upwards on the picture, as with a viewport of negative height
	/// Unit of view space, metres.
	double MetersPerUnit = 1.0;
};

/// What texels of a depth texture mean.
struct FHostDepth
{
	/// Value at depth 0 and at depth 1, which is linear in between. Perspective: 1 / distance, 1/m. Orthographic: distance, m.
	/// If bLinear: metres for one unit of texels, and the texel from which on it is sky.
	double AtZero = 0.0, AtOne = 20.0;
	bool bOrthographic = false;
	bool bLinear = false;  ///< texels are distances along the view
	bool bReversed = true; ///< depth 1 is near; what is at or below 0 is sky. Else what is at or above 1 is
	/// Whether passes can read the texels as they are.
	bool IsNative() const { return !bOrthographic && !bLinear && bReversed && AtZero == 0.0; }
};

/// Sets Window, Near and Far of View, whose other members are set. Moves an orthographic Position so that all lies before it. OutDepth says how to read projected depth. InvalidArgument says what is
/// wrong with the matrix; View is then unchanged.
FRTStatus ReadProjection(const FHostProjection& Projection, FView& View, FHostDepth& OutDepth);

/// Returns the error of distances that are read from a texture of Format, as FView::DepthError. It is a step of the format, which
/// includes rounding of the raster's interpolation. Native depth has none that counts: other errors of rays cover it.
glm::vec3 GetDepthError(ERTFormat Format, const FHostDepth& Depth);

} // namespace Lantern
