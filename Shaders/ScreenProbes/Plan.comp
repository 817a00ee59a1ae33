// Places the probe of each tile, and plans where its rays go: where the surfaces of the tile look to, and where the last frame's probe there
// found light. A texel of 1/64 of the density has one ray for certain, and weaker ones have one by chance.
#version 460
#include "ScreenProbes.glsl"
#include "../Library/GBuffer.glsl"
#include "../Library/Motion.glsl"
#include "../Library/Random.glsl"
#include "../Library/Rgbe.glsl"

layout(local_size_x = SCREEN_PROBE_TEXELS) in;
layout(push_constant, scalar) uniform FPush { FScreenProbeConstants Push; };

const float LeastShare = 0.25; // of the rays that follow the cosine alone
const float SamePlace = 3.0;   // farthest that the probe of the last frame may be, over the width of a tile
const float SameNormal = 0.7;
const uint NoPixel = 0xffffffffu;

shared uint Nearest; // squared distance to where the probe should be << 16 | pixel of the tile
shared vec3 Normals[SCREEN_PROBE_TEXELS];
shared float Sums[SCREEN_PROBE_TEXELS];
shared uint Firsts[SCREEN_PROBE_TEXELS + 1];

// Returns where in its tile a probe should be, pixels. It wanders evenly ("The Unreasonable Effectiveness of Quasirandom Sequences",
// Roberts 2018).
vec2 WantedPlace(FViewConstants View, uvec2 Tile, uint Spacing)
{
	uint Hash = HashPcg(Tile.x + HashPcg(Tile.y + HashPcg(View.Seed)));
	vec2 Start = vec2(Hash & 0xffffu, Hash >> 16u) * (1.0 / 65536.0);
	return fract(Start + float(View.FrameIndex % 65536u) * vec2(0.7548776662, 0.5698402910)) * float(Spacing);
}

// Each thread looks at its part of the tile's pixels, and keeps the normal of one of them.
void FindPlace(FViewConstants View, FScreenProbeGrid Grid, uvec2 Tile, uint Thread)
{
	vec2 Wanted = WantedPlace(View, Tile, Grid.Spacing);
	Normals[Thread] = vec3(0.0);
	for (uint Place = Thread; Place < Grid.Spacing * Grid.Spacing; Place += ProbeTexels)
	{
		uvec2 InTile = uvec2(Place % Grid.Spacing, Place / Grid.Spacing), Pixel = Tile * Grid.Spacing + InTile;
		if (any(greaterThanEqual(Pixel, uvec2(View.Width, View.Height)))) { continue; }
		float Depth = LoadDepth(Push.Depth, ivec2(Pixel));
		if (Depth <= 0.0) { continue; }
		vec2 Off = vec2(InTile) + 0.5 - Wanted;
		atomicMin(Nearest, (min(uint(dot(Off, Off) * 4.0), 0xfffeu) << 16u) | Place);
		Normals[Thread] = LoadGBufferPoint(View, Push.Normals, ivec2(Pixel), Depth).BentN;
	}
}

// Returns the number of the last frame's probe where this one is, or NO_SCREEN_PROBE.
uint FindPrevious(FViewConstants View, FScreenProbeGrid Grid, FGBufferPoint Point, uvec2 Pixel, float Distance)
{
	vec3 Relative = Point.Relative;
	if (Grid.Previous == FAddress(0)) { return NO_SCREEN_PROBE; }
	vec3 Then = Relative + View.CameraMotion, Motion = ComputeMotion(View, Relative, Then);
	vec2 At = vec2(Pixel) + 0.5 + Motion.xy;
	if (Motion.z <= 0.0 || any(lessThan(At, vec2(0.0))) || any(greaterThanEqual(At, vec2(View.Width, View.Height)))) { return NO_SCREEN_PROBE; }
	uvec2 Tile = uvec2(At) / Grid.Spacing;
	uint Number = Tile.y * Grid.Columns + Tile.x;
	FScreenProbeRef Previous = FScreenProbeRef(Grid.Previous);
	float Farthest = SamePlace * float(Grid.Spacing) * PixelHeight(View, Distance);
	bool bSame = Previous.Data[Number].Distance > 0.0 && distance(Previous.Data[Number].Relative, Then) < Farthest &&
	             dot(UnpackOct(Previous.Data[Number].GeometricNormal), Point.Ng) > SameNormal;
	return bSame ? Number : NO_SCREEN_PROBE;
}

// Returns the sum over all texels. All threads call it.
float SumTexels(uint Thread, float Value)
{
	barrier();
	Sums[Thread] = Value;
	barrier();
	float Sum = 0.0;
	for (uint I = 0u; I < ProbeTexels; ++I) { Sum += Sums[I]; }
	return Sum;
}

// Returns the probability with which a ray goes to the thread's texel. Sum over all: 1, or 0 if no texel can be seen.
float FindDensity(FScreenProbeGrid Grid, uint Thread, vec3 GeometricNormal, uint Previous)
{
	vec3 Center = OctMapDirection(Thread, vec2(0.5));
	float Cosine = 0.0;
	for (uint I = 0u; I < ProbeTexels; ++I) { Cosine += Normals[I] != vec3(0.0) ? max(dot(Normals[I], Center) + TexelReach, 0.0) : 0.0; }
	Cosine *= dot(GeometricNormal, Center) > -TexelReach ? ProbeSolidAngle(Center) : 0.0;
	float Light = Previous == NO_SCREEN_PROBE ? 0.0 : Luminance(UnpackRgbe(FScreenProbeRef(Grid.Previous).Data[Previous].Light[Thread])) * Cosine;
	float Cosines = SumTexels(Thread, Cosine), Lights = SumTexels(Thread, Light);
	if (!(Cosines > 0.0)) { return 0.0; }
	bool bGuided = Lights > 0.0 && Lights < 1.0e30;
	return mix(bGuided ? Light / Lights : Cosine / Cosines, Cosine / Cosines, LeastShare);
}

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	FScreenProbeGrid Grid = FScreenProbeGridRef(Push.Grid).Data;
	uvec2 Tile = gl_WorkGroupID.xy;
	uint Thread = gl_LocalInvocationIndex, Number = Tile.y * Grid.Columns + Tile.x;
	if (Thread == 0u) { Nearest = NoPixel; }
	barrier();
	FindPlace(View, Grid, Tile, Thread);
	barrier();
	FScreenProbeRef Probes = FScreenProbeRef(Grid.Probes);
	if (Nearest == NoPixel)
	{
		if (Thread == 0u) { Probes.Data[Number].Distance = 0.0; }
		return;
	}
	uint Place = Nearest & 0xffffu;
	uvec2 Pixel = Tile * Grid.Spacing + uvec2(Place % Grid.Spacing, Place / Grid.Spacing);
	FGBufferPoint Point = LoadGBufferPoint(View, Push.Normals, ivec2(Pixel), LoadDepth(Push.Depth, ivec2(Pixel)));
	float Distance = dot(View.CameraForward, Point.Relative);
	uint Previous = FindPrevious(View, Grid, Point, Pixel, Distance);
	if (Thread == 0u)
	{
		Probes.Data[Number].Previous = Previous;
		Probes.Data[Number].Relative = Point.Relative;
		Probes.Data[Number].Distance = Distance;
		Probes.Data[Number].GeometricNormal = PackOct(Point.Ng);
		Probes.Data[Number].Pixel = Pixel.x | (Pixel.y << 16u);
	}
	float Density = FindDensity(Grid, Thread, Point.Ng, Previous);
	barrier();
	Sums[Thread] = Density;
	barrier();
	// Systematic sampling: rays stand evenly on the sum of densities, after a start by chance.
	float Before = 0.0, Start = float(HashPcg(Number + HashPcg(View.FrameIndex ^ HashPcg(View.Seed))) >> 8u) * (1.0 / 16777216.0);
	for (uint I = 0u; I < Thread; ++I) { Before += Sums[I]; }
	Firsts[Thread] = min(uint(max(ceil(Before * float(SCREEN_PROBE_TEXELS) - Start), 0.0)), ProbeTexels);
	if (Thread == 0u) { Firsts[SCREEN_PROBE_TEXELS] = ProbeTexels; }
	barrier();
	uint First = Firsts[Thread], Count = Firsts[Thread + 1u] - First;
	FScreenProbePlanRef Plans = FScreenProbePlanRef(Grid.Plans);
	Plans.Data[Number].Texels[Thread] = First | (Count << 8u);
	for (uint I = 0u; I < Count; ++I) { Plans.Data[Number].Rays[First + I] = Thread; }
}
