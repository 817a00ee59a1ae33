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

// Returns the origin of rays that leave the surface of a pixel. Relative: position relative to the camera.
vec3 RasterRayOrigin(FSceneConstants Scene, FViewConstants View, vec3 Relative, vec3 Ng)
{
	float Distance = dot(View.CameraForward, Relative), Length = length(Relative);
	// The depth's error moves the point along the camera ray; the part along the normal is what can bury it.
	float DepthError = View.DepthError.x + Distance * (View.DepthError.y + Distance * View.DepthError.z);
	float Facing = min(abs(dot(Ng, ViewDirection(View, Relative))) + View.NormalError, 1.0);
	float Along = DepthError * Facing * (View.bOrthographic != 0u ? 1.0 : Length / Distance);
	// A normal that may be any could lead to the surface's other side. The way to the camera is free.
	vec3 ToCamera = -ViewDirection(View, Relative);
	vec3 Away = View.NormalError < 0.5 ? Ng : ToCamera / max(dot(Ng, ToCamera), 0.1);
	return OffsetRasterPoint(View.CameraPosition + Relative, Away, Scene.ObjectReach, PixelHeight(View, Length), Along);
}

// Whether a ray along Direction leaves the surface to the side of Ng. With normals that are not exact, rays that may do so count:
// those that do not meet the surface itself.
bool LeavesSurface(FViewConstants View, vec3 Ng, vec3 Direction) { return dot(Ng, Direction) > -View.NormalError; }

#endif
