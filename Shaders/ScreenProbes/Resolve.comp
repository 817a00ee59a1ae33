// Finds the mean of what the rays of each probe's texels have found. It takes the place of the plan.
#version 460
#include "ScreenProbes.glsl"
#include "../Library/Random.glsl"
#include "../Library/Rgbe.glsl"

layout(local_size_x = SCREEN_PROBE_TEXELS) in;
layout(push_constant, scalar) uniform FPush { FScreenProbeConstants Push; };

void main()
{
	FScreenProbeGrid Grid = FScreenProbeGridRef(Push.Grid).Data;
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	uint Texel = gl_LocalInvocationIndex, Number = gl_WorkGroupID.y * Grid.Columns + gl_WorkGroupID.x;
	if (FScreenProbeRef(Grid.Probes).Data[Number].Distance <= 0.0) { return; }
	FScreenProbePlanRef Plans = FScreenProbePlanRef(Grid.Plans);
	uint Plan = Plans.Data[Number].Texels[Texel], First = Plan & 0xffu, Planned = Plan >> 8u, Traced = 0u;
	vec3 Sum = vec3(0.0);
	float Inverse = 0.0;
	for (uint I = 0u; I < Planned; ++I)
	{
		FScreenProbeRay Ray = FScreenProbeRayRef(Grid.Rays).Data[Number * ProbeTexels + First + I];
		if (!(Ray.Distance > 0.0)) { continue; } // below the surface
		Sum += Ray.Radiance;
		Inverse += 1.0 / Ray.Distance;
		++Traced;
	}
	vec3 U = vec3(HashPcg4(uvec4(Number, Texel, View.FrameIndex, View.Seed)).xyz >> 8u) * (1.0 / 16777216.0);
	float Rays = float(max(Traced, 1u));
	Plans.Data[Number].Texels[Texel] = PackRgbe(Sum / Rays, U);
	Plans.Data[Number].Rays[Texel] = Traced | (packHalf2x16(vec2(min(Inverse / Rays, 1.0e4), 0.0)) << 16u);
}
