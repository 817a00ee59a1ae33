// Camera rays, and positions from depth. Depth is near / distance along the view axis, and 0 for the sky.
#ifndef LANTERN_VIEW_GLSL
#define LANTERN_VIEW_GLSL

#include "Bindings.glsl"
#include "Math.glsl"

// Whether a thread of the last, partly used work groups has no pixel.
bool IsOutsideView(FViewConstants View, uvec2 Pixel) { return any(greaterThanEqual(Pixel, uvec2(View.Width, View.Height))); }

// Returns the position, relative to the camera, of what is seen at Distance along the view axis. Pixel: point of the picture;
// the first pixel's centre is at 0.5.
vec3 RelativePosition(FViewConstants View, vec2 Pixel, float Distance)
{
	vec2 Aside = (Pixel * View.RayScale + View.RayOffset) * (View.bOrthographic != 0u ? 1.0 : Distance);
	return View.CameraForward * Distance + View.CameraRight * Aside.x + View.CameraUp * Aside.y;
}

// Returns where the camera ray through Pixel starts, relative to the camera, and its direction, of unit length.
vec3 CameraRayStart(FViewConstants View, vec2 Pixel) { return View.bOrthographic != 0u ? RelativePosition(View, Pixel, 0.0) : vec3(0.0); }
vec3 CameraRay(FViewConstants View, vec2 Pixel)
{
	return View.bOrthographic != 0u ? View.CameraForward : normalize(RelativePosition(View, Pixel, 1.0));
}

// Returns the distance along the view axis, metres. Depth must be > 0 (0 is the sky).
float DistanceFromDepth(FViewConstants View, float Depth) { return View.Near / Depth; }

// Returns the position relative to the camera, metres. Depth must be > 0 (0 is the sky).
vec3 RelativePositionFromDepth(FViewConstants View, uvec2 Pixel, float Depth)
{
	return RelativePosition(View, vec2(Pixel) + 0.5, DistanceFromDepth(View, Depth));
}

// Returns the direction from the camera to a position relative to it, of unit length.
vec3 ViewDirection(FViewConstants View, vec3 Relative) { return View.bOrthographic != 0u ? View.CameraForward : normalize(Relative); }

// Returns the height of a pixel, metres. Distance: of what it shows.
float PixelHeight(FViewConstants View, float Distance) { return View.PixelSize * (View.bOrthographic != 0u ? 1.0 : Distance); }

#endif
