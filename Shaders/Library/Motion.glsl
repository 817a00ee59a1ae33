// Motion vectors: the position of a surface on the screen of the previous frame.
#ifndef LANTERN_MOTION_GLSL
#define LANTERN_MOTION_GLSL

#include "Bindings.glsl"

vec2 ClipToPixel(FViewConstants View, vec4 Clip) { return (Clip.xy / Clip.w * 0.5 + 0.5) * vec2(View.Width, View.Height); }

// Returns xy and z of FGBuffer::Motion. Relative: position relative to this frame's camera, in front of it (clip w > 0).
// PreviousRelative: previous position relative to the previous camera.
// This projects one point with the cameras of two frames instead of using the centre of the pixel. The rounding of the
// rasteriser thus cancels out: a static point before a static camera moves by exactly 0.
// Jitter is no motion: neither camera has any here.
vec3 ComputeMotion(FViewConstants View, vec3 Relative, vec3 PreviousRelative)
{
	if (View.bHistory == 0u) { return vec3(0.0, 0.0, dot(View.CameraForward, Relative)); }
	vec4 Previous = View.PreviousRelativeToClip * vec4(PreviousRelative, 1.0);
	vec3 Motion = vec3(ClipToPixel(View, Previous) - ClipToPixel(View, View.RelativeToClip * vec4(Relative, 1.0)),
	                   dot(View.PreviousForward, PreviousRelative));
	// A point that was behind the previous camera or in front of its near plane had no position on the screen. The limit is
	// half of the near distance, so that points on the plane count as seen. Motion too large to represent is treated alike.
	bool bSeen = Motion.z > 0.5 * View.PreviousNear && all(lessThan(abs(Motion), vec3(1.0e9)));
	return bSeen ? Motion : vec3(-2.0 * vec2(View.Width, View.Height), 0.0);
}

#endif
