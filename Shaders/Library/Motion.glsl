// Where a surface was on the screen of the frame before.
#ifndef LANTERN_MOTION_GLSL
#define LANTERN_MOTION_GLSL

#include "Bindings.glsl"

vec2 PixelOfClip(FViewConstants View, vec4 Clip) { return (Clip.xy / Clip.w * 0.5 + 0.5) * vec2(View.Width, View.Height); }

// xy and z of FGBuffer::Motion. Relative: to this frame's camera, with w > 0; PreviousRelative: to the previous one's.
// Both ends of the motion are of the same point, so that what rasterisation rounds, which is where in the pixel that point
// lies, is in neither, and what stands still before a camera that stands still moves by exactly 0.
vec3 MotionOf(FViewConstants View, vec3 Relative, vec3 PreviousRelative)
{
	if (View.bHistory == 0u) { return vec3(0.0, 0.0, dot(View.CameraForward, Relative)); }
	vec4 Previous = View.PreviousRelativeToClip * vec4(PreviousRelative, 1.0);
	vec3 Motion = vec3(PixelOfClip(View, Previous) - PixelOfClip(View, View.RelativeToClip * vec4(Relative, 1.0)), Previous.w);
	// Behind the previous camera or before its near plane, it was nowhere on its screen. (Half of the plane's distance, for
	// what lies on it stays seen.) The same for what is too far away to be a number.
	bool bSeen = Previous.w > 0.5 * View.PreviousNear && all(lessThan(abs(Motion), vec3(1.0e9)));
	return bSeen ? Motion : vec3(-2.0 * vec2(View.Width, View.Height), 0.0);
}

#endif
