// What is known of the light of one pixel (r.RT.Debug.Explain). Structures that C++ and GLSL share.
#ifndef LANTERN_EXPLAIN_TYPES_H
#define LANTERN_EXPLAIN_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

#define EXPLAINED_CELLS 4u            // fine and thin, fine and thick, coarse and thin, coarse and thick
#define EXPLAINED_UNKNOWN 0xffffffffu // instead of a number

// A radiance cell that a path's end at the pixel's place would try.
struct FExplainedCell
{
	uint Slot; // of the table; EXPLAINED_UNKNOWN: there is no such cell, and the rest is 0
	uint Key;
	uint Level;       // edge: RADIANCE_CELL_FINEST · 2^Level metres
	uint Updates;     // that its light is the mean of, RADIANCE_CELL_COUNT_MASK at most
	uint SinceUpdate; // frames
	uint SinceLookUp; // frames
	vec3 Light;       // mean of irradiance / π
	vec3 Place;       // where rays of its updates start, relative to the camera, metres
};
LANTERN_ASSERT_SIZE(FExplainedCell, 48);

struct FExplainedPixel
{
	uint bSurface; // 0: the sky, or outside the picture; the rest is 0
	vec3 Position; // relative to the camera, metres
	vec3 Normal;   // geometric
	uint Used;         // index of the cell that a path's end would take; EXPLAINED_UNKNOWN: none, it would go on
	uint LightCell;    // EXPLAINED_UNKNOWN: there is none
	uint ListedLights; // of the light cell; EXPLAINED_UNKNOWN: it has no list, and all lights are visited
	FExplainedCell Cells[EXPLAINED_CELLS];
};
LANTERN_ASSERT_SIZE(FExplainedPixel, 232);

// Constants of RadianceCells/Explain.comp.
struct FExplainConstants
{
	FPassConstants Pass;
	FAddress Grid;   // FRadianceGrid
	FAddress Lights; // FLightGrid; 0: there are no light cells
	FAddress Out;    // FExplainedPixel
	uint Depth, Normals; // sampled indices
	uint X, Y;
};
LANTERN_ASSERT_SIZE(FExplainConstants, 56);

LANTERN_SHARED_END

#endif
