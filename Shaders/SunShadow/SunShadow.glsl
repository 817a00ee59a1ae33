// What the pipeline and the ray-query path share: which rays a pixel casts. The includer defines
//   float TraceSun(vec3 Origin, vec3 Direction)   distance to what is in the way; negative: nothing is
// WITH_PENUMBRA: how wide the penumbra of what is in the way is, is told, too.
// ONE_SAMPLE: SamplesPerPixel is known to be 1. Without the loop nothing but the pixel lives across the trace.
#ifndef LANTERN_SUN_SHADOW_GLSL
#define LANTERN_SUN_SHADOW_GLSL

#include "../Shared/SunShadowTypes.h"
#include "../Library/Bindings.glsl"
#include "../Library/Random.glsl"
#include "../Library/Sun.glsl"
#include "../Library/View.glsl"

layout(push_constant, scalar) uniform FPush { FSunShadowConstants Push; };

float TraceSun(vec3 Origin, vec3 Direction);

#ifdef ONE_SAMPLE
const uint SamplesPerPixel = 1u;
#else
#define SamplesPerPixel Push.SamplesPerPixel
#endif

void StorePenumbra(uvec2 Pixel, float Penumbra)
{
#ifdef WITH_PENUMBRA
	if (Push.OutPenumbra != NO_TEXTURE) { imageStore(Images[Push.OutPenumbra], ivec2(Pixel), vec4(min(Penumbra, 65504.0))); }
#endif
}

void ShadePixel(uvec2 Pixel)
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	if (any(greaterThanEqual(Pixel, uvec2(View.Width, View.Height)))) { return; }
	float Depth = texelFetch(Textures[Push.Depth], ivec2(Pixel), 0).x;
	if (Depth <= 0.0) // sky
	{
		imageStore(Images[Push.Output], ivec2(Pixel), vec4(1.0));
		StorePenumbra(Pixel, 0.0);
		return;
	}
	FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
	vec3 Ng = OctDecode(texelFetch(Textures[Push.Normals], ivec2(Pixel), 0).zw);
	vec3 Relative = RelativePositionFromDepth(View, Pixel, Depth);
	vec3 Origin = RasterRayOrigin(Scene, View, Relative, Ng);
	float Visible = 0.0, Blockers = 0.0, Blocked = 0.0;
	FTileSequence Sequence = MakeTileSequence(Pixel, View.FrameIndex, HashPcg(View.Seed));
	for (uint Sample = 0; Sample < SamplesPerPixel; ++Sample)
	{
		vec3 Direction = -Scene.SunDirection;
		if (Push.bSoft != 0u) { Direction = SampleSunDirection(Scene, SobolOwen2(Sequence.Index * SamplesPerPixel + Sample, Sequence.Seed)); }
		if (dot(Ng, Direction) <= 0.0) { continue; }
		float Blocker = TraceSun(Origin, Direction);
		Visible += Blocker < 0.0 ? 1.0 : 0.0;
		Blocked += Blocker < 0.0 ? 0.0 : 1.0;
		Blockers += max(Blocker, 0.0);
	}
	imageStore(Images[Push.Output], ivec2(Pixel), vec4(Visible / float(SamplesPerPixel)));
	// The disk's diameter, as the blockers' edges draw it on the surface, in pixels; 0: nothing is in the way. Of the surface's
	// own horizon nothing is known.
	float Diameter = 2.0 * sqrt(2.0 * Scene.SunOneMinusCos);
	float Penumbra = Visible < float(SamplesPerPixel) ? 1.0e-3 : 0.0;
	if (Blocked > 0.0) { Penumbra = Diameter * Blockers / Blocked * abs(dot(Ng, normalize(Relative))) / (PixelAngle(View) * (View.Near / Depth)); }
	StorePenumbra(Pixel, Penumbra);
}

#endif
