// What the pipeline and the ray-query path share: which rays a pixel casts. The includer defines
//   bool TraceSun(vec3 Origin, vec3 Direction)   true: nothing is in the way
#ifndef LANTERN_SUN_SHADOW_GLSL
#define LANTERN_SUN_SHADOW_GLSL

#include "../Shared/SunShadowTypes.h"
#include "../Library/Bindings.glsl"
#include "../Library/Random.glsl"
#include "../Library/Sun.glsl"
#include "../Library/View.glsl"

layout(push_constant, scalar) uniform FPush { FSunShadowConstants Push; };

bool TraceSun(vec3 Origin, vec3 Direction);

void ShadePixel(uvec2 Pixel)
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	if (any(greaterThanEqual(Pixel, uvec2(View.Width, View.Height)))) { return; }
	float Depth = texelFetch(Textures[Push.Depth], ivec2(Pixel), 0).x;
	if (Depth <= 0.0) // sky
	{
		imageStore(Images[Push.Output], ivec2(Pixel), vec4(1.0));
		return;
	}
	FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
	vec3 Ng = OctDecode(texelFetch(Textures[Push.Normals], ivec2(Pixel), 0).zw);
	vec3 Relative = RelativePositionFromDepth(View, Pixel, Depth);
	vec3 Origin = OffsetRayOrigin(View.CameraPosition + Relative, Ng, length(Relative) * 4.0);
	float Visible = 0.0;
	uint Seed = HashPcg(Pixel.x + HashPcg(Pixel.y + HashPcg(View.Seed)));
	for (uint Sample = 0; Sample < Push.SamplesPerPixel; ++Sample)
	{
		vec2 U = SobolOwen2(View.FrameIndex * Push.SamplesPerPixel + Sample, Seed);
		vec3 Direction = Push.bSoft != 0u ? SampleSunDirection(Scene, U) : -Scene.SunDirection;
		if (dot(Ng, Direction) > 0.0 && TraceSun(Origin, Direction)) { Visible += 1.0; }
	}
	imageStore(Images[Push.Output], ivec2(Pixel), vec4(Visible / float(Push.SamplesPerPixel)));
}

#endif
