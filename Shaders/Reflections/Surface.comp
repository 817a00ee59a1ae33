// Finds for each listed pixel what its reflection shows, as a guide for the filter, and where that was in the frame before.
//
// A mirror shows the virtual image of what it mirrors. The filter gets that image's surface in place of the mirror's own. The point that
// was hit moves back with its object, and the mirror with its own: reflected about the plane that the mirror had, the point lies where the
// image was. This is exact for plane mirrors, moving cameras, mirrors and objects that do not deform. Curved.glsl has the others.
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

#include "Curved.glsl"

const float SkyDistance = 1.0e5;     // metres, beyond which nothing seems to move
const float ImageRoughness = 0.3;    // rougher lobes show no image that could be followed
const float StandsStill = 0.5;       // pixels by which a surface may be off that has not moved

// What a reflecting pixel shows, relative to the cameras of both frames.
struct FMirror
{
	vec3 Now, Before;  // position
	vec3 NormalBefore; // shading normal
	bool bKnown;       // where it was
	uint Object;       // into FObjectData[], or NoObject
};

// Where a pixel's reflection was.
struct FImage
{
	vec3 Position;     // relative to the previous camera
	vec3 Mirror;       // place of the mirror that showed it
	vec2 Rest;         // see FCurvedImage
	float Spread;
	bool bKnown;
};

// Motion: a texel of FGBuffer::Motion.
FMirror FindMirror(FSceneConstants Scene, FViewConstants View, FGBufferPoint Point, vec4 Motion)
{
	uint Object = Push.bNamesObjects != 0u && Motion.w >= 1.0 ? uint(Motion.w) - 1u : NoObject;
	FMirror Mirror = FMirror(Point.Relative, Point.Relative + View.CameraMotion, Point.BentN, true, Object);
	if (Push.Motion == NO_TEXTURE) { return Mirror; }
	Mirror.Before = MoveBack(Scene, View, Object, Point.Relative);
	Mirror.NormalBefore = TurnBack(Scene, View, Object, Point.BentN);
	// Hosts may move what they do not name, and bend what they name.
	Mirror.bKnown = distance(ComputeMotion(View, Mirror.Now, Mirror.Before).xy, Motion.xy) < StandsStill;
	return Mirror;
}

// MetBefore: what the pixel shows, relative to the previous camera. Length: from the mirror to it, metres.
FImage FindImage(FSceneConstants Scene, FViewConstants View, FGBufferPoint Point, ivec2 Pixel, FMirror Mirror, float Roughness, vec4 Motion,
                 vec3 MetBefore, float Length)
{
	bool bNamed = Push.bNamesObjects != 0u && Push.Motion != NO_TEXTURE;
	FMirrorPatch Patch = FMirrorPatch(Mirror.Object, Motion.w, Roughness, Point.BentN, bNamed);
	float Reach = Length + length(Point.Relative);
	FCurvedImage Curved = FindInCurvedMirror(Scene, View, Patch, Pixel, MetBefore, Length, Reach);
	if (Curved.bFlat)
	{
		vec3 Position = MetBefore - 2.0 * dot(Mirror.NormalBefore, MetBefore - Mirror.Before) * Mirror.NormalBefore;
		float Far = dot(Mirror.NormalBefore, Position), Share = dot(Mirror.NormalBefore, Mirror.Before) / (Far != 0.0 ? Far : 1.0);
		bool bBehind = Share > 0.0 && Share <= 1.0 && View.bOrthographic == 0u;
		return FImage(Position, bBehind ? Share * Position : vec3(0.0), vec2(0.0), 1.0, Mirror.bKnown);
	}
	vec3 From = View.bOrthographic != 0u ? View.PreviousForward : normalize(Curved.Position);
	vec3 Position = Curved.Position + From * distance(MetBefore, Curved.Position);
	return FImage(Position, Curved.Position, Curved.Rest, Curved.Spread, Mirror.bKnown && Curved.bFound);
}

// Returns how far, in pixels, the filter may reach: a quarter of the width that the lobe has where it meets what it shows. Near a contact
// that is narrow. Three quarters of a lobe of small α are within 6.9 α radians.
float FindReach(FViewConstants View, vec4 Material, float Length, float Distance)
{
	const float WidthOfLobe = 6.9, Share = 0.25, NoLimit = 65504.0;
	float Alpha = Material.x * Material.x;
	if (Alpha < MinAlpha || View.bOrthographic != 0u) { return NoLimit; } // a mirror's surfaces say it
	return clamp(Share * WidthOfLobe * Alpha * Length / ((Length + Distance) * View.PixelSize), 1.0e-3, NoLimit);
}

uvec2 FindHistory(FViewConstants View, ivec2 Pixel, FSurface Surface, vec3 Motion, float Spread)
{
	FSurface Stored = UnpackSurface(PackSurface(Surface));
	uvec2 Reprojection = FindReprojection(View, Push.PreviousSurface, uvec2(Pixel), Stored, vec4(Motion, 0.0), Spread);
	return FindAnchor(View, Push.PreviousAnchors, Reprojection);
}

// For r.RT.Debug.View. Red and green: from where the image came, 128 / 255 where it stood still, an eighth of a pixel each step. Blue: it
// was not found in a curved mirror.
void ShowMotion(ivec2 Pixel, FImage Image, vec3 Motion, bool bLooked)
{
	if (Push.Picture == NO_TEXTURE) { return; }
	vec2 Steps = clamp(round(Motion.xy * 8.0) + 128.0, vec2(1.0), vec2(255.0)) / 255.0;
	vec3 Color = Image.bKnown && Motion.z > 0.0 ? vec3(Steps, 0.0) : vec3(0.0, 0.0, 1.0);
	imageStore(Images[Push.Picture], Pixel, vec4(bLooked ? Color : vec3(0.0), 1.0));
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
	// The sky in a mirror is not filtered.
	bool bAsked = Push.Picture != NO_TEXTURE || (Push.PreviousSurface != NO_TEXTURE && !(bMirror && bSky));
	bool bLooked = bAsked && (bMirror || Material.x < ImageRoughness);
	FImage Before = FImage(vec3(0.0), vec3(0.0), vec2(0.0), 1.0, false);
	if (bLooked) { Before = FindImage(Scene, View, Point, Pixel, Mirror, Material.x, Motion, MetBefore, Length); }
	vec3 ImageMotion = ComputeMotion(View, Image, Before.Position) + vec3(Before.Rest, 0.0);
	ShowMotion(Pixel, Before, ImageMotion, bLooked);

	FSurface Surface = FSurface(dot(View.CameraForward, Point.Relative), Point.Ng, MakeIdentity(Motion.w));
	if (bMirror)
	{
		vec3 Normal = reflect(UnpackOct(Hit.Normal), Point.BentN);
		Surface = FSurface(bSky ? 0.0 : dot(View.CameraForward, Image), Normal, MakeIdentity(float(Hit.Object + 1u)));
	}
	uvec2 Anchor = uvec2(0u);
	if (Push.PreviousSurface != NO_TEXTURE && Surface.Distance > 0.0)
	{
		// Lobes that are no mirrors have the distance that the mirror had there.
		if (!bMirror) { ImageMotion.z = dot(View.PreviousForward, Before.Mirror); }
		if (Before.bKnown) { Anchor = FindHistory(View, Pixel, Surface, ImageMotion, bMirror ? Before.Spread : 1.0); }
		if (!bMirror && (Anchor.x & AnchorFound) == 0u)
		{
			vec3 Still = ComputeMotion(View, Mirror.Now, Mirror.Before);
			Anchor = FindHistory(View, Pixel, Surface, Push.Motion != NO_TEXTURE ? Motion.xyz : Still, 1.0);
		}
	}
	imageStore(Images[Push.OutSurface], Pixel, vec4(Surface.Distance > 0.0 ? PackSurface(Surface) : vec2(0.0), 0.0, 0.0));
	imageStore(UintImages[Push.OutAnchors], Pixel, uvec4(Anchor, 0u, 0u));
	imageStore(Images[Push.OutReach], Pixel, vec4(FindReach(View, Material, Length, length(Point.Relative)), 0.0, 0.0, 0.0));
}
