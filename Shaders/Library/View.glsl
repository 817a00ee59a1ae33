// Camera rays and positions from depth. Reversed depth without a far plane: depth = near / distance along the view.
#ifndef LANTERN_VIEW_GLSL
#define LANTERN_VIEW_GLSL

#include "Bindings.glsl"
#include "Math.glsl"

// Not normalised: one unit along the view direction. Pixel: in pixels, centre of the first at 0.5.
vec3 CameraRay(FViewConstants View, vec2 Pixel)
{
	vec2 Ndc = Pixel / vec2(View.Width, View.Height) * 2.0 - 1.0;
	return View.CameraForward + View.CameraRight * (Ndc.x * View.TanHalfFovY * View.Aspect) - View.CameraUp * (Ndc.y * View.TanHalfFovY);
}

// Relative to the camera. Depth 0 is the sky: do not ask.
vec3 RelativePositionFromDepth(FViewConstants View, uvec2 Pixel, float Depth)
{
	return CameraRay(View, vec2(Pixel) + 0.5) * (View.Near / Depth);
}

// Size of a pixel at distance 1 along the view.
float PixelAngle(FViewConstants View) { return 2.0 * View.TanHalfFovY / float(View.Height); }

// Where rays leave the surface that a pixel shows.
vec3 RasterRayOrigin(FSceneConstants Scene, FViewConstants View, vec3 Relative, vec3 Ng)
{
	return OffsetRasterPoint(View.CameraPosition + Relative, Ng, Scene.ObjectReach, length(Relative) * PixelAngle(View));
}

#endif
