// Light in fog: its froxels, and constants that C++ and GLSL share.
#ifndef LANTERN_FOG_TYPES_H
#define LANTERN_FOG_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

// Slices are as thick as their distance suggests: slice = Slices · log2(1 + z · FOG_STEEPNESS / Distance) / log2(1 + FOG_STEEPNESS),
// z along the view axis. Near the camera they are evenly spaced.
#define FOG_STEEPNESS 64.0f
#define FOG_LOG2_STEEPNESS 6.022367813f // log2(1 + FOG_STEEPNESS)
#define FOG_GROUP_SIZE 8                // threads in x and y
#define FOG_MOST_SLICES 256
#define FOG_EDGE 1.5f // distances of neighbours that differ by more than this factor show an edge of something

// Froxels of a view: columns of PixelSize² pixels, cut by slices. Their atlas has PerRow slices side by side, Columns × Rows texels each.
struct FFogGrid
{
	uint Columns, Rows, Slices;
	uint PerRow;
	uint PixelSize;
	float Distance; // at which the last slice ends, metres
};
LANTERN_ASSERT_SIZE(FFogGrid, 24);

// Of the pass that finds how far each column is seen. x of Counts is twice the number of slices that are lit, plus the turn of the frame,
// in which even or odd slices are traced. y is where what the column shows ends, in slices.
struct FFogColumnsConstants
{
	FPassConstants Pass;
	FFogGrid Grid;
	uint PreviousColumns, PreviousRows;
	uint Depth;          // sampled index: farthest distance of each column in the frame before, 0: unlimited; NO_TEXTURE: nothing is known
	uint PreviousCounts; // sampled index, or NO_TEXTURE
	uint OutCounts;      // storage index
	uint Pad;
};
LANTERN_ASSERT_SIZE(FFogColumnsConstants, 64);

struct FFogShadowConstants
{
	FPassConstants Pass;
	FFogGrid Grid;
	uint PreviousColumns, PreviousRows;
	uint Counts, PreviousCounts;             // sampled indices; the latter NO_TEXTURE: there is no history
	uint PreviousVisibility, PreviousLight;  // sampled indices, or NO_TEXTURE
	uint OutVisibility, OutLight;            // storage indices, or NO_TEXTURE
	float Share;   // of what is traced, against the history
	float Phase;   // g of Henyey and Greenstein
	float SunOneMinusCos;
	uint RayFlags;
};
LANTERN_ASSERT_SIZE(FFogShadowConstants, 88);

struct FFogDepthConstants
{
	FPassConstants Pass;
	uint PixelSize;
	uint Depth;  // sampled index
	uint Output; // storage index
	uint Pad;
};
LANTERN_ASSERT_SIZE(FFogDepthConstants, 32);

LANTERN_SHARED_END

#endif
