// Limits and tints the diffuse indirect light of objects with a style. It runs behind the filter: it is no linear map, and the mean of many
// frames is what it has to see.
// REFERENCE: the light is the reference's sum, which is replaced.
#version 460
#include "../Shared/ToonTypes.h"
#include "../Library/GBuffer.glsl"
#include "../Library/Toon.glsl"

layout(local_size_x = TOON_GROUP_SIZE, local_size_y = TOON_GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FToonGradeConstants Push; };
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer FSampleSumRef { vec4 Data[]; };

#ifndef REFERENCE
// Returns the mean light of what has the pixel's style around it. The filter before it keeps edges of the surface, such as a nose. On a sphere
// there are none, and what is left of them would show.
vec3 SmoothOnSphere(FViewConstants View, ivec2 Pixel, uint Toon, vec3 Own)
{
	const int Reach = 2, Step = 6; // taps to each side, pixels
	const float Sharpness = 32.0;  // of the weight by the angle between normals
	vec3 N = OctDecode(texelFetch(Textures[Push.Normals], Pixel, 0).xy), Sum = Own;
	float Weights = 1.0;
	for (int I = 0; I < (2 * Reach + 1) * (2 * Reach + 1); ++I)
	{
		ivec2 Offset = ivec2(I % (2 * Reach + 1), I / (2 * Reach + 1)) - Reach, Tap = Pixel + Step * Offset;
		if (Offset == ivec2(0) || any(lessThan(Tap, ivec2(0))) || IsOutsideView(View, uvec2(Tap))) { continue; }
		if (ToonOfPixel(texelFetch(Textures[Push.Pixels], Tap, 0).xy) != Toon) { continue; }
		float Cosine = max(dot(N, OctDecode(texelFetch(Textures[Push.Normals], Tap, 0).xy)), 0.0);
		float Weight = exp(-0.5 * dot(vec2(Offset), vec2(Offset))) * pow(Cosine, Sharpness);
		Sum += Weight * texelFetch(Textures[Push.Signal], Tap, 0).rgb;
		Weights += Weight;
	}
	return Sum / Weights;
}
#endif

vec3 Grade(FViewConstants View, ivec2 Pixel, float Depth, uint Toon, vec3 L)
{
	if (Push.bHorizon != 0u)
	{
		FGBufferPoint Point = LoadGBufferPoint(View, Push.Normals, Pixel, Depth);
		L *= ToonHorizon(Point.BentN, Point.Ng);
	}
	return GradeToonLight(LoadToon(FSceneRef(Push.Pass.Scene).Data, Toon), L, View.Exposure);
}

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	ivec2 Pixel = ivec2(gl_GlobalInvocationID.xy);
	if (IsOutsideView(View, uvec2(Pixel))) { return; }
	float Depth = LoadDepth(Push.Depth, Pixel);
	vec2 Texel = texelFetch(Textures[Push.Pixels], Pixel, 0).xy;
	uint Toon = ToonOfPixel(Texel);
#ifdef REFERENCE
	uint Index = uint(Pixel.y) * View.Width + uint(Pixel.x);
	FSampleSumRef Sum = FSampleSumRef(Push.Sum);
	vec4 Samples = Sum.Data[Index];
	if (Toon != 0u && Samples.a > 0.0) { Sum.Data[Index].rgb = Grade(View, Pixel, Depth, Toon, Samples.rgb / Samples.a) * Samples.a; }
#else
	vec4 L = texelFetch(Textures[Push.Signal], Pixel, 0);
	if (Push.bFiltered != 0u && Toon != 0u && Texel.x > 0.0) { L.rgb = SmoothOnSphere(View, Pixel, Toon, L.rgb); }
	imageStore(Images[Push.Output], Pixel, Toon != 0u ? RoundToHalf(vec4(Grade(View, Pixel, Depth, Toon, L.rgb), L.a)) : L);
#endif
}
