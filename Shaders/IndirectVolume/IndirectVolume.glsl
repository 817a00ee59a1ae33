// Indirect light in the air: what comes from the sky, from what shines, and from what is lit, to places between surfaces. Each thread has two
// slices of a column of froxels, and traces paths from one of them in turn. They end in radiance cells. The sun's disk and local lights are the
// affair of Fog/FogShadow.glsl. The ray-tracing pipeline and the ray-query path share it.
// Froxels start no ray behind what the picture shows, so nothing leaks through walls as it does from probes that lie on a grid.
// NO_VOLUME_MOMENT: planted fault (r.RT.Debug.GI.VolumeMoment).
#ifndef LANTERN_INDIRECT_VOLUME_GLSL
#define LANTERN_INDIRECT_VOLUME_GLSL

#ifndef HAS_PHASE
#define HAS_PHASE
#endif
#ifndef RADIANCE_CELLS
#define RADIANCE_CELLS // all paths end in them
#endif
#include "../Shared/IndirectVolumeTypes.h"
#include "../Library/Bindings.glsl"

layout(push_constant, scalar) uniform FPush { FIndirectVolumeConstants Push; };

#include "../Fog/Froxels.glsl"
#include "../Rays/IndirectSampling.glsl"

struct FFroxelValue
{
	vec3 Mean, Moment; // see FAirLight in ReadVolume.glsl
};

FFroxelValue NoFroxelValue() { return FFroxelValue(vec3(0.0), vec3(0.0)); }

bool AddFroxel(ivec2 Texel, float Weight, inout FFroxelValue Sum)
{
	vec3 Mean = texelFetch(Textures[Push.PreviousLight], Texel, 0).xyz, Moment = texelFetch(Textures[Push.PreviousMoment], Texel, 0).xyz;
	if (any(isnan(Mean + Moment)) || any(isinf(Mean + Moment))) { return false; }
	Sum.Mean += Weight * Mean;
	Sum.Moment += Weight * Moment;
	return true;
}

void ScaleFroxel(float Factor, inout FFroxelValue Value)
{
	Value.Mean *= Factor;
	Value.Moment *= Factor;
}

#define KNOWS_LIT_FROXELS // rays start in front of what the column shows, in the slices behind it as well
#include "../Fog/FogHistory.glsl"
#include "../Fog/FroxelSample.glsl"

const float EvenPdf = 1.0 / (4.0 * Pi); // of directions

void AddLight(vec3 L, vec3 Direction, inout FFroxelValue Sum)
{
	L = ClampToFinite(L);
	Sum.Mean += L;
	Sum.Moment += Luminance(L) * Direction;
}

// Adds what one direction brings, and a sample of what shines.
void AddDirection(FSceneConstants Scene, vec3 P, vec2 U, inout FFroxelValue Sum, inout FRandom Random)
{
	vec3 Direction = SampleCone(U, 2.0);
#ifdef TINTED_SHADOWS
	PlaceVolume = Air();
#endif
#ifdef HAS_DIFFUSE_TRANSMISSION
	BackStep = vec3(0.0); // of the path before
#endif
#ifdef HAS_EMISSIVE
	vec3 ToLight;
	vec4 LightSample = NextRandom4(Random);
	vec3 Emission = SampleEmissive(Scene, MakePhase(0.0), mat3(1.0), vec3(0.0, 0.0, 1.0), P, vec3(0.0, 0.0, 1.0), false, LocalCasters(false),
	                               LightSample, true, SHOWS_NOTHING, ToLight);
	AddLight(Emission, ToLight, Sum);
#endif
	SEES_HITS(true);
	RayCone = vec2(0.0);
	FMaterialHit Hit = TraceMaterial(Scene, MASK_VISIBLE, P, Direction, Infinity, SHOWS_NOTHING);
	if (Hit.Distance < 0.0)
	{
#ifdef HAS_SKY
		AddLight(SampleSkyRadiance(Scene, Direction), Direction, Sum);
#endif
		return;
	}
	AddLight(FollowPath(Scene, Hit, P, Direction, EvenPdf, 0.0, 1u, Push.MaxBounces, false, Random), Direction, Sum);
}

// End: see PlaceInFroxel.
FFroxelValue TraceFroxel(FSceneConstants Scene, FViewConstants View, ivec3 Froxel, float End)
{
	uint Seed = SeedOfFroxel(View, Froxel);
	FRandom Random = MakeRandom(uvec2(Froxel.xy), View.FrameIndex, Seed);
	FFroxelValue Sum = NoFroxelValue();
	for (uint Sample = 0u; Sample < Push.Samples; ++Sample)
	{
		uint Index = (View.FrameIndex >> 1u) * Push.Samples + Sample; // every other frame is its turn
		vec3 Relative = PlaceInFroxel(Push.Grid, View, Froxel, End, FroxelJitter(Index, Seed));
		AddDirection(Scene, View.CameraPosition + Relative, SobolOwen2(Index, Seed), Sum, Random);
	}
	ScaleFroxel(1.0 / float(Push.Samples), Sum);
#ifdef NO_VOLUME_MOMENT
	Sum.Moment = vec3(0.0);
#endif
	return Sum;
}

// Count: of slices that are lit.
void LightFroxel(FSceneConstants Scene, FViewConstants View, ivec3 Froxel, uint Count, float End, bool bTurn)
{
	FFroxelValue Value;
	bool bKnown = LoadFogHistory(View, FroxelPosition(Push.Grid, View, vec3(Froxel) + 0.5), Value);
	if (uint(Froxel.z) < Count && (bTurn || !bKnown))
	{
		FFroxelValue Traced = TraceFroxel(Scene, View, Froxel, End);
		float Share = bKnown ? Push.Share : 1.0;
		Value = FFroxelValue(mix(Value.Mean, Traced.Mean, Share), mix(Value.Moment, Traced.Moment, Share));
	}
	ivec2 Texel = FroxelTexel(Push.Grid, Froxel);
	imageStore(Images[Push.OutLight], Texel, RoundToHalf(vec4(Value.Mean, 1.0)));
	imageStore(Images[Push.OutMoment], Texel, RoundToHalf(vec4(Value.Moment, 0.0)));
}

// Each column of a pair of slices has a vote.
void BeginPair(FViewConstants View, ivec2 Column, uint Pair)
{
	uint Voter = (Pair * Push.Grid.Rows + uint(Column.y)) * Push.Grid.Columns + uint(Column.x);
	BeginRadianceLookUps(Push.RadianceCells, View, FRadianceGridRef(Push.RadianceCells).Data.Votes, Push.FirstVoter + Voter, 3u,
	                     HashPcg(Voter + HashPcg(View.FrameIndex + View.Seed)));
}

#include "../Fog/FroxelPairs.glsl"

#endif
