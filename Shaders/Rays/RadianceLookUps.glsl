// How paths end in radiance cells (RADIANCE_CELLS): what one thread's look-ups share.
// SEES_CELLS: look-ups take the light of cells whose place they can see (r.RT.GI.Cells.Sight).
// SMOOTH_RADIANCE: cells are seen without a filter behind, and look-ups interpolate between them.
#ifndef LANTERN_RADIANCE_LOOK_UPS_GLSL
#define LANTERN_RADIANCE_LOOK_UPS_GLSL

#include "../Library/RadianceCells.glsl"

FAddress RadianceGrid = FAddress(0); // 0: no cells, and every look-up fails
vec3 RadianceCamera;
FRadianceVoter RadianceVoter; // of this thread's first look-up alone
float RadianceNear = 0.0;     // FRadianceQuery::NearCells of first hits
float RadianceRest = 1.0;     // weight of what a path finds that has met no cell; 0: it ends
#ifdef DEFERS_PATHS
bool bRadianceDeferred = false; // a path of this thread has met no cell
#endif

#ifdef SEES_CELLS
// Lift: of the ray above the surface, metres, since the cell's place may lie beyond a bulge of it.
bool IsHidden(FRadianceGrid Grid, FRadianceQuery Query, FRadianceCell Cell, float Lift)
{
	vec3 Normal = UnpackOct24(Cell.GeometricNormal), From = Query.Seen + Query.GeometricNormal * Lift;
	vec3 Way = FromRadianceSteps(Grid, Cell.Place) + Normal * Lift - From;
	float Length = length(Way);
	if (Length < Lift) { return false; }
	FSceneConstants Scene = FSceneRef(Grid.Scene).Data;
	CountPathRay(Scene, PATH_RAY_CHECK);
	return Transmittance(Scene, MASK_LOCAL_CASTERS, From, Way / Length, Length) <= 0.0;
}
#endif

// Returns the hash for the votes and the levels of a pixel's look-ups.
uint HashLookUps(FViewConstants View, uvec2 Pixel) { return HashPcg(Pixel.x + HashPcg(Pixel.y + HashPcg(View.FrameIndex + View.Seed))); }

// Votes: address of FRadianceVote[], of which the thread has Number; 0: it does not vote. Rank: see MakeRadianceVote. Hash: random.
void BeginRadianceLookUps(FAddress Grid, FViewConstants View, FAddress Votes, uint Number, uint Rank, uint Hash)
{
	RadianceGrid = Grid;
	RadianceCamera = View.CameraPosition;
	RadianceVoter = FRadianceVoter(Votes != FAddress(0) ? GetVoteNote(Votes, Number) : FAddress(0), Rank, Hash);
}

// For rays that leave from what a pixel shows, of which each 2×2 pixels have a voter from FirstVoter on. Grid may be 0.
void BeginPixelLookUps(FAddress Grid, FViewConstants View, uvec2 Pixel, uint FirstVoter)
{
	if (Grid == FAddress(0)) { return; }
	FAddress Votes = VotesInTurn(View, Pixel) ? FRadianceGridRef(Grid).Data.Votes : FAddress(0);
	BeginRadianceLookUps(Grid, View, Votes, FirstVoter + VoterOfPixel(View, Pixel), NearRank, HashLookUps(View, Pixel));
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

// Light of which a part counts as if it came from one direction, and the rest as if evenly from all.
struct FSplitLight
{
	float Share; // of the part
	vec3 From;   // its direction, local, above the surface; of length 0 if none is known
};

const float LeastCosine = 0.05; // of a direction that light has come from

// LocalFrom: FCellLight::From. With n the normal, it is d D + (1 − d) 2/3 n, which has one solution for the share d and the direction D.
FSplitLight SplitCellLight(vec3 LocalFrom)
{
	const float EvenMean = 2.0 / 3.0;  // of cosine-weighted directions, along the normal
	vec3 Rest = LocalFrom - vec3(0.0, 0.0, EvenMean);
	float Along = EvenMean * Rest.z, Factor = 1.0 - EvenMean * EvenMean;
#ifdef NO_CELL_DIRECTION // r.RT.Debug.GI.CellDirection
	Rest = vec3(0.0);
	Along = 0.0;
#endif
	FSplitLight Split;
	Split.Share = clamp((Along + sqrt(Along * Along + Factor * dot(Rest, Rest))) / Factor, 0.0, 1.0);
	Split.From = Rest + vec3(0.0, 0.0, EvenMean * Split.Share);
	if (dot(Split.From, Split.From) <= 1.0e-6) { return FSplitLight(Split.Share, vec3(0.0)); }
	Split.From.z = max(Split.From.z, LeastCosine * length(Split.From));
	Split.From = normalize(Split.From);
	return Split;
}

const float LeastCellRoughness = 0.4; // of lobes that reflect a cell's light, which comes from around the mean direction

// Returns what a surface reflects towards V of a cell's light.
vec3 ReflectCellLight(FCellLight Light, FBrdf Brdf, float Roughness, vec3 LocalV, vec3 LocalFrom)
{
	FSplitLight Split = SplitCellLight(LocalFrom);
	vec3 Reflected = DiffuseReflectance(Brdf, LocalV.z) + (1.0 - Split.Share) * SpecularReflectance(Brdf, LocalV.z, Roughness);
	if (Split.From != vec3(0.0))
	{
		Brdf.Alpha = max(Brdf.Alpha, LeastCellRoughness * LeastCellRoughness);
		vec3 Diffuse, Specular;
		EvaluateLobes(Brdf, LocalV, Split.From, Diffuse, Specular);
		Reflected += Split.Share * Pi * Specular;
	}
	return Light.Irradiance * Reflected;
}

#ifdef SMOOTH_RADIANCE
// Looks up the four cells around a place, along the two axes that its surface faces least. Their borders would show else. InOutLight: of the
// place's own cell, which counts where another is not known.
void SmoothRadiance(FRadianceGrid Grid, FRadianceQuery Query, float U, inout FCellLight InOutLight)
{
	uint Level = min(RadianceLevel(Grid, Query.FromCamera, U), CoarsestLevel(Query));
	int Steps = 1 << (RADIANCE_CELL_FINEST_SHIFT + Level);
	float Size = RADIANCE_CELL_FINEST * exp2(float(Level));
	vec3 N = abs(Query.GeometricNormal), Place = Query.Position;
	int Facing = N.x > max(N.y, N.z) ? 0 : (N.y > N.z ? 1 : 2), A = (Facing + 1) % 3, B = (Facing + 2) % 3;
	ivec3 InCell = ToRadianceSteps(Grid, Place) & (Steps - 1);
	vec2 Part = fract(vec2(InCell[A], InCell[B]) / float(Steps) + 0.5);
	FCellLight Sum = FCellLight(vec3(0.0), vec3(0.0));
	float Before = RadianceBefore;
	for (int I = 0; I < 4; ++I)
	{
		vec2 Corner = vec2(I & 1, I >> 1), Weights = mix(1.0 - Part, Part, Corner);
		Query.Position[A] = Place[A] + (Corner.x - 0.5) * Size;
		Query.Position[B] = Place[B] + (Corner.y - 0.5) * Size;
		FCellLight Light;
		if (!LookUpRadiance(Grid, Query, FRadianceVoter(FAddress(0), 0u, 0u), U, Light)) { Light = InOutLight; }
		Sum.Irradiance += Weights.x * Weights.y * Light.Irradiance;
		Sum.From += Weights.x * Weights.y * Light.From;
	}
	RadianceBefore = Before; // that of the place's own cell
	InOutLight = Sum;
}
#endif

// Looks up the light that arrives at a place, for a thread that has none yet, and returns whether it is known. P: where rays would start.
// RayLength: of the ray that has led there.
bool LookUpPlace(vec3 P, vec3 Ng, vec3 N, float RayLength, float U, out FCellLight OutLight)
{
	OutLight = FCellLight(vec3(0.0), vec3(0.0));
	if (RadianceGrid == FAddress(0)) { return false; }
	FRadianceGrid Grid = FRadianceGridRef(RadianceGrid).Data;
	FRadianceQuery Query = FRadianceQuery(P, P, Ng, N, distance(P, RadianceCamera), RayLength, false, 0.0);
	FRadianceVoter Voter = FRadianceVoter(FAddress(0), 0u, 0u);
	if ((RadianceVoter.Hash & 0x10000u) != 0u) // what lies behind the place needs votes as well
	{
		Voter = RadianceVoter;
		RadianceVoter.Note = FAddress(0);
	}
	if (!LookUpRadiance(Grid, Query, Voter, U, OutLight)) { return false; }
#ifdef SMOOTH_RADIANCE
	SmoothRadiance(Grid, Query, U, OutLight);
#endif
	return true;
}

#ifdef HAS_DIFFUSE_TRANSMISSION
FRadianceQuery TurnQuery(FRadianceQuery Query)
{
	Query.Position += BackStep;
	Query.Seen = Query.Position;
	Query.GeometricNormal = -Query.GeometricNormal;
	Query.Normal = -Query.Normal;
	return Query;
}

// Returns what leaves on V's side of a cell's light that has arrived on the other.
vec3 ShowFromBehind(FCellLight Light, FBrdf Brdf, vec3 LocalV) { return Light.Irradiance * GetBackAlbedo(Brdf) * LayerTransmittance(Brdf, LocalV.z); }

// As ReflectCellLight, for a cell of leaves that light shines through, which holds the mean of their two sides. Even light has no mean direction
// there. The rest reaches the side that faces it, which has twice the mean, and not the other.
vec3 ReflectLeafLight(FCellLight Light, FBrdf Brdf, float Roughness, vec3 LocalV, vec3 LocalFrom)
{
	float Share = min(length(LocalFrom), 1.0);
#ifdef NO_CELL_DIRECTION // r.RT.Debug.GI.CellDirection
	Share = 0.0;
#endif
	FBrdf Front = MakeFrontLobes(Brdf);
	float Facing = LocalFrom.z > 0.0 ? 2.0 * Share : 0.0, OnFront = 1.0 - Share + Facing, OnBack = 2.0 - OnFront;
	vec3 Reflected = OnFront * DiffuseReflectance(Front, LocalV.z) + (1.0 - Share) * SpecularReflectance(Front, LocalV.z, Roughness);
	if (Facing > 0.0)
	{
		vec3 Diffuse, Specular;
		Front.Alpha = max(Front.Alpha, LeastCellRoughness * LeastCellRoughness);
		LocalFrom.z = max(LocalFrom.z, LeastCosine * Share);
		EvaluateLobes(Front, LocalV, normalize(LocalFrom), Diffuse, Specular);
		Reflected += Facing * Pi * Specular;
	}
	return Light.Irradiance * Reflected + OnBack * ShowFromBehind(Light, Brdf, LocalV);
}

// As LookUpReflected, of the light that has arrived on the other side of a hit. Query: of the hit's own side. Voter: one of the two sides votes;
// gets who votes for the other one.
bool LookUpBack(FRadianceGrid Grid, FBrdf Brdf, FRadianceQuery Query, inout FRadianceVoter Voter, vec3 LocalV, float U, out vec3 OutLight)
{
	const FRadianceVoter Nobody = FRadianceVoter(FAddress(0), 0u, 0u);
	bool bVotes = (Voter.Hash & 0x10000u) != 0u;
	FCellLight Light;
	OutLight = vec3(0.0);
	Query = TurnQuery(Query);
	bool bFound = LookUpRadiance(Grid, Query, bVotes ? Voter : Nobody, U, Light);
	if (bVotes) { Voter = Nobody; }
	if (!bFound) { return false; }
#ifdef SMOOTH_RADIANCE
	SmoothRadiance(Grid, Query, U, Light);
#endif
	OutLight = ShowFromBehind(Light, Brdf, LocalV);
	return true;
}
#endif

// Returns whether the light that a hit reflects towards V is known: OutLight. P: where the next ray would start. Basis: about the shading
// normal. LocalV: V in it. NearCells: see FRadianceQuery. Mirrors show what is there, and are followed. bLast: a path ends at them as well, and
// is not black for it: they reflect the light of their cell as a glossy surface would.
bool LookUpReflected(FMaterialHit Hit, FBrdf Brdf, vec3 P, mat3 Basis, vec3 LocalV, float NearCells, bool bLast, float U, out vec3 OutLight)
{
	OutLight = vec3(0.0);
#ifdef NO_LAST_MIRROR // r.RT.Debug.GI.LastMirror
	bLast = false;
#endif
	if (RadianceGrid == FAddress(0) || (!bLast && IsMirror(Brdf) && SpecularProbability(Brdf, LocalV) > 0.0)) { return false; }
	FRadianceGrid Grid = FRadianceGridRef(RadianceGrid).Data;
	FRadianceQuery Query = FRadianceQuery(P, P, Hit.GeometricNormal, Hit.Normal, distance(P, RadianceCamera), Hit.Distance,
	                                      (Hit.Flags & HIT_FOLIAGE) != 0u, NearCells);
	FRadianceVoter Voter = RadianceVoter;
	RadianceVoter.Note = FAddress(0);
	FCellLight Light;
#ifdef HAS_DIFFUSE_TRANSMISSION
	// A leaf has one cell for its two sides, and votes must come from either. Other surfaces have a cell for each.
	bool bBack = HasBack(Brdf), bOneCell = bBack && Query.bFoliage;
	if (bOneCell && (Voter.Hash & 0x10000u) != 0u) { Query = TurnQuery(Query); }
	if (bBack && !bOneCell && !LookUpBack(Grid, Brdf, Query, Voter, LocalV, U, OutLight) && !bLast)
	{
		LookUpRadiance(Grid, Query, Voter, U, Light); // the other side asks for its cell all the same
		return false;
	}
	float BeforeBehind = RadianceBefore, Behind = Luminance(OutLight);
#endif
	if (!LookUpRadiance(Grid, Query, Voter, U, Light)) { return false; }
#ifdef SMOOTH_RADIANCE
	SmoothRadiance(Grid, Query, U, Light);
#endif
#ifdef HAS_DIFFUSE_TRANSMISSION
	if (bOneCell)
	{
		OutLight += ReflectLeafLight(Light, Brdf, Hit.Roughness, LocalV, Light.From * Basis);
		return true;
	}
#endif
	OutLight += ReflectCellLight(Light, MakeFrontLobes(Brdf), Hit.Roughness, LocalV, Light.From * Basis);
#ifdef HAS_DIFFUSE_TRANSMISSION
	if (Behind > 0.0) { RadianceBefore = mix(RadianceBefore, BeforeBehind, Behind / Luminance(OutLight)); }
#endif
	return true;
}

#endif
