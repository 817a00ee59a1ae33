// Gives each pixel what the pixels of the half frame around it have found (Kopf et al. 2007, "Joint Bilateral Upsampling"). Those on its plane
// count alone, and the more, the more alike their shading normals are.
// SECOND_LOBE: two signals. BACK_PIXELS: see GBuffer.glsl. NO_PLANES: planted fault (r.RT.Debug.HalfFrame.Planes).
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
	if (Point.bBack != Site.bBack) { return 0.0; } // the light of one side is not that of two
	float Facing = dot(Point.Ng, Site.Ng);
	vec3 To = Site.Relative - Point.Relative;
	float Slack = 0.5 * PixelHeight(View, dot(View.CameraForward, Point.Relative));
	if (Facing < 0.8 || abs(dot(Point.Ng, To)) > 0.1 * length(To) + Slack) { return 0.0; }
	float Alike = max(dot(Point.N, Site.N), 0.0);
	return Alike * Alike * Alike * Alike + 1.0e-3;
#endif
}

// Adds the sites around a pixel that show a surface: those of its plane, or, without bPlane, all alike.
void AddSites(FViewConstants View, ivec2 Pixel, FGBufferPoint Point, bool bPlane, inout FSums Sums)
{
	for (int I = 0; I < 4; ++I)
	{
		ivec2 HalfPixel = (Pixel >> 1) + ivec2(I & 1, I >> 1);
		vec2 Step = max(1.0 - abs(vec2(Pixel - HalfPixel * 2)) * 0.5, vec2(0.0));
		float Weight = bPlane ? Step.x * Step.y : 1.0, Depth;
		if (Weight == 0.0 || any(greaterThanEqual(uvec2(HalfPixel), HalfSizeOf(View)))) { continue; }
		ivec2 Source = FindHalfSource(View, Push.Depth, HalfPixel, Depth);
		if (Depth <= 0.0) { continue; }
		if (bPlane) { Weight *= GetLikeness(View, Point, LoadGBufferPoint(View, Push.Normals, Source, Depth)); }
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
		AddSites(View, Pixel, Point, true, Sums);
		if (Sums.Weight == 0.0) { AddSites(View, Pixel, Point, false, Sums); } // alone on its plane: its 2×2 has a site at least
	}
	for (int I = 0; I < 2; ++I)
	{
		if (Push.Outputs[I] == NO_TEXTURE) { continue; }
		imageStore(Images[Push.Outputs[I]], Pixel, RoundToHalf(Sums.Values[I] / max(Sums.Weight, 1.0e-20)));
	}
}
