// Gives each pixel what the pixels of the half frame around it have found, those on its plane alone, and the more the more alike their shading
// normals are (Kopf et al. 2007, "Joint Bilateral Upsampling").
// SECOND_LOBE: two signals. NO_PLANES: planted fault (r.RT.Debug.HalfFrame.Planes).
#version 460
#include "../Shared/HalfFrameTypes.h"
#include "HalfPixel.glsl"

layout(local_size_x = HALF_FRAME_GROUP_SIZE, local_size_y = HALF_FRAME_GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FHalfUpsampleConstants Push; };

struct FSums
{
	vec4 Values[2];
	float Weight;
};

void AddSite(ivec2 HalfPixel, float Weight, inout FSums Sums)
{
	Sums.Values[0] += Weight * texelFetch(Textures[Push.Inputs[0]], HalfPixel, 0);
#ifdef SECOND_LOBE
	Sums.Values[1] += Weight * texelFetch(Textures[Push.Inputs[1]], HalfPixel, 0);
#endif
	Sums.Weight += Weight;
}

// Returns by how much a site counts for a pixel, 0 to 1.
float GetLikeness(FViewConstants View, FGBufferPoint Point, FGBufferPoint Site)
{
#ifdef NO_PLANES
	return 1.0;
#else
	float Facing = dot(Point.Ng, Site.Ng);
	vec3 To = Site.Relative - Point.Relative;
	float Slack = 0.5 * PixelHeight(View, dot(View.CameraForward, Point.Relative));
	if (Facing < 0.8 || abs(dot(Point.Ng, To)) > 0.1 * length(To) + Slack) { return 0.0; }
	float Alike = max(dot(Point.N, Site.N), 0.0);
	return Alike * Alike * Alike * Alike + 1.0e-3;
#endif
}

// Adds the sites within a square that show a surface: those of the pixel's plane, or, without bPlane, all alike.
void AddSites(FViewConstants View, ivec2 Pixel, FGBufferPoint Point, ivec2 First, int Side, bool bPlane, inout FSums Sums)
{
	for (int I = 0; I < Side * Side; ++I)
	{
		ivec2 HalfPixel = First + ivec2(I % Side, I / Side);
		if (any(lessThan(HalfPixel, ivec2(0))) || any(greaterThanEqual(uvec2(HalfPixel), HalfSizeOf(View)))) { continue; }
		float Depth;
		ivec2 Source = FindHalfSource(View, Push.Depth, HalfPixel, Depth);
		if (Depth <= 0.0) { continue; }
		vec2 Step = max(1.0 - abs(vec2(Pixel - HalfPixel * 2)) * 0.5, vec2(0.0));
		float Weight = bPlane ? Step.x * Step.y * GetLikeness(View, Point, LoadGBufferPoint(View, Push.Normals, Source, Depth)) : 1.0;
		if (Weight > 0.0) { AddSite(HalfPixel, Weight, Sums); }
	}
}

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	ivec2 Pixel = ivec2(gl_GlobalInvocationID.xy);
	if (IsOutsideView(View, uvec2(Pixel))) { return; }
	FSums Sums = FSums(vec4[2](vec4(0.0), vec4(0.0)), 0.0);
	float Depth = LoadDepth(Push.Depth, Pixel);
	if (Depth > 0.0)
	{
		FGBufferPoint Point = LoadGBufferPoint(View, Push.Normals, Pixel, Depth);
		ivec2 First = Pixel >> 1;
		AddSites(View, Pixel, Point, First, 2, true, Sums);
		// What lies alone on its plane takes what there is.
		if (Sums.Weight == 0.0) { AddSites(View, Pixel, Point, First, 2, false, Sums); }
		if (Sums.Weight == 0.0) { AddSites(View, Pixel, Point, First - 1, 4, false, Sums); }
	}
	for (int I = 0; I < 2; ++I)
	{
		if (Push.Outputs[I] == NO_TEXTURE) { continue; }
		imageStore(Images[Push.Outputs[I]], Pixel, RoundToHalf(Sums.Values[I] / max(Sums.Weight, 1.0e-20)));
	}
}
