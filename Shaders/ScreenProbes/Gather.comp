// Lights each pixel by the four probes around it: diffuse by their irradiance, a specular lobe by their maps. What short rays of pixels have met
// replaces what the probes believe to be there: a control variate, so that contact shadows and nearby colours come back without darkening
// anything twice.
#version 460
#include "Near.glsl"
#include "../Library/BrdfSample.glsl"
#include "../Library/Planes.glsl"
#include "../Library/Rgbe.glsl"
#ifdef SECOND_LOBE
#include "../Rays/SecondLobe.glsl"
#endif

layout(local_size_x = TILE_SIZE, local_size_y = TILE_SIZE) in;
layout(push_constant, scalar) uniform FPush { FScreenProbeConstants Push; };

const float MaxHalf = 65504.0;
const float LeastWeight = 1.0e-4;   // of a probe that lies elsewhere: where there is no other, it must do
const float PlaneReach = 0.25;      // over the width of a tile at the pixel's distance
const uint LobeSamples = 2u;

struct FProbeChoice
{
	uint Numbers[4];
	float Weights[4]; // sum 1; all 0: there is no probe
};

// Returns how well a probe knows the light of a pixel's surface, 0 to 1. TileWidth: metres, at the pixel.
float FitProbe(FScreenProbeGrid Grid, uint Number, FGBufferPoint Point, float TileWidth)
{
	FScreenProbeRef Probes = FScreenProbeRef(Grid.Probes);
	if (Probes.Data[Number].Distance <= 0.0) { return 0.0; }
	float Away = dot(Point.Ng, Probes.Data[Number].Relative - Point.Relative) / (PlaneReach * TileWidth);
	float Facing = max(dot(Point.BentN, UnpackOct(Probes.Data[Number].GeometricNormal)), 0.0);
	return exp(-Away * Away) * Facing * Facing;
}

uint TileNumber(FScreenProbeGrid Grid, ivec2 Tile)
{
	Tile = clamp(Tile, ivec2(0), ivec2(Grid.Columns, Grid.Rows) - 1);
	return uint(Tile.y) * Grid.Columns + uint(Tile.x);
}

// Looks one tile farther for a pixel of whose surface none of the probes around knows: beside an edge, these may all lie behind it.
void ChooseFartherProbe(FScreenProbeGrid Grid, ivec2 Base, vec2 Part, FGBufferPoint Point, float TileWidth, inout FProbeChoice Choice)
{
	float Best = 0.0;
	for (int I = 0; I < 16; ++I)
	{
		ivec2 Off = ivec2(I & 3, I >> 2) - 1;
		uint Number = TileNumber(Grid, Base + Off);
		vec2 Way = vec2(Off) - Part;
		float Fit = FitProbe(Grid, Number, Point, TileWidth) / (1.0 + dot(Way, Way));
		if (Fit <= Best) { continue; }
		Best = Fit;
		Choice.Numbers[0] = Number;
	}
	if (Best > 0.0) { Choice.Weights = float[4](1.0, 0.0, 0.0, 0.0); }
}

// Jitter: of the pixel, in tiles: else tiles would be seen.
FProbeChoice ChooseProbes(FViewConstants View, FScreenProbeGrid Grid, uvec2 Pixel, FGBufferPoint Point, vec2 Jitter)
{
	const float EnoughFit = 0.1;
	vec2 Place = (vec2(Pixel) + 0.5) / float(Grid.Spacing) - 0.5 + Jitter;
	ivec2 Base = ivec2(floor(Place));
	vec2 Part = Place - vec2(Base);
	float TileWidth = float(Grid.Spacing) * PixelHeight(View, dot(View.CameraForward, Point.Relative)), Sum = 0.0, Fit = 0.0;
	FProbeChoice Choice;
	for (int I = 0; I < 4; ++I)
	{
		uint Number = Choice.Numbers[I] = TileNumber(Grid, Base + ivec2(I & 1, I >> 1));
		float Near = ((I & 1) != 0 ? Part.x : 1.0 - Part.x) * ((I & 2) != 0 ? Part.y : 1.0 - Part.y);
		float Its = FitProbe(Grid, Number, Point, TileWidth);
		bool bProbe = FScreenProbeRef(Grid.Probes).Data[Number].Distance > 0.0;
		Choice.Weights[I] = bProbe ? (Near + 0.01) * max(Its, LeastWeight) : 0.0;
		Fit += Near * Its;
		Sum += Choice.Weights[I];
	}
	for (int I = 0; I < 4; ++I) { Choice.Weights[I] /= max(Sum, 1.0e-30); }
	if (Fit < EnoughFit) { ChooseFartherProbe(Grid, Base, Part, Point, TileWidth, Choice); }
	return Choice;
}

// Returns irradiance / π about a normal.
vec3 ProbeIrradiance(FScreenProbeGrid Grid, uint Number, vec3 Normal)
{
	FScreenProbeRef Probes = FScreenProbeRef(Grid.Probes);
	mat3 Basis = MakeBasis(UnpackOct(Probes.Data[Number].GeometricNormal));
	const float Last = float(SCREEN_PROBE_SIDE) - 1.0;
	vec2 Place = clamp(IrradiancePlace(Normal * Basis) * float(SCREEN_PROBE_SIDE) - 0.5, vec2(0.0), vec2(Last));
	vec2 Base = min(floor(Place), vec2(Last - 1.0)), Part = Place - Base;
	uint First = uint(Base.y) * SCREEN_PROBE_SIDE + uint(Base.x);
	vec3 Upper = mix(UnpackRgbe(Probes.Data[Number].Irradiance[First]), UnpackRgbe(Probes.Data[Number].Irradiance[First + 1u]), Part.x);
	First += SCREEN_PROBE_SIDE;
	vec3 Lower = mix(UnpackRgbe(Probes.Data[Number].Irradiance[First]), UnpackRgbe(Probes.Data[Number].Irradiance[First + 1u]), Part.x);
	return mix(Upper, Lower, Part.y);
}

vec3 GatherDiffuse(FScreenProbeGrid Grid, FProbeChoice Choice, vec3 Normal)
{
	vec3 Sum = vec3(0.0);
	for (int I = 0; I < 4; ++I)
	{
		if (Choice.Weights[I] > 0.0) { Sum += Choice.Weights[I] * ProbeIrradiance(Grid, Choice.Numbers[I], Normal); }
	}
	return Sum;
}

// Returns the radiance from a direction that a probe believes in. Below its surface it is the mean of the rest.
vec3 ProbeRadiance(FScreenProbeGrid Grid, uint Number, vec3 Direction)
{
	const uint Middle = SCREEN_PROBE_SIDE * (SCREEN_PROBE_SIDE + 1u) / 2u; // of the map of irradiance
	FScreenProbeRef Probes = FScreenProbeRef(Grid.Probes);
	bool bBelow = dot(Direction, UnpackOct(Probes.Data[Number].GeometricNormal)) <= 0.0;
	return UnpackRgbe(bBelow ? Probes.Data[Number].Irradiance[Middle] : Probes.Data[Number].Light[OctMapTexel(Direction)]);
}

vec3 GatherRadiance(FScreenProbeGrid Grid, FProbeChoice Choice, vec3 Direction)
{
	vec3 Sum = vec3(0.0);
	for (int I = 0; I < 4; ++I)
	{
		if (Choice.Weights[I] > 0.0) { Sum += Choice.Weights[I] * ProbeRadiance(Grid, Choice.Numbers[I], Direction); }
	}
	return Sum;
}

shared vec3 Corrections[RingSize * RingSize]; // of pixels that have their turn

// Each thread finds what the short ray of a pixel of the ring adds to the light of the probes.
void FindCorrections(FViewConstants View, FScreenProbeGrid Grid)
{
	ivec2 First = ivec2(gl_WorkGroupID.xy) * TILE_SIZE - 1;
	uint Columns = TurnThreads(uvec2(View.Width, View.Height)).x;
	for (uint I = gl_LocalInvocationIndex; I < uint(RingSize * RingSize); I += TILE_PIXELS)
	{
		ivec2 Pixel = First + ivec2(I % RingSize, I / RingSize);
		Corrections[I] = vec3(0.0);
		bool bTurn = RingNormals[I] != NoRingNormal && HasTurn(View.FrameIndex, TilePlace(uvec2(Pixel)));
		if (!bTurn || Grid.NearReach <= 0.0) { continue; }
		FScreenProbeRay Found = FScreenProbeRayRef(Grid.NearRays).Data[uint(Pixel.y >> 1) * Columns + uint(Pixel.x >> 1)];
		if (!(Found.Distance > 0.0)) { continue; }
		FGBufferPoint Point = LoadGBufferPoint(View, Push.Normals, Pixel, LoadDepth(Push.Depth, Pixel));
		FProbeChoice Choice = ChooseProbes(View, Grid, uvec2(Pixel), Point, vec2(0.0));
		Corrections[I] = Found.Radiance - GatherRadiance(Grid, Choice, NearDirection(View, uvec2(Pixel), Point));
	}
}

// Returns the correction of the thread's pixel: its own, or the mean of those around it on its plane.
vec3 GetCorrection(FViewConstants View, ivec2 InTile)
{
	if (HasTurn(View.FrameIndex, TilePlace(uvec2(InTile)))) { return Corrections[RingPlace(InTile)]; }
	uint Neighbors = FindNeighbors(View, InTile, false);
	vec3 Sum = vec3(0.0);
	for (uint I = 0u; I < 9u; ++I)
	{
		if ((Neighbors & (1u << I)) != 0u) { Sum += Corrections[RingPlace(InTile + ivec2(I % 3u, I / 3u) - 1)]; }
	}
	return Sum / float(max(bitCount(Neighbors), 1));
}

#ifdef SECOND_LOBE
vec3 GatherSpecular(FScreenProbeGrid Grid, FProbeChoice Choice, FBrdf Lobe, mat3 Basis, vec3 V, inout FRandom Random)
{
	vec3 Sum = vec3(0.0);
	for (uint Sample = 0u; Sample < LobeSamples; ++Sample)
	{
		vec4 U = NextRandom4(Random);
		int Probe = 0;
		while (Probe < 3 && U.w >= Choice.Weights[Probe]) { U.w -= Choice.Weights[Probe++]; }
		FBrdfSample Drawn = SampleBrdf(Lobe, V, vec3(U.xy, 0.0));
		if (Drawn.Direction.z <= 0.0 || Choice.Weights[Probe] <= 0.0) { continue; }
		Sum += Drawn.Weight * ProbeRadiance(Grid, Choice.Numbers[Probe], Basis * Drawn.Direction);
	}
	return Sum / float(LobeSamples);
}
#endif

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	uvec2 Pixel = gl_GlobalInvocationID.xy;
	FScreenProbeGrid Grid = FScreenProbeGridRef(Push.Grid).Data;
	LoadPlanes(View, Push.Depth, Push.Normals);
	barrier();
	FindCorrections(View, Grid);
	barrier();
	if (IsOutsideView(View, Pixel)) { return; }
	float Depth = LoadDepth(Push.Depth, ivec2(Pixel));
	vec3 Diffuse = vec3(0.0), Specular = vec3(0.0);
	if (Depth > 0.0)
	{
		FGBufferPoint Point = LoadGBufferPoint(View, Push.Normals, ivec2(Pixel), Depth);
		FRandom Random = MakeRandom(Pixel, View.FrameIndex, HashPcg(View.Seed + 0xdaa66d2bu));
		FProbeChoice Choice = ChooseProbes(View, Grid, Pixel, Point, NextRandom4(Random).xy - 0.5);
		Diffuse = GatherDiffuse(Grid, Choice, Point.BentN) + GetCorrection(View, ivec2(gl_LocalInvocationID.xy));
#ifdef SECOND_LOBE
		FBrdf Lobe;
		float Share;
		vec3 Albedo = FindSecondLobe(Push.BaseColor, Push.Material, ivec2(Pixel), Point, Lobe, Share);
		mat3 Basis = MakeBasis(Point.BentN);
		Specular = GatherSpecular(Grid, Choice, Lobe, Basis, Point.V * Basis, Random) / max(Albedo, vec3(1.0e-4));
		Specular = clamp(Specular, vec3(0.0), vec3(MaxHalf));
#endif
	}
	imageStore(Images[Push.Output], ivec2(Pixel), RoundToHalf(vec4(clamp(Diffuse, vec3(0.0), vec3(MaxHalf)), 1.0)));
#ifdef SECOND_LOBE
	imageStore(Images[Push.SecondOutput], ivec2(Pixel), RoundToHalf(vec4(Specular, 1.0)));
#endif
}
