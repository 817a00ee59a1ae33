// Where in a froxel rays start.
// FOG_NEXT_SLICE: planted fault, see r.RT.Debug.Fog.Slice.
#ifndef LANTERN_FROXEL_SAMPLE_GLSL
#define LANTERN_FROXEL_SAMPLE_GLSL

#include "../Library/Random.glsl"
#include "Froxels.glsl"

// Points that fill a froxel evenly over frames, whichever share of all frames the froxel is traced in (Roberts 2018, "The Unreasonable
// Effectiveness of Quasirandom Sequences").
vec3 FroxelJitter(uint FrameIndex, uint Seed)
{
	uvec3 Offset = HashPcg4(uvec4(Seed, 1u, 2u, 3u)).xyz;
	return vec3((Offset + FrameIndex * uvec3(3518319155u, 2882110345u, 2360945575u)) >> 8u) * (1.0 / 16777216.0);
}

uint SeedOfFroxel(FViewConstants View, ivec3 Froxel)
{
	return HashPcg(uint(Froxel.x) + HashPcg(uint(Froxel.y) + HashPcg(uint(Froxel.z) + HashPcg(View.Seed))));
}

// Returns a point of a froxel, relative to the camera. End: of what the column shows, in slices. Light behind that would leak through walls.
vec3 PlaceInFroxel(FFogGrid Grid, FViewConstants View, ivec3 Froxel, float End, vec3 Jitter)
{
	vec3 At = vec3(Froxel) + Jitter;
	if (End < float(Froxel.z + 1)) { At.z = End > float(Froxel.z) ? mix(float(Froxel.z), End, Jitter.z) : max(End - 0.05, 0.01); }
#ifdef FOG_NEXT_SLICE
	At.z = float(Froxel.z) + 1.5;
#endif
	return FroxelPosition(Grid, View, At);
}

#endif
