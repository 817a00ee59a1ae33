// Contact shadows: what casts no rays, because it is too small on the screen or not in the scene, still shadows what it stands on.
#ifndef LANTERN_CONTACT_GLSL
#define LANTERN_CONTACT_GLSL

#include "../Shared/ContactTypes.h"
#include "../Library/GBuffer.glsl"
#include "../Library/Motion.glsl"
#include "../Library/Random.glsl"

const uint ContactSteps = 8u;
const float ContactReach = 0.3;     // metres
const float ContactThickness = 0.1; // of what is seen, metres

// Whether what a pixel shows, at a position relative to the camera, casts no sun rays.
bool CastsNoRays(FContactConstants Contact, FSceneConstants Scene, ivec2 Pixel, vec3 Relative)
{
	float Number = Contact.Motion == NO_TEXTURE ? 0.0 : texelFetch(Textures[Contact.Motion], Pixel, 0).w;
	if (!(Number >= 1.0)) { return Contact.bUnnumbered != 0u; }
	uint Object = uint(Number) - 1u;
	return Object < Contact.ObjectCount && length(Relative) > FObjectRef(Scene.Objects).Data[Object].CasterRadius * Contact.DistanceOfRadius;
}

// Marches through depth towards the sun. Returns the distance of what is in the way, metres; negative: nothing is.
float FindContact(FContactConstants Contact, FSceneConstants Scene, FViewConstants View, uint Depths, uvec2 Pixel, FGBufferPoint Point)
{
	float Distance = dot(View.CameraForward, Point.Relative), Bias = 0.5 * PixelHeight(View, Distance);
	vec3 Start = Point.Relative + Point.Ng * (2.0 * Bias);
	float Jitter = float(HashPcg(Pixel.x + 8191u * Pixel.y + 131071u * View.FrameIndex) >> 8u) / 16777216.0;
	[[dont_unroll]] for (uint Step = 0u; Step < ContactSteps; ++Step)
	{
		float Along = ContactReach * (float(Step) + Jitter) / float(ContactSteps);
		vec3 At = Start - Scene.SunDirection * Along;
		vec4 Clip = View.RelativeToClip * vec4(At, 1.0);
		if (Clip.w <= 0.0) { break; }
		ivec2 Seen = ivec2(floor(ClipToPixel(View, Clip + vec4(View.ClipJitter * Clip.w, 0.0, 0.0))));
		if (any(lessThan(Seen, ivec2(0))) || any(greaterThanEqual(Seen, ivec2(View.Width, View.Height)))) { break; }
		float Depth = LoadDepth(Depths, Seen);
		if (Depth <= 0.0) { continue; }
		float Behind = dot(View.CameraForward, At) - DistanceFromDepth(View, Depth);
		if (Behind < Bias || Behind > ContactThickness) { continue; }
		if (CastsNoRays(Contact, Scene, Seen, RelativePositionFromDepth(View, uvec2(Seen), Depth))) { return Along; }
	}
	return -1.0;
}

#endif
