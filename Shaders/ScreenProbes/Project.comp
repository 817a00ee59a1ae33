// Finds each probe's radiance, and the irradiance of surfaces by their normals. Probes around it on its plane share what they have found.
// Harmonics of nine terms took less memory, but let bright light from near the horizon through: it is 9 % of a light there, and more than all
// else in dark places ("An Efficient Representation for Irradiance Environment Maps", Ramamoorthi & Hanrahan 2001).
#version 460
#include "ScreenProbes.glsl"
#include "../Library/Random.glsl"
#include "../Library/Rgbe.glsl"
#include "../Library/View.glsl"

layout(local_size_x = SCREEN_PROBE_TEXELS) in;
layout(push_constant, scalar) uniform FPush { FScreenProbeConstants Push; };

const float PastShare = 0.25;
const float PlaneReach = 0.5; // farthest from the plane, over the width of a tile there

shared vec3 Light[SCREEN_PROBE_TEXELS];
shared vec4 Parts[4 * SCREEN_PROBE_TEXELS]; // of texels: direction and solid angle

// Returns how much a texel of a neighbour's map says of this one's.
float CompareProbe(FScreenProbe Its, FScreenProbe Own, uint Texel, float TileWidth)
{
	if (Its.Distance <= 0.0) { return 0.0; }
	vec3 Normal = UnpackOct(Own.GeometricNormal), To = Its.Relative - Own.Relative;
	vec3 ItsNormal = UnpackOct(Its.GeometricNormal);
	if (dot(ItsNormal, OctMapDirection(Texel, vec2(0.5))) < TexelReach) { return 0.0; } // below its surface it sees nothing
	float Away = dot(Normal, To) / (PlaneReach * TileWidth), Facing = max(dot(Normal, ItsNormal), 0.0);
	return exp(-Away * Away) * Facing * Facing;
}

// Returns how much of what a neighbour saw through a texel is seen through the same texel from here: what is near lies elsewhere.
float CompareHit(FScreenProbe Its, FScreenProbe Own, uint Texel, float Inverse)
{
	const float LeastCosine = 0.94; // of half a texel
	vec3 Direction = OctMapDirection(Texel, vec2(0.5)), From = Direction + (Its.Relative - Own.Relative) * Inverse;
	return clamp((dot(Direction, From) * inversesqrt(max(dot(From, From), 1.0e-12)) - LeastCosine) / (1.0 - LeastCosine), 0.0, 1.0);
}

// Returns the mean of a probe's rays in all texels.
vec3 MeanOfRays(FScreenProbeGrid Grid, uint Number)
{
	FScreenProbePlanRef Plans = FScreenProbePlanRef(Grid.Plans);
	vec3 Sum = vec3(0.0);
	float Rays = 0.0;
	for (uint I = 0u; I < ProbeTexels; ++I)
	{
		float Its = float(Plans.Data[Number].Rays[I] & 0xffffu);
		Sum += Its * UnpackRgbe(Plans.Data[Number].Texels[I]);
		Rays += Its;
	}
	return Sum / max(Rays, 1.0);
}

// The mean of rays, and of the last frame's light, which alone counts where this frame has no rays. Its share must not depend on their number:
// rays follow light, so that what is too dark by chance would stay so.
vec3 GatherLight(FViewConstants View, FScreenProbeGrid Grid, ivec2 Tile, uint Texel)
{
	const float Kernel[3] = float[3](0.5, 1.0, 0.5);
	FScreenProbeRef Probes = FScreenProbeRef(Grid.Probes);
	uint Number = uint(Tile.y) * Grid.Columns + uint(Tile.x);
	FScreenProbe Own = Probes.Data[Number];
	float TileWidth = float(Grid.Spacing) * PixelHeight(View, Own.Distance);
	vec3 Sum = vec3(0.0);
	float Weights = 0.0;
	for (int I = 0; I < 9; ++I)
	{
		ivec2 At = Tile + ivec2(I % 3, I / 3) - 1;
		if (any(lessThan(At, ivec2(0))) || any(greaterThanEqual(At, ivec2(Grid.Columns, Grid.Rows)))) { continue; }
		uint Its = uint(At.y) * Grid.Columns + uint(At.x);
		float Weight = Kernel[I % 3] * Kernel[I / 3];
		if (I != 4) { Weight *= CompareProbe(Probes.Data[Its], Own, Texel, TileWidth); }
		if (!(Weight > 0.0)) { continue; }
		uint Rays = FScreenProbePlanRef(Grid.Plans).Data[Its].Rays[Texel];
		Weight *= float(Rays & 0xffffu);
		if (I != 4) { Weight *= CompareHit(Probes.Data[Its], Own, Texel, unpackHalf2x16(Rays >> 16u).x); }
		if (!(Weight > 0.0)) { continue; }
		Sum += Weight * UnpackRgbe(FScreenProbePlanRef(Grid.Plans).Data[Its].Texels[Texel]);
		Weights += Weight;
	}
	vec3 Mean = Weights > 0.0 ? Sum / Weights : MeanOfRays(Grid, Number);
	if (Own.Previous == NO_SCREEN_PROBE) { return Mean; }
	vec3 Past = UnpackRgbe(FScreenProbeRef(Grid.Previous).Data[Own.Previous].Light[Texel]);
	return mix(Mean, Past, Weights > 0.0 ? PastShare : 1.0);
}

// A probe sees nothing below its own surface. The mean of what it sees stands in for that, unless it is most of what the normal faces: such
// surfaces are others.
vec3 FindIrradiance(vec3 Normal, vec3 GeometricNormal)
{
	const float LeastSeen = 0.85;
	vec3 Sum = vec3(0.0);
	float Seen = 0.0, All = 0.0;
	for (uint I = 0u; I < 4u * ProbeTexels; ++I)
	{
		float Weight = max(dot(Parts[I].xyz, Normal), 0.0) * Parts[I].w;
		All += Weight;
		if (dot(Parts[I].xyz, GeometricNormal) <= 0.0) { continue; }
		Seen += Weight;
		Sum += Weight * Light[I >> 2u];
	}
#ifdef NO_UNSEEN // r.RT.Debug.GI.Unseen
	return Sum / All;
#else
	return Sum / max(Seen, LeastSeen * All);
#endif
}

void main()
{
	FScreenProbeGrid Grid = FScreenProbeGridRef(Push.Grid).Data;
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	uint Texel = gl_LocalInvocationIndex, Number = gl_WorkGroupID.y * Grid.Columns + gl_WorkGroupID.x;
	if (FScreenProbeRef(Grid.Probes).Data[Number].Distance <= 0.0) { return; }
	Light[Texel] = GatherLight(View, Grid, ivec2(gl_WorkGroupID.xy), Texel);
	vec3 U = vec3(HashPcg4(uvec4(Number, Texel, View.FrameIndex, View.Seed + 1u)).xyz >> 8u) * (1.0 / 16777216.0);
	FScreenProbeRef(Grid.Probes).Data[Number].Light[Texel] = PackRgbe(Light[Texel], U);
	for (uint I = 0u; I < 4u; ++I)
	{
		vec3 Direction = OctMapDirection(Texel, (vec2(I & 1u, I >> 1u) + 0.5) / 2.0);
		Parts[4u * Texel + I] = vec4(Direction, ProbeSolidAngle(Direction));
	}
	barrier();
	vec3 GeometricNormal = UnpackOct(FScreenProbeRef(Grid.Probes).Data[Number].GeometricNormal);
	vec2 Place = (vec2(Texel % SCREEN_PROBE_SIDE, Texel / SCREEN_PROBE_SIDE) + 0.5) / float(SCREEN_PROBE_SIDE);
	vec3 Irradiance = FindIrradiance(MakeBasis(GeometricNormal) * IrradianceNormal(Place), GeometricNormal);
	FScreenProbeRef(Grid.Probes).Data[Number].Irradiance[Texel] = PackRgbe(Irradiance, U.zxy);
}
