// Camera rays, and positions from depth. Depth is reversed, without a far plane: depth = near / distance along the view axis.
#ifndef LANTERN_VIEW_GLSL
#define LANTERN_VIEW_GLSL

#include "Bindings.glsl"
#include "Math.glsl"

// Whether a thread of the last, partly used work groups has no pixel.
bool IsOutsideView(FViewConstants View, uvec2 Pixel) { return any(greaterThanEqual(Pixel, uvec2(View.Width, View.Height))); }

// Returns the direction through Pixel, of length 1 along the view axis (not normalised). The first pixel's centre is at 0.5.
vec3 CameraRay(FViewConstants View, vec2 Pixel)
{
	vec2 Ndc = Pixel / vec2(View.Width, View.Height) * 2.0 - 1.0;
	return View.CameraForward + View.CameraRight * (Ndc.x * View.TanHalfFovY * View.Aspect) - View.CameraUp * (Ndc.y * View.TanHalfFovY);
}

// Returns the position relative to the camera, metres. Depth must be > 0 (0 is the sky).
vec3 RelativePositionFromDepth(FViewConstants View, uvec2 Pixel, float Depth)
{
	return CameraRay(View, vec2(Pixel) + 0.5) * (View.Near / Depth);
}

// Returns the height of a pixel at distance 1 along the view axis.
float PixelAngle(FViewConstants View) { return 2.0 * View.TanHalfFovY / float(View.Height); }

// Returns the origin of rays that leave the surface of a pixel. Relative: position relative to the camera.
vec3 RasterRayOrigin(FSceneConstants Scene, FViewConstants View, vec3 Relative, vec3 Ng)
{
	return OffsetRasterPoint(View.CameraPosition + Relative, Ng, Scene.ObjectReach, length(Relative) * PixelAngle(View));
}

#endif
