// Screen probes: points on the surfaces of a grid of tiles of the screen, which find the light from all directions for the pixels around
// them. Structures that C++ and GLSL share.
#ifndef LANTERN_SCREEN_PROBE_TYPES_H
#define LANTERN_SCREEN_PROBE_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

#define SCREEN_PROBE_SIDE 8u   // texels along the side of a probe's octahedral map of world directions
#define SCREEN_PROBE_TEXELS 64 // its square; a probe has as many rays

#define NO_SCREEN_PROBE 0xffffffffu

// What a probe keeps until the next frame.
struct FScreenProbe
{
	vec3 Relative;        // place relative to the camera, metres
	float Distance;       // along the view, metres; 0: the tile shows no surface
	uint GeometricNormal; // octahedral
	uint Pixel;           // y << 16 | x
	uint Previous;        // number of the last frame's probe there; NO_SCREEN_PROBE: there is none
	uint Pad;
	uint Light[SCREEN_PROBE_TEXELS];      // mean radiance of each texel, shared with probes around, by PackRgbe
	uint Irradiance[SCREEN_PROBE_TEXELS]; // over π, by PackRgbe: an octahedral map of normals in the hemisphere of GeometricNormal
};
LANTERN_ASSERT_SIZE(FScreenProbe, 544);

// Where a probe's rays go in this frame.
struct FScreenProbePlan
{
	uint Texels[SCREEN_PROBE_TEXELS]; // first ray | number of rays << 8. Behind the rays: mean radiance that they found, by PackRgbe
	// Texel of each ray. Behind the rays, by texel: number of those that were traced | mean inverse of the distance to what they hit << 16, a
	// half float.
	uint Rays[SCREEN_PROBE_TEXELS];
};
LANTERN_ASSERT_SIZE(FScreenProbePlan, 512);

// What a ray has found.
struct FScreenProbeRay
{
	vec3 Radiance;
	float Distance; // metres; 0: it found nothing. A short ray of a pixel finds nothing if it meets nothing
};
LANTERN_ASSERT_SIZE(FScreenProbeRay, 16);

struct FScreenProbeGrid
{
	FAddress Probes;   // FScreenProbe[Columns * Rows], row by row
	FAddress Previous; // of the frame before; 0: there are none
	FAddress Plans;    // FScreenProbePlan[Columns * Rows]
	FAddress Rays;     // FScreenProbeRay[Columns * Rows * SCREEN_PROBE_TEXELS]
	FAddress NearRays; // FScreenProbeRay[]: short rays of one pixel of four, row by row (Library/Rate.glsl)
	uint Columns, Rows;
	uint Spacing;      // pixels along the side of a tile
	uint RaysPerVote;  // for the place of radiance cells
	float NearReach;   // length of short rays over the width of a tile at their distance; 0: there are none
	uint Pad;
};
LANTERN_ASSERT_SIZE(FScreenProbeGrid, 64);

// Of the passes before and behind the rays.
struct FScreenProbeConstants
{
	FPassConstants Pass;
	FAddress Grid;       // FScreenProbeGrid
	uint Depth, Normals; // sampled indices
	uint BaseColor, Material; // sampled indices, where there is a second lobe
	uint Output, SecondOutput; // storage indices
};
LANTERN_ASSERT_SIZE(FScreenProbeConstants, 48);

LANTERN_SHARED_END

#endif
