// How paths end in radiance cells (RADIANCE_CELLS): what one thread's look-ups share.
#ifndef LANTERN_RADIANCE_LOOK_UPS_GLSL
#define LANTERN_RADIANCE_LOOK_UPS_GLSL

#include "../Library/RadianceCells.glsl"

FAddress RadianceGrid = FAddress(0); // 0: no cells, and every look-up fails
vec3 RadianceCamera;
FRadianceVoter RadianceVoter; // of this thread's first look-up alone
float RadianceRest = 1.0;     // weight of what a path finds that has met no cell; 0: it ends
#ifdef DEFERS_PATHS
bool bRadianceDeferred = false; // a path of this thread has met no cell
#endif

// Votes: address of FRadianceVote[], of which the thread has Number; 0: it does not vote. Rank: see MakeRadianceVote. Hash: random.
void BeginRadianceLookUps(FAddress Grid, FViewConstants View, FAddress Votes, uint Number, uint Rank, uint Hash)
{
	const uint VoteBytes = 28u;
	RadianceGrid = Grid;
	RadianceCamera = View.CameraPosition;
	RadianceVoter = FRadianceVoter(Votes != FAddress(0) ? Votes + FAddress(Number) * FAddress(VoteBytes) : FAddress(0), Rank, Hash);
}

// Lets only some pixels follow paths that have met no cell, and weighs what they find.
void ChooseRadianceRest(uvec2 Pixel, FViewConstants View)
{
	if (RadianceGrid == FAddress(0)) { return; }
	float Chance = FRadianceGridRef(RadianceGrid).Data.RestChance;
	float U = float(HashPcg(Pixel.x + HashPcg(Pixel.y + HashPcg(View.FrameIndex ^ 0x9e3779b9u))) >> 8u) * (1.0 / 16777216.0);
	RadianceRest = U < Chance ? 1.0 / Chance : 0.0;
}

// Returns the weight of a path that goes on though it has met no cell, once.
float TakeRadianceRest()
{
	float Rest = RadianceRest;
	RadianceRest = 1.0;
	return Rest;
}

// Returns whether the light that a hit reflects towards V is known: OutLight. P: where the next ray would start. LocalV: V in a frame about
// the shading normal. Mirrors show what is there, and are followed.
bool LookUpReflected(FMaterialHit Hit, FBrdf Brdf, vec3 P, vec3 LocalV, float U, out vec3 OutLight)
{
	OutLight = vec3(0.0);
	if (RadianceGrid == FAddress(0) || (IsMirror(Brdf) && SpecularProbability(Brdf, LocalV) > 0.0)) { return false; }
	FRadianceGrid Grid = FRadianceGridRef(RadianceGrid).Data;
	FRadianceQuery Query = FRadianceQuery(P, Hit.GeometricNormal, Hit.Normal, distance(P, RadianceCamera), Hit.Distance,
	                                      (Hit.Flags & HIT_FOLIAGE) != 0u);
	FRadianceVoter Voter = RadianceVoter;
	RadianceVoter.Note = FAddress(0);
	if (!LookUpRadiance(Grid, Query, Voter, U, OutLight)) { return false; }
	OutLight *= DiffuseReflectance(Brdf, LocalV.z) + SpecularReflectance(Brdf, LocalV.z, Hit.Roughness);
	return true;
}

#endif
