// Finds for each listed pixel what its reflection shows, as a guide for the filter, and where that was in the frame before.
//
// A mirror shows the virtual image of what it mirrors. The filter gets that image's surface in place of the mirror's own. The point that
// was hit moves back with its object, and the mirror with its own: reflected about the plane that the mirror had, the point lies where the
// image was. This is exact for plane mirrors, moving cameras, mirrors and objects that do not deform.
// A lobe that is not a mirror blurs the image: the filter gets the surface that reflects, but looks for its history where the image was.
// NO_REFLECTED_MOTION: planted fault (r.RT.Debug.Reflections.Motion).
#version 460
#include "../Shared/ReflectionTypes.h"
#include "../Library/GBuffer.glsl"
#include "../Library/History.glsl"
#include "../Library/Motion.glsl"
#include "../Library/MoveBack.glsl"
#include "../Rays/ThreadList.glsl"

layout(local_size_x = RAY_QUEUE_GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FReflectionSurfaceConstants Push; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FReflectionHitRef { FReflectionHit Data[]; };

const float SkyDistance = 1.0e5;     // metres, beyond which nothing seems to move
const float ImageRoughness = 0.3;    // rougher lobes show no image that could be followed
const float StandsStill = 0.5;       // pixels by which a surface may be off that has not moved

// What a reflecting pixel shows, relative to the cameras of both frames.
struct FMirror
{
	vec3 Now, Before;  // position
	vec3 NormalBefore; // shading normal
	bool bKnown;       // where it was
};

// Motion: a texel of FGBuffer::Motion.
FMirror FindMirror(FSceneConstants Scene, FViewConstants View, FGBufferPoint Point, vec4 Motion)
{
	uint Object = Push.bNamesObjects != 0u && Motion.w >= 1.0 ? uint(Motion.w) - 1u : NoObject;
	FMirror Mirror = FMirror(Point.Relative, Point.Relative + View.CameraMotion, Point.BentN, true);
	if (Push.Motion == NO_TEXTURE) { return Mirror; }
	Mirror.Before = MoveBack(Scene, View, Object, Point.Relative);
	Mirror.NormalBefore = TurnBack(Scene, View, Object, Point.BentN);
	// Hosts may move what they do not name, and bend what they name.
	Mirror.bKnown = distance(ComputeMotion(View, Mirror.Now, Mirror.Before).xy, Motion.xy) < StandsStill;
	return Mirror;
}

uvec2 FindImage(FViewConstants View, ivec2 Pixel, FSurface Surface, vec3 Motion)
{
	uvec2 Reprojection = FindReprojection(View, Push.PreviousSurface, uvec2(Pixel), UnpackSurface(PackSurface(Surface)), vec4(Motion, 0.0));
	return FindAnchor(View, Push.PreviousAnchors, Reprojection);
}

// Returns the motion of the image, with the distance that the mirror had where it was.
vec3 FollowOnMirror(FViewConstants View, FMirror Mirror, vec3 ImageBefore, vec3 Motion)
{
	float Reach = dot(Mirror.NormalBefore, ImageBefore), Share = dot(Mirror.NormalBefore, Mirror.Before) / (Reach != 0.0 ? Reach : 1.0);
	if (!(Share > 0.0 && Share <= 1.0) || View.bOrthographic != 0u) { return vec3(0.0); }
	return vec3(Motion.xy, Share * dot(View.PreviousForward, ImageBefore));
}

void main()
{
	uint Number = gl_GlobalInvocationID.y * (RAY_QUEUE_GROUP_SIZE * RAY_QUEUE_ROW_GROUPS) + gl_GlobalInvocationID.x, Thread;
	if (!FindThread(Push.List, Number, Thread)) { return; }
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
	ivec2 Pixel = ivec2(Thread % View.Width, Thread / View.Width);
	FReflectionHit Hit = FReflectionHitRef(Push.Hits).Data[Number];
	FGBufferPoint Point = LoadGBufferPoint(View, Push.Pixels.Normals, Pixel, LoadDepth(Push.Pixels.Depth, Pixel));
	vec4 Material = texelFetch(Textures[Push.Pixels.Material], Pixel, 0);
	vec4 Motion = Push.Motion != NO_TEXTURE ? texelFetch(Textures[Push.Motion], Pixel, 0) : vec4(0.0);
	bool bMirror = Material.x * Material.x < MinAlpha, bSky = Hit.Distance < 0.0;

	FMirror Mirror = FindMirror(Scene, View, Point, Motion);
	float Length = bSky ? SkyDistance : Hit.Distance;
	vec3 Met = Point.Relative + reflect(-Point.V, Point.BentN) * Length, Image = Point.Relative - Point.V * Length;
	vec3 MetBefore = bSky ? Met + View.CameraMotion : MoveBack(Scene, View, Hit.Object, Met);
#ifdef NO_REFLECTED_MOTION
	MetBefore = Met + View.CameraMotion;
#endif
	vec3 ImageBefore = MetBefore - 2.0 * dot(Mirror.NormalBefore, MetBefore - Mirror.Before) * Mirror.NormalBefore;
	vec3 ImageMotion = ComputeMotion(View, Image, ImageBefore);

	FSurface Surface = FSurface(dot(View.CameraForward, Point.Relative), Point.Ng, MakeIdentity(Motion.w));
	if (bMirror)
	{
		vec3 Normal = reflect(UnpackOct(Hit.Normal), Point.BentN);
		Surface = FSurface(bSky ? 0.0 : dot(View.CameraForward, Image), Normal, MakeIdentity(float(Hit.Object + 1u)));
	}
	uvec2 Anchor = uvec2(0u);
	if (Push.PreviousSurface != NO_TEXTURE && Surface.Distance > 0.0)
	{
		if (bMirror) { Anchor = Mirror.bKnown ? FindImage(View, Pixel, Surface, ImageMotion) : uvec2(0u); }
		else if (Material.x < ImageRoughness && Mirror.bKnown)
		{
			Anchor = FindImage(View, Pixel, Surface, FollowOnMirror(View, Mirror, ImageBefore, ImageMotion));
		}
		if (!bMirror && (Anchor.x & AnchorFound) == 0u)
		{
			vec3 Still = ComputeMotion(View, Mirror.Now, Mirror.Before);
			Anchor = FindImage(View, Pixel, Surface, Push.Motion != NO_TEXTURE ? Motion.xyz : Still);
		}
	}
	imageStore(Images[Push.OutSurface], Pixel, vec4(Surface.Distance > 0.0 ? PackSurface(Surface) : vec2(0.0), 0.0, 0.0));
	imageStore(UintImages[Push.OutAnchors], Pixel, uvec4(Anchor, 0u, 0u));
}
