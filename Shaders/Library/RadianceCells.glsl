// The look-up of light in radiance cells: small cells of the world, by hash, each of which has the mean light that reaches the surfaces in
// it. The idea is that of "Fast, Lightweight Caching for Path Tracing" (Binder et al. 2019) and of SHARC (NVIDIA 2023).
//
// - A cell is thin along the normal of its surface, and has the side that it faces in its key. Sheets that are closer than a cell, and the
//   two sides of one, thus have different cells. Leaves have cubes without a side: a bush would have a cell for each of its leaves.
// - A look-up takes a cell that has been updated, or a coarse one that stands in for it, or fails. The path that asked then finds light by
//   itself.
// - Some look-ups vote. They insert cells, and the place of one of them is where the cell's rays start from then on. A cell's light is
//   thus the mean over the places that are asked for.
// - Votes are a maximum of hashes, so that the result does not depend on the order of threads.
// - What a bucket holds does not depend on it either: new keys are kept in order, and the greatest stay, as in "Phase-Concurrent Hash Tables
//   for Determinism" (Shun and Blelloch 2014). Keys of earlier frames stay where they are. A look-up finds these alone.
#ifndef LANTERN_RADIANCE_CELLS_GLSL
#define LANTERN_RADIANCE_CELLS_GLSL

#include "../Shared/RadianceCellTypes.h"
#include "Bindings.glsl"
#include "Math.glsl"
#include "RadianceChange.glsl"
#include "Random.glsl"
#include "Rgbe.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer FRadianceGridRef { FRadianceGrid Data; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FRadianceWordRef { uint Data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FRadianceCellRef { FRadianceCell Data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FRadianceVoteRef { FRadianceVote Data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FRadianceResultRef { FRadianceResult Data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FRadianceCountersRef { FRadianceCellCounters Data; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FRadianceStatisticsRef { FRadianceCellStatistics Data; };

// Returns the updates that a round of this frame has.
uint CountListed(FRadianceGrid Grid, uint Round) { return min(FRadianceCountersRef(Grid.Counters).Data.Listed[Round], Grid.Room); }

const uint LivelySlot = 0x80000000u; // in an entry of a list: the cell is worth another round

// Returns where the list of a round has an entry.
uint PlaceInList(uint Round, uint Number) { return (Round & 1u) * RADIANCE_CELL_MOST_UPDATES + Number; }

// Position: relative to the scene's origin, metres, nearer than 260 km.
ivec3 ToRadianceSteps(FRadianceGrid Grid, vec3 Position) { return Grid.Origin + ivec3(floor(Position * LIGHT_POSITION_STEPS)); }

// Returns the centre of a step.
vec3 FromRadianceSteps(FRadianceGrid Grid, ivec3 Steps) { return (vec3(Steps - Grid.Origin) + 0.5) / LIGHT_POSITION_STEPS; }

const uint LostKey = 0xffffffffu;    // of no cell: something has overwritten the table
const uint SettledKey = 0x80000000u; // set in keys of earlier frames

struct FRadianceKey
{
	uint FirstSlot; // of its bucket
	uint Check;     // neither 0 nor LostKey, without SettledKey
	uint Name;      // which of the cells at its place it is, see MakeNamedKey
};

const uint NoSide = 6u, AllSides = 7u; // of thick cells, and of such as are not layered
const uint NameSide = 8u, NameSides = 0xfu << NameSide, NameCoarse = 1u << 12u, NameBehind = 1u << 13u; // a name is level | side | …

// Whether it can be FRadianceKey::Name.
bool IsKeyName(uint Name)
{
	uint Side = (Name & NameSides) >> NameSide;
	return (Name & 0xffu) < RADIANCE_CELL_LEVELS && Side <= AllSides && Name < 2u * NameBehind;
}

// Returns the key of a cell at a place. Name: of another key.
FRadianceKey MakeNamedKey(FRadianceGrid Grid, ivec3 Steps, uint Name)
{
	uint Shift = RADIANCE_CELL_FINEST_SHIFT + (Name & 0xffu), Side = (Name & NameSides) >> NameSide;
	ivec3 Cell = Steps >> (Side == NoSide ? Shift + 1u : Shift);
	if (Side < NoSide)
	{
		uint Axis = Side >> 1u;
		Cell[Axis] = Steps[Axis] >> (Shift - RADIANCE_CELL_THICKNESS);
	}
	uvec4 Hash = HashPcg4(uvec4(uvec3(Cell), Name));
	uint Check = clamp(Hash.y & ~SettledKey, 1u, (LostKey & ~SettledKey) - 1u);
	return FRadianceKey((Hash.x & Grid.BucketMask) * RADIANCE_CELL_BUCKET, Check, Name);
}

// Normal: geometric, towards the side that the light comes from. Without it, bThick: cells are cubes, twice as wide, in which all surfaces
// share the light.
FRadianceKey MakeRadianceKey(FRadianceGrid Grid, ivec3 Steps, uint Level, bool bCoarse, vec3 Normal, bool bThick)
{
#ifndef NO_LAYERS // r.RT.Debug.GI.Layers
	vec3 Size = abs(Normal);
	uint Axis = Size.x > Size.y ? (Size.x > Size.z ? 0u : 2u) : (Size.y > Size.z ? 1u : 2u);
	uint Side = bThick ? NoSide : Axis * 2u + (Normal[Axis] < 0.0 ? 1u : 0u);
#else
	const uint Side = AllSides;
#endif
	return MakeNamedKey(Grid, Steps, Level | (Side << NameSide) | (bCoarse ? NameCoarse : 0u));
}

// Finds cells of earlier frames. bFull: gets whether these leave no room in the bucket.
uint FindRadianceCell(FRadianceGrid Grid, FRadianceKey Key, out bool bFull)
{
	FRadianceWordRef Keys = FRadianceWordRef(Grid.Keys);
	bFull = true;
	for (uint I = 0u; I < RADIANCE_CELL_BUCKET; ++I)
	{
		uint Its = Keys.Data[Key.FirstSlot + I];
		if (Its == (Key.Check | SettledKey)) { return Key.FirstSlot + I; }
		bFull = bFull && Its >= SettledKey;
	}
	return NO_RADIANCE_CELL;
}

// Puts a key that is not in the table among the new ones of its bucket. They are in descending order, and the least fall out where there is
// no room. Its slot is known when all have been put in.
void AddNewKey(FRadianceGrid Grid, FRadianceKey Key)
{
	FRadianceWordRef Keys = FRadianceWordRef(Grid.Keys);
	uint Check = Key.Check;
	for (uint I = 0u; I < RADIANCE_CELL_BUCKET; ++I)
	{
		uint Slot = Key.FirstSlot + I, Before = Keys.Data[Slot];
		if (Before < Check) { Before = atomicMax(Keys.Data[Slot], Check); } // else it is settled, or greater
		if (Before == Check || Before == 0u) { return; }
		Check = min(Before, Check); // what was there goes further
	}
}

// Returns the slot of a key that is new in this frame, or NO_RADIANCE_CELL: there was no room. Behind all threads that add keys.
uint FindNewKey(FRadianceGrid Grid, FRadianceKey Key)
{
	FRadianceWordRef Keys = FRadianceWordRef(Grid.Keys);
	for (uint I = 0u; I < RADIANCE_CELL_BUCKET; ++I)
	{
		if (Keys.Data[Key.FirstSlot + I] == Key.Check) { return Key.FirstSlot + I; }
	}
	return NO_RADIANCE_CELL;
}

// Returns the level of cells at Distance from the camera, metres. The last quarter of a level's range belongs to the next one by chance U,
// so that there is no seam.
uint RadianceLevel(FRadianceGrid Grid, float Distance, float U)
{
	float Exact = log2(max(Distance * Grid.SizeAngle / RADIANCE_CELL_FINEST, 1.0));
	float Level = ceil(Exact);
	float InRange = 1.0 - (Level - Exact);
	if (InRange * 4.0 - 3.0 > U) { Level += 1.0; }
	return min(uint(Level), RADIANCE_CELL_LEVELS - 1u);
}

// Rank: surfaces between the camera and the look-up, 1 or more: near ones win. Hash: random.
uint MakeRadianceVote(uint Rank, uint Hash) { return ((7u - clamp(Rank, 1u, 7u)) << 29u) | max(Hash >> 3u, 1u); }
uint RankOfVote(uint Vote) { return 7u - (Vote >> 29u); }

// Votes may be equal: two cells of other sizes at one place draw the same path. The first of their notes then wins, and its claim stands in for
// the vote. Claims are above all votes.
const uint VoteClaim = 0xe0000000u;
bool IsVoteClaim(uint Vote) { return Vote >= VoteClaim; }
uint MakeVoteClaim(uint Note) { return VoteClaim | (~Note & ~VoteClaim); }
uint NoteOfClaim(uint Claim) { return ~Claim & ~VoteClaim; }

// The rank of the look-up that has given a cell its place, in the bits that PackMeanDirection leaves. It ends at the greatest.
const uint RankShift = 30u, GreatestRank = 4u;
const uint NearRank = 2u; // of what pixels look up, and what the updates of cells do that their diffuse paths end in
uint UnpackRank(uint From) { return (From >> RankShift) + 1u; }
uint PackRank(uint Rank) { return (clamp(Rank, 1u, GreatestRank) - 1u) << RankShift; }
const uint MeanDirectionMask = (1u << RankShift) - 1u;

uint RadianceTurnsSince(FRadianceGrid Grid, uint Then) { return (Grid.Turn - Then) & RADIANCE_CELL_TURN_MASK; }
uint RadianceCellCount(uint State) { return State & RADIANCE_CELL_COUNT_MASK; }
uint RadianceCellUpdated(uint State) { return (State >> RADIANCE_CELL_UPDATED_SHIFT) & RADIANCE_CELL_TURN_MASK; }
uint RadianceCellAsked(uint State) { return State >> RADIANCE_CELL_ASKED_SHIFT; }

const uint VoteShift = 4u; // log2 of the steps that tell two votes apart: 2 mm

// Depends on the place relative to the camera alone, so that a scene looks the same wherever it lies in the world. Shift: log2 of the steps
// to which that place matters, RADIANCE_SEED_SHIFT at most.
uint HashPlace(FRadianceGrid Grid, ivec3 Steps, uint Shift)
{
	return HashPcg4(uvec4(uvec3((Steps >> Shift) - (Grid.Camera << (RADIANCE_SEED_SHIFT - Shift))), 0u)).x;
}

// Returns what a cell's random numbers start from.
uint RadianceSeed(FRadianceGrid Grid, FRadianceCell Cell)
{
	return HashPlace(Grid, Cell.Place, RADIANCE_SEED_SHIFT) ^ HashPcg((Cell.GeometricNormal & 0xc00c00u) | (Cell.State & RADIANCE_CELL_COARSE));
}

// Notes that a cell is in use. All threads of a pass write the same.
void AskRadianceCell(FRadianceGrid Grid, uint Slot, bool bCoarse)
{
	FRadianceCellRef Cells = FRadianceCellRef(Grid.Cells);
	uint State = Cells.Data[Slot].State;
	const uint Rest = (1u << RADIANCE_CELL_ASKED_SHIFT) - 1u;
	if (State == 0u) { State = Grid.Turn << RADIANCE_CELL_UPDATED_SHIFT; } // a new cell waits from now on
	uint Asked = (State & Rest) | (Grid.Turn << RADIANCE_CELL_ASKED_SHIFT) | (bCoarse ? RADIANCE_CELL_COARSE : 0u);
	if (State != Asked) { Cells.Data[Slot].State = Asked; }
}

// Rounds at random, as PackRgbe. Mean: of unit vectors. U: three random numbers in [0, 1).
uint PackMeanDirection(vec3 Mean, vec3 U)
{
	uvec3 Steps = uvec3(clamp((Mean * 0.5 + 0.5) * 1023.0 + U, vec3(0.0), vec3(1023.0)));
	return Steps.x | (Steps.y << 10u) | (Steps.z << 20u);
}
vec3 UnpackMeanDirection(uint P) { return vec3(P & 1023u, (P >> 10u) & 1023u, (P >> 20u) & 1023u) * (2.0 / 1023.0) - 1.0; }

// Light that reaches a cell.
struct FCellLight
{
	vec3 Irradiance; // over π
	vec3 From;       // see FRadianceCell
};

// A place of which the light is asked.
struct FRadianceQuery
{
	vec3 Position;  // that rays may start from, relative to the scene's origin, metres
	vec3 Seen;      // from where the cell's place must be seen: Position, or near it
	vec3 GeometricNormal, Normal;
	float FromCamera; // distance, metres
	float RayLength;  // of the ray that asks, metres
	bool bFoliage;    // leaves have all directions, and their light is averaged
	float NearCells;  // length of rays, in cells of the place, up to which nothing is found
};

// A look-up that may vote: where it notes what it asked for. 0: none.
struct FRadianceVoter
{
	FAddress Note; // FRadianceVote
	uint Rank;     // see MakeRadianceVote
	uint Hash;
};

// Returns the address of one of FRadianceVote[].
FAddress GetVoteNote(FAddress Votes, uint Number)
{
	const uint VoteBytes = 28u;
	return Votes + FAddress(Number) * FAddress(VoteBytes);
}

// Number of the 2×2 pixels that a pixel lies in: they share a vote.
uint VoterOfPixel(FViewConstants View, uvec2 Pixel) { return (Pixel.y >> 1u) * ((View.Width + 1u) >> 1u) + (Pixel.x >> 1u); }

// Whether it is the pixel's turn to vote, where each pixel may.
bool VotesInTurn(FViewConstants View, uvec2 Pixel)
{
	uvec2 Block = min(uvec2(View.Width, View.Height) - (Pixel & ~1u), uvec2(2u)); // fewer at the border
	uint Turn = View.FrameIndex % (Block.x * Block.y);
	return (Pixel.y & 1u) * Block.x + (Pixel.x & 1u) == Turn;
}

void NoteVote(FRadianceQuery Query, FRadianceVoter Voter, uint Slot, uint Vote, ivec3 Steps)
{
	FRadianceVoteRef(Voter.Note).Data[0] = FRadianceVote(Slot, Vote, Steps, PackOct24(Query.GeometricNormal), PackOct24(Query.Normal));
}

#ifdef SEES_CELLS
bool IsHidden(FRadianceGrid Grid, FRadianceQuery Query, FRadianceCell Cell, float Lift); // of the includer

// Lets a look-up pass by a cell whose place it cannot see. Cells that lie on both sides of what is thin would pass light through it. Such
// look-ups share a second cell. Returns whether the look-up may have the cell in Slot.
bool ChooseSide(FRadianceGrid Grid, FRadianceQuery Query, ivec3 Steps, inout FRadianceKey Key, inout uint Slot, inout bool bFull)
{
	if (Query.bFoliage) { return true; }
	float Lift = 0.125 * RADIANCE_CELL_FINEST * exp2(float(Key.Name & 0xffu));
	for (uint Side = 0u; Side < 2u; ++Side) // a loop, since shaders then hold one ray instead of two
	{
		if (Side == 1u)
		{
			Key = MakeNamedKey(Grid, Steps, Key.Name | NameBehind);
			Slot = FindRadianceCell(Grid, Key, bFull);
		}
		if (Slot == NO_RADIANCE_CELL || !IsHidden(Grid, Query, FRadianceCellRef(Grid.Cells).Data[Slot], Lift)) { return true; }
	}
	return false;
}
#endif

// Returns the slot of the query's cell, or NO_RADIANCE_CELL. A full bucket gives the cell to the next coarser level.
uint AskRadianceCell(FRadianceGrid Grid, FRadianceQuery Query, FRadianceVoter Voter, uint Level, bool bCoarse)
{
	ivec3 Steps = ToRadianceSteps(Grid, Query.Position);
	uint Vote = 0u;
	if (Voter.Note != FAddress(0)) { Vote = MakeRadianceVote(Voter.Rank, Voter.Hash ^ HashPlace(Grid, Steps, VoteShift)); }
	for (uint Coarser = 0u; Coarser < 4u; ++Coarser)
	{
		FRadianceKey Key = MakeRadianceKey(Grid, Steps, min(Level + Coarser, RADIANCE_CELL_LEVELS - 1u), bCoarse, Query.GeometricNormal,
		                                   Query.bFoliage);
		bool bFull;
		uint Slot = FindRadianceCell(Grid, Key, bFull);
#ifdef SEES_CELLS
		if (!ChooseSide(Grid, Query, Steps, Key, Slot, bFull)) { return NO_RADIANCE_CELL; }
#endif
		if (Slot == NO_RADIANCE_CELL && bFull)
		{
			if (Grid.Statistics != FAddress(0)) { atomicAdd(FRadianceStatisticsRef(Grid.Statistics).Data.Full, 1u); }
			continue;
		}
		if (Slot != NO_RADIANCE_CELL)
		{
			AskRadianceCell(Grid, Slot, bCoarse);
			if (Vote != 0u) { atomicMax(FRadianceCellRef(Grid.Cells).Data[Slot].Vote, Vote); }
		}
		else if (Vote != 0u) { AddNewKey(Grid, Key); }
		if (Vote != 0u) { NoteVote(Query, Voter, Slot != NO_RADIANCE_CELL ? Slot : NEW_RADIANCE_CELL | Key.Name, Vote, Steps); }
		return Slot;
	}
	return NO_RADIANCE_CELL;
}

float RadianceBefore = 1.0; // light a moment ago over that of now, of the thread's last look-up that has found one

const uint LeastCoarseCount = 5u; // about ten updates: a coarse cell that knows less is seen as a blotch

bool IsRadianceKnown(FRadianceGrid Grid, uint Slot, uint LeastCount, inout FCellLight Light)
{
	if (Slot == NO_RADIANCE_CELL) { return false; }
	FRadianceCell Cell = FRadianceCellRef(Grid.Cells).Data[Slot];
	if (RadianceCellCount(Cell.State) < LeastCount) { return false; }
	Light = FCellLight(UnpackRgbe(Cell.Light), UnpackMeanDirection(Cell.From));
	float Since = float(RadianceTurnsSince(Grid, RadianceCellUpdated(Cell.State)));
	RadianceBefore = AgeBefore(UnpackBefore(Cell.GeometricNormal), Since, Grid.Moment);
	return true;
}

// Returns the coarsest level whose cells are no larger than the ray is long. A larger one may lie on both sides of a corner.
uint CoarsestLevel(FRadianceQuery Query)
{
	float Fitting = max(log2(Query.RayLength / (1.7320508 * RADIANCE_CELL_FINEST)), 0.0);
	return min(uint(Fitting), RADIANCE_CELL_LEVELS - 1u);
}

const uint FoundFine = 0u, FoundCoarse = 1u, FoundNone = 2u;

// Returns what the light at a place is known by. U: a random number in [0, 1).
uint FindRadiance(FRadianceGrid Grid, FRadianceQuery Query, FRadianceVoter Voter, float U, out FCellLight OutLight)
{
	OutLight = FCellLight(vec3(0.0), vec3(0.0));
	if (!all(lessThan(abs(Query.Position), vec3(2.0e5)))) { return FoundNone; } // also of what is no number
	// The finest must do for rays that leave from a corner.
	if (Query.RayLength < 0.25 * RADIANCE_CELL_FINEST) { return FoundNone; }
	uint Wanted = RadianceLevel(Grid, Query.FromCamera, U);
	if (Query.RayLength < Query.NearCells * RADIANCE_CELL_FINEST * exp2(float(Wanted))) { return FoundNone; }
	uint Coarsest = CoarsestLevel(Query), Level = min(Wanted, Coarsest);
	uint CoarseLevel = min(Level + RADIANCE_CELL_COARSER, Coarsest);
	FRadianceVoter Nobody = FRadianceVoter(FAddress(0), 0u, 0u);
	bool bForCoarse = CoarseLevel > Level && (Voter.Hash & 3u) == 0u; // the hash's other bits are the vote
	uint Slot = AskRadianceCell(Grid, Query, bForCoarse ? Nobody : Voter, Level, false);
	if (IsRadianceKnown(Grid, Slot, 1u, OutLight)) { return FoundFine; }
	if (CoarseLevel == Level) { return FoundNone; }
	Slot = AskRadianceCell(Grid, Query, bForCoarse ? Voter : Nobody, CoarseLevel, true);
	return IsRadianceKnown(Grid, Slot, LeastCoarseCount, OutLight) ? FoundCoarse : FoundNone;
}

#ifdef AUDITS_CELLS
uint RadianceAnswer = RADIANCE_AUDIT_NONE; // what the thread's last look-up has found
#endif

// Returns whether the light at a place is known, as FindRadiance.
bool LookUpRadiance(FRadianceGrid Grid, FRadianceQuery Query, FRadianceVoter Voter, float U, out FCellLight OutLight)
{
	uint Found = FindRadiance(Grid, Query, Voter, U, OutLight);
	if (Grid.Statistics != FAddress(0))
	{
		FRadianceStatisticsRef Statistics = FRadianceStatisticsRef(Grid.Statistics);
		if (Found == FoundFine) { atomicAdd(Statistics.Data.Found, 1u); }
		else if (Found == FoundCoarse) { atomicAdd(Statistics.Data.Coarse, 1u); }
		else { atomicAdd(Statistics.Data.Missed, 1u); }
	}
#ifdef AUDITS_CELLS
	RadianceAnswer = Found == FoundCoarse ? RADIANCE_AUDIT_COARSE : Query.bFoliage ? RADIANCE_AUDIT_LEAVES : RADIANCE_AUDIT_CELL;
#endif
	return Found != FoundNone;
}

#endif
