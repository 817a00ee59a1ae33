// Reflections: constants of their passes, and what their rays leave.
#ifndef LANTERN_REFLECTION_TYPES_H
#define LANTERN_REFLECTION_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

// What the ray of a listed pixel met: see FKeptHit.
struct FReflectionHit
{
	float Distance; // by way of further mirrors, metres; below 0: the sky
	uint Normal;    // geometric, octahedral
	uint Object;    // into FObjectData[]
};
LANTERN_ASSERT_SIZE(FReflectionHit, 12);

// The G-buffer as sampled indices.
struct FReflectionPixels
{
	uint Depth, Normals, BaseColor, Material;
};
LANTERN_ASSERT_SIZE(FReflectionPixels, 16);

// Where reflections fade out.
struct FReflectionFade
{
	float End;   // roughness from which on none are traced, if Slope is not 0
	float Slope; // 1 / roughness over which they fade out before; 0: all count in full
};
LANTERN_ASSERT_SIZE(FReflectionFade, 8);

// Constants of Reflections/List.comp.
struct FReflectionListConstants
{
	FPassConstants Pass;
	FReflectionPixels Pixels;
	uint Radiance, Mirrored, Surface, Anchors; // storage indices, cleared where nothing is traced; the last two may be NO_TEXTURE
	uint FirstVoter;                 // place in FRadianceGrid::Votes from which on those of this pass lie
	uint Picture;                    // storage index, as in FReflectionSurfaceConstants; cleared as well
	FReflectionFade Fade;
	FAddress List;                   // FThreadList
	FAddress RadianceCells;          // FRadianceGrid; 0: there are none
	uint Reach;                      // storage index, cleared as well; may be NO_TEXTURE
	uint Pad;
};
LANTERN_ASSERT_SIZE(FReflectionListConstants, 88);

// How a path of a reflection ended.
#define PATH_END_NONE 0u     // no direction left the surface
#define PATH_END_SKY 1u
#define PATH_END_CELL 2u     // a radiance cell knew the light
#define PATH_END_STAND_IN 3u // at a mirror, whose cell's light stood in for what it shows
#define PATH_END_DARK 4u     // where nothing was known, or all was absorbed
#define PATH_ENDS 5u

// Counts of a frame, with r.RT.Rays.CountEnds.
struct FReflectionStatistics
{
	uint Mirrors, Sharp, Wide; // pixels that traced, by roughness: IsMirror, below LitRoughness, others
	uint Further;              // paths of the second launch, where light has changed
	uint Lit;                  // paths whose first hit was lit by light sampling
	uint Ends[PATH_ENDS];      // paths, by PATH_END_…
};
LANTERN_ASSERT_SIZE(FReflectionStatistics, 40);

// Constants of Reflections/Paths.rgen and .comp.
struct FReflectionPathConstants
{
	FPassConstants Pass;
	FReflectionPixels Pixels;
	uint Radiance; // storage index: over the directional albedo of the lobe, and of a mirrored surface. a: CHANCE_…
	uint Mirrored; // storage index: albedo and emission of what mirrors show, rgb9e5 each; other pixels have none
	uint SamplesPerPixel;
	uint MaxBounces;          // scattering events, that at the pixel included
	float LitRoughness;       // smoother surfaces show hits by light sampling, rougher ones by radiance cells
	float EmissionRoughness;  // rougher surfaces leave emission to light sampling
	uint FirstVoter;          // as above
	uint FirstSamples;        // paths that the pixels have already; 0: none. What the paths meet is then kept already, too
	float FurtherPaths;       // with FirstSamples: paths of the launch at most, over the pixels of FirstList; SamplesPerPixel is the most of a pixel
	uint Pad;
	FAddress List;            // FThreadList
	FAddress FirstList;       // with FirstSamples: FThreadList of all pixels that have paths
	FAddress Hits;            // FReflectionHit[], by place in the list
	FAddress RadianceCells;   // as above
	FAddress Statistics;      // FReflectionStatistics; COUNTS_ENDS only
};
LANTERN_ASSERT_SIZE(FReflectionPathConstants, 112);

// Constants of Reflections/Changed.comp.
struct FReflectionChangedConstants
{
	FPassConstants Pass;
	FReflectionPixels Pixels;
	uint Radiance;       // sampled index
	uint Anchors;        // sampled index
	uint History;        // sampled index: as in FTemporalConstants; NO_TEXTURE: there is none
	uint ChangedShare;   // sampled index: FDenoiseInputs::ChangedShare
	FAddress List;       // FThreadList: pixels that were traced
	FAddress OutList;    // FThreadList: those that are traced further
	float LeastFrames;   // that histories must be worth
	uint Pad;
};
LANTERN_ASSERT_SIZE(FReflectionChangedConstants, 72);

// Constants of Reflections/Surface.comp.
struct FReflectionSurfaceConstants
{
	FPassConstants Pass;
	FReflectionPixels Pixels;
	uint Motion;          // sampled index: FGBuffer::Motion; NO_TEXTURE: there is none
	uint bNamesObjects;   // FGBuffer::bNamesObjects
	uint PreviousSurface; // sampled index; NO_TEXTURE: there is nothing to reproject
	uint PreviousAnchors; // sampled index, or NO_TEXTURE
	FAddress List;        // FThreadList
	FAddress Hits;        // FReflectionHit[]
	uint OutSurface;      // storage index
	uint OutAnchors;      // storage index
	uint Picture;         // storage index: where images came from, for r.RT.Debug.View; NO_TEXTURE: nobody asks
	uint OutReach;        // storage index: FDenoiseInputs::Reach
};
LANTERN_ASSERT_SIZE(FReflectionSurfaceConstants, 80);

// Constants of Reflections/Combine.comp.
struct FReflectionCombineConstants
{
	FPassConstants Pass;
	FReflectionPixels Pixels;
	uint Radiance;      // sampled index: filtered
	uint Mirrored;      // sampled index: as above
	uint Output;        // storage index: the signal
	FReflectionFade Fade;
	uint Pad;
};
LANTERN_ASSERT_SIZE(FReflectionCombineConstants, 56);

// Constants of Reflections/Toon.comp.
struct FReflectionToonConstants
{
	FPassConstants Pass;
	FReflectionPixels Pixels;
	uint ToonPixels;                // sampled index of what ToonSurface.comp writes
	uint OutBaseColor, OutMaterial; // storage indices
	float Threshold;                // metalness above which there are reflections
	float MinRoughness, MaxRoughness;
	float Tint; // share of the metal's colour in the reflection's, 0 to 1
	uint Pad;
};
LANTERN_ASSERT_SIZE(FReflectionToonConstants, 64);

LANTERN_SHARED_END

#endif
