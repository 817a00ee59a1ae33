// Traces one path for each listed cell: what reaches a white surface at its place. Paths end in other cells as the round before left them,
// so the order of threads does not matter, and each round carries light one surface further. The ray-tracing pipeline and the ray-query
// path share it.
#ifndef LANTERN_RADIANCE_CELL_UPDATE_GLSL
#define LANTERN_RADIANCE_CELL_UPDATE_GLSL

#ifndef RADIANCE_CELLS
#define RADIANCE_CELLS
#endif
#include "../Shared/RadianceCellTypes.h"
#include "../Rays/IndirectSampling.glsl"

layout(push_constant, scalar) uniform FPush { FRadianceCellConstants Push; };

const float MostLight = 1.0e30;

void AddLight(inout FRadianceResult Result, vec3 Light, vec3 Direction)
{
	Light = mix(clamp(Light, vec3(0.0), vec3(MostLight)), vec3(0.0), isnan(Light));
	Result.Light += Light;
	Result.Moment += Luminance(Light) * Direction;
}

// Samples all light: what Gather leaves to the lighting pass is added.
FRadianceResult SampleCell(FSceneConstants Scene, FRadianceGrid Grid, FRadianceCell Cell, inout FRandom Random)
{
	vec3 Ng = UnpackOct24(Cell.GeometricNormal);
	// Places are kept to half a step.
	vec3 P = FromRadianceSteps(Grid, Cell.Place) + Ng * (1.0 / LIGHT_POSITION_STEPS);
	P = OffsetRayOrigin(P, Ng, Scene.ObjectReach, 0.0);
	FBrdf White = MakeWhiteLambert();
	mat3 Basis = MakeBasis(BendNormal(UnpackOct24(Cell.Normal), Ng));
	vec3 V = Ng * Basis;
	vec4 U0 = NextRandom4(Random), U1 = NextRandom4(Random);
	FRadianceResult Result = FRadianceResult(vec3(0.0), vec3(0.0), 0.0);
	FGathered Gathered = Gather(Scene, White, Basis, V, P, Ng, U0.xy, Push.MaxBounces, Random);
	AddLight(Result, Gathered.Light, Gathered.Direction);
	Result.Gone = Luminance(Result.Light) * Gathered.Gone; // of what AddLight has taken so far
	AddLight(Result, Gathered.Emission, Gathered.EmissionDirection);
#ifdef HAS_SUN
	AddLight(Result, SampleSun(Scene, White, Basis, V, P, Ng, false, U0.zw), -Scene.SunDirection);
#endif
#ifdef HAS_LIGHTS
	vec3 ToLight;
	vec3 L = SampleLocalLights(Scene, White, Basis, V, P, Ng, false, AllChannels, U1.x, U1.yz, ToLight);
	AddLight(Result, L, ToLight);
#endif
	return Result;
}

// Number: of an update.
void UpdateCell(uint Number)
{
	FRadianceGrid Grid = FRadianceGridRef(Push.Grid).Data;
	if (Number >= RADIANCE_CELL_MOST_UPDATES) { return; }
	bool bVotes = Push.Round == 0u; // there is a place for one vote
	if (bVotes) { FRadianceVoteRef(Grid.UpdateVotes).Data[Number].Slot = NO_RADIANCE_CELL; }
	if (Number >= CountListed(Grid, Push.Round)) { return; }
	FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	FRadianceCell Cell = FRadianceCellRef(Grid.Cells).Data[FRadianceWordRef(Grid.List).Data[PlaceInList(Push.Round, Number)]];
	uint Seed = RadianceSeed(Grid, Cell) + Push.Round * 0x9e3779b9u;
	FRandom Random = MakeRandom(uvec2(Seed & 0xffffu, Seed >> 16u), View.FrameIndex, HashPcg(View.Seed + 0x2545f491u));
	uint Rank = UnpackRank(Cell.From) + 1u;
	BeginRadianceLookUps(Push.Grid, View, bVotes ? Grid.UpdateVotes : FAddress(0), Number, Rank, HashPcg(Seed ^ HashPcg(View.FrameIndex)));
	FRadianceResultRef(Grid.Results).Data[Number] = SampleCell(Scene, Grid, Cell, Random);
}

#endif
