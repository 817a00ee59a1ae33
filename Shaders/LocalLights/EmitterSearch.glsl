// How pixels look for emissive triangles that light them: seldom, and among few, where these are too dim to be seen. For TileTable.glsl.
#ifndef LANTERN_EMITTER_SEARCH_GLSL
#define LANTERN_EMITTER_SEARCH_GLSL

#include "TileBox.glsl"

shared uint EmitterCount; // clusters of emissive triangles that may light the tile
shared float EmitterBound; // about the most that they bring to a plane

// Counts clusters of emissive triangles that may light the tile, and bounds what they bring.
void CountEmitters(FSceneConstants Scene, FViewConstants View, uint Place)
{
	vec3 Low = BoxCorner(LowBits), High = BoxCorner(HighBits);
	FTileSource Source = FindEmitterSource(Scene, View);
	float Bound = 0.0;
	uint Found = 0u;
	[[dont_unroll]] for (uint I = Place; I < Source.Count; I += TILE_PIXELS)
	{
		FEmitterCluster Cluster = LoadCluster(Push.Emitters, SourceCluster(Source, I));
		if (!Source.bDrawn && !MayReachFromCluster(Cluster, Low, High)) { continue; }
		++Found;
		Bound += ClusterIrradiance(Cluster, BoxDistance(Cluster, Low, High)) * SourceStands(Source, I);
	}
	if (Found > 0u) { atomicAdd(EmitterCount, Found); }
	SumUpTo(Place, Bound);
	if (Place == 0u) { EmitterBound = RunSums[TILE_PIXELS - 1u] / EmissionScale; }
	barrier();
}

// Returns about the most that emitters bring to what the picture shows of a pixel, in units of DimEmitter(). Glossy surfaces may show more of
// a light than the diffuse lobe does.
float BrightnessOfEmitters(FViewConstants View, uvec2 Pixel)
{
	const float Peak = 0.25, Unknown = 1.0e6; // Peak: of the specular lobe over the diffuse one, times the square of alpha
	if (View.Exposure <= 0.0) { return Unknown; }
	FBrdf Brdf = MakeGBufferBrdf(texelFetch(Textures[Push.BaseColor], ivec2(Pixel), 0), texelFetch(Textures[Push.Material], ivec2(Pixel), 0));
	AddBackLobe(Push.BackAlbedo, ivec2(Pixel), Brdf);
	float Alpha = max(Brdf.Alpha, 2.0 * MinAlpha), Brightest = MaxComponent(Brdf.BaseColor);
	float Diffuse = max(Brightest, MaxComponent(GetBackAlbedo(Brdf)));
	float Reflected = EmitterBound / Pi * (Diffuse + Peak * mix(Brdf.F0, Brightest, Brdf.Metallic) / (Alpha * Alpha));
	return clamp(Reflected * View.Exposure / DimEmitter(Push.Emitters), 1.0e-6, Unknown);
}

// How a pixel looks for emitters in a frame.
struct FEmitterSearch
{
	bool bLooks;     // in this one
	float Scale;     // what its choice stands for
	uint Candidates; // fewer where light is dim: their noise is as well
};

const float CandidatesOfDim = 4.0; // of a pixel as bright as DimEmitter()
const float LookTogether = 8.0; // pixels of a tile: it is the tile that costs
const float ChanceSteps = 65536.0;

shared uint ChanceSum, ChanceMost; // of the tile's pixels, in steps, rounded up

float UniformOf(uint Hash) { return float(Hash >> 8u) * (1.0 / 16777216.0); }

// A pixel that looks seldom stands for the frames in which it does not (Russian roulette, Arvo and Kirk 1990). Pixels of a tile that look
// seldom do so in the same frames. All threads, behind CountEmitters.
FEmitterSearch MakeEmitterSearch(FViewConstants View, uvec2 Pixel, bool bSurface, uint Place)
{
	if (Place == 0u) { ChanceSum = ChanceMost = 0u; }
	barrier();
	float Brightness = bSurface && EmitterCount > 0u ? BrightnessOfEmitters(View, Pixel) : 0.0, Chance = min(Brightness, 1.0);
	if (Chance > 0.0)
	{
		uint Steps = uint(ceil(Chance * ChanceSteps));
		atomicAdd(ChanceSum, Steps);
		atomicMax(ChanceMost, Steps);
	}
	barrier();
	float TileChance = min(max(float(ChanceSum) / LookTogether, float(ChanceMost)) / ChanceSteps, 1.0);
	uint Index = TileIndex(View, GROUP_TILE), Frame = View.FrameIndex, Seed = HashPcg(View.Seed);
	bool bTile = UniformOf(HashPcg(Index + Seed) + Frame * 0x9e3779b9u) < TileChance; // by the golden ratio from frame to frame
	float U = UniformOf(HashPcg(Index * TILE_PIXELS + Place + HashPcg((Frame ^ 0x51ed270bu) + Seed)));
	FEmitterSearch Search;
	Search.bLooks = bTile && U * TileChance < Chance;
	Search.Scale = 1.0 / max(Chance, 1.0e-6);
#ifdef NO_CHOICE_WEIGHT // r.RT.Debug.Lights.Weight
	Search.Scale = 1.0;
#endif
	Search.Candidates = clamp(uint(Brightness * CandidatesOfDim), 1u, MostCandidates());
	return Search;
}

void ScaleChoice(float Scale, inout FLightChoice Choice, inout FLobes Lit)
{
	Choice.Weight *= Scale;
	Lit.Diffuse *= Scale;
	Lit.Specular *= Scale;
}

// Drops most choices of emitters that would hardly be seen, and lets the others stand for them: a dim flame far away shines on every
// pixel of the picture. The mean stays.
void DropDim(FViewConstants View, uvec2 Pixel, uint Which, inout FLightChoice Choice, inout FLobes Lit, inout bool bAsks)
{
	if (!bAsks || View.Exposure <= 0.0 || (Choice.Light & LIGHT_TRIANGLE) == 0u) { return; }
	float Kept = Luminance(Lit.Diffuse + Lit.Specular) * View.Exposure / DimEmitter(Push.Emitters);
	if (!(Kept < 1.0)) { return; }
	bAsks = LocalNumbers(View, Pixel, 0x7fffffffu - Which).x < Kept;
	ScaleChoice(bAsks ? 1.0 / Kept : 0.0, Choice, Lit);
}
#endif
