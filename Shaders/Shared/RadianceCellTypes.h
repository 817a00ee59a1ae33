// Radiance cells: a hash table of small cells in the world that hold the light which reaches their surfaces. Structures that C++ and GLSL
// share.
#ifndef LANTERN_RADIANCE_CELL_TYPES_H
#define LANTERN_RADIANCE_CELL_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

#define RADIANCE_CELL_BUCKET 16u      // slots that a key may lie in: their keys share a cache line
#define RADIANCE_CELL_THICKNESS 2u    // log2 of how much thinner a cell is along the normal of its surface
#define RADIANCE_CELL_LEVELS 16u      // of size, each twice the one before
#define RADIANCE_CELL_FINEST 0.125f   // edge of the finest cells, metres
#define RADIANCE_CELL_FINEST_SHIFT 10u // log2 of its LIGHT_POSITION_STEPS
#define RADIANCE_CELL_BINS 64u        // of priority
#define RADIANCE_CELL_MOST_UPDATES 65536u // in a frame
#define RADIANCE_CELL_MOST_ROUNDS 8u // of updates in a frame
#define RADIANCE_CELL_ROW 1024u       // updates in a row of their launch
#define RADIANCE_CELL_GROUP_SIZE 256u
#define RADIANCE_CELL_UPDATE_GROUP 64u // updates of a work group of the ray-query path
#define RADIANCE_CELL_ROW_GROUPS 1024u // of a dispatch over the table: devices may have no more than 65,535 in x

// A fine cell that knows too little is stood in for by a coarse one, which is larger by this much and fills sooner.
#define RADIANCE_CELL_COARSER 3u // levels

// FRadianceCell::State: updates | coarse | turn of the last update | turn of the last look-up. Turns are modulo 4,096.
#define RADIANCE_CELL_COUNT_MASK 0x7fu
#define RADIANCE_CELL_COARSE 0x80u
#define RADIANCE_CELL_UPDATED_SHIFT 8u
#define RADIANCE_CELL_ASKED_SHIFT 20u
#define RADIANCE_CELL_TURN_MASK 0xfffu

// What a slot of the table holds. Its key is in an array of its own.
struct FRadianceCell
{
	uint State; // RADIANCE_CELL_…
	uint Vote;  // the greatest of this frame's look-ups (MakeRadianceVote), then a claim (MakeVoteClaim); 0: nobody voted
	ivec3 Place; // where rays of updates start, in steps of the light grid (LIGHT_POSITION_STEPS), modulo 2^32
	uint GeometricNormal; // there: by PackOct24, and PackBefore's bits
	uint Normal;          // there: by PackOct24, and PackTrend's bits
	uint Light; // mean of irradiance / π, by PackRgbe
	uint From;  // mean direction that it comes from, each weighted by its luminance, by PackMeanDirection; its length says how alike they are. And PackRank's bits
};
LANTERN_ASSERT_SIZE(FRadianceCell, 36);

// What an update has found.
struct FRadianceResult
{
	vec3 Light;  // irradiance / π
	vec3 Moment; // the sum of its parts' luminance times their direction
	float Gone;  // luminance by which what comes by cells was more a moment ago
};
LANTERN_ASSERT_SIZE(FRadianceResult, 28);

// A look-up that voted. The one whose vote wins gives the cell its place.
struct FRadianceVote
{
	uint Slot; // NO_RADIANCE_CELL: there was no look-up; NEW_RADIANCE_CELL | name of a key: the cell is new, and has no slot yet
	uint Vote;
	ivec3 Place;
	uint GeometricNormal, Normal; // by PackOct24
};
LANTERN_ASSERT_SIZE(FRadianceVote, 28);

#define RADIANCE_SEED_SHIFT 8u // log2 of the steps of what random numbers of a cell are made of

#define NO_RADIANCE_CELL 0xffffffffu
#define NEW_RADIANCE_CELL 0x80000000u

#define RADIANCE_CELL_MOST_EVENTS 64u

// A lamp that has changed.
struct FRadianceEvent
{
	vec3 Center;    // relative to the scene's origin, metres
	float Radius;   // metres; negative: it shines from one direction on everything
	float Strength; // what came or went of its intensity, in units of radiance times square metres; or of its irradiance
	float Moved;    // way times intensity
};
LANTERN_ASSERT_SIZE(FRadianceEvent, 24);

struct FRadianceCellCounters
{
	uint Listed[RADIANCE_CELL_MOST_ROUNDS]; // cells that each round of the frame updates
	uint Lively[RADIANCE_CELL_MOST_ROUNDS]; // of these, such as are worth another round
	uint Cutoff; // bin of priority of which only a share is listed; those before it are listed wholly
	float Share;
	float Further; // part of the further updates that cells wanted in the frame before, and had
	uint Bins[RADIANCE_CELL_BINS]; // cells by priority
};
LANTERN_ASSERT_SIZE(FRadianceCellCounters, 332);

// What a frame did with the table, in this order (r.RT.GI.Cells.Count). Look-ups are those of pixels and of updates.
struct FRadianceCellStatistics
{
	uint Live;    // cells in use
	uint Young;   // of these, such of rank 1 and 2 that have had few updates and come before all others
	uint Updated; // updates, of all rounds
	uint Full;    // look-ups and votes that found no room for a cell at its level
	uint Found;   // look-ups that ended in the cell of their place
	uint Coarse;  // that ended in a coarse one instead
	uint Missed;  // that ended in none: the path went on
};
LANTERN_ASSERT_SIZE(FRadianceCellStatistics, 28);

// Paths that are followed although a cell has answered. The launch is cut into blocks, and one thread of each writes what its path has found.
#define RADIANCE_AUDIT_SIDE 64u    // blocks in a row, and rows
#define RADIANCE_AUDIT_PATHS 4096u // blocks
// What has answered.
#define RADIANCE_AUDIT_NONE 0u
#define RADIANCE_AUDIT_CELL 1u
#define RADIANCE_AUDIT_LEAVES 2u // a thick cell without a side
#define RADIANCE_AUDIT_COARSE 3u // a coarse cell that stands in
#define RADIANCE_AUDIT_LOST 4u   // none: the path ended at its last surface
#define RADIANCE_AUDIT_CLASSES 5u

struct FRadianceAuditPath
{
	uint Answer;             // RADIANCE_AUDIT_…; NONE: no look-up has answered, and no path was lost
	float Answered, Followed; // luminance that the pixel takes of the answer, and of what the path has found in its place
};
LANTERN_ASSERT_SIZE(FRadianceAuditPath, 12);

// The table as shaders see it, one block a frame.
struct FRadianceGrid
{
	FAddress Keys;        // uint[]: hash of a cell's place; 0: the slot is free. Those of earlier frames are above all others
	FAddress Cells;       // FRadianceCell[]
	FAddress Votes;       // FRadianceVote[VoteCount]
	FAddress UpdateVotes; // FRadianceVote[RADIANCE_CELL_MOST_UPDATES]: of updates, which count in the next frame
	FAddress List;        // uint[2][RADIANCE_CELL_MOST_UPDATES]: slots to update, of even rounds and of odd ones
	FAddress Marks;       // a bit for each slot, or entry of the list before, that a round lists
	FAddress Results;     // FRadianceResult[RADIANCE_CELL_MOST_UPDATES]
	FAddress Counters;    // FRadianceCellCounters
	ivec3 Origin;         // of the scene, as FLightGrid::Origin
	uint BucketMask;      // number of buckets - 1
	uint Turn;            // counts frames of the table, modulo 4,096
	uint Life;            // frames that a cell lives after its last look-up
	uint Budget;          // updates of a frame
	float RestChance;     // with which a pixel follows its paths that meet no cell
	float Window;         // frames over which light is averaged
	float SizeAngle;      // edge of a cell over its distance to the camera
	uint VoteCount;       // of Votes
	ivec3 Camera;         // in places of RADIANCE_SEED_SHIFT steps
	FAddress Events;      // FRadianceEvent[EventCount]
	uint EventCount;
	uint Room;            // updates that are traced at most
	FAddress Statistics;  // FRadianceCellStatistics; 0: nothing is counted
	uint LeastWait;       // frames from one update of a cell to the next, once it has had enough of them; 1 or more
	uint AskedTurns;      // cells that nobody has asked for in so many frames are not updated
	FAddress Movers;      // FMovedCaster[MoverCount]: what has moved lately
	uint MoverCount;
	float NearCells;      // rays of pixels that are shorter than so many cells of their place are followed, and end in none
	FAddress Audit;       // FRadianceAuditPath[RADIANCE_AUDIT_PATHS], zero before; 0: no path is followed for it
	float FollowChance;   // with which a pixel's paths are followed to correct what cells answer, with Audit
	float Moment;         // frames by which what a cell remembers of its light lags behind it; 0: nothing has changed for long
	uint Rounds;          // in which this frame updates cells whose light changes, 1 to RADIANCE_CELL_MOST_ROUNDS
	float StillWindow;    // frames over which light is averaged that does not change
	FAddress Scene;       // FSceneConstants
};
LANTERN_ASSERT_SIZE(FRadianceGrid, 200);

// Constants of the passes that keep the table.
struct FRadianceCellConstants
{
	FPassConstants Pass;
	FAddress Grid; // FRadianceGrid
	uint MaxBounces; // of paths that meet no cell
	uint Round;      // of this frame's updates
};
LANTERN_ASSERT_SIZE(FRadianceCellConstants, 32);

#define RADIANCE_CELL_VIEW_GROUP 8u

// Constants of the pass that shows cells.
struct FRadianceCellViewConstants
{
	FPassConstants Pass;
	FAddress Grid;       // FRadianceGrid
	uint Depth, Normals; // sampled indices
	uint Output;         // storage index
	uint bLight;         // 1: shows the light that cells know; 0: cells
};
LANTERN_ASSERT_SIZE(FRadianceCellViewConstants, 40);

LANTERN_SHARED_END

#endif
