// Indirect light by brute force, for all signals.
#ifndef LANTERN_BRUTE_FORCE_TYPES_H
#define LANTERN_BRUTE_FORCE_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

struct FBruteForceConstants
{
	FPassConstants Pass;
	uint Depth, Normals, BaseColor, Material; // sampled indices; the last two: NO_TEXTURE for signals that read neither
	uint Output;                              // storage index
	uint SamplesPerPixel;
	uint MaxBounces; // scattering events, that at the pixel included
	float MaxRoughness; // rougher surfaces are not traced
	FAddress RadianceCells; // FRadianceGrid, for shaders with RADIANCE_CELLS; 0: there are none
	FAddress Deferred;      // FThreadList of paths that have met no radiance cell, for shaders with DEFERS_PATHS or DEFERRED_PATHS
	uint SecondOutput;      // storage index, for shaders with SECOND_LOBE
	float NearPixels;       // for shaders with SHARED_PATHS: paths that meet something within as many pixels light no pixels but the nearest
	FAddress GuideTiles;  // FPathGuideTile[] of the previous frame, for shaders with GUIDED_PATHS; 0: there are none
	FAddress PathRecords; // see FPathGuideConstants::Records
	FAddress ProbeGrid;   // FScreenProbeGrid, for shaders with SCREEN_PROBES
	FAddress Shared;  // FSharedPath[] of the first launch's threads, row by row, for shaders with SHARED_PATHS
	uint ToonPixels;  // sampled index of what ToonSurface.comp writes, or NO_TEXTURE: see ChooseGatherMask
	uint bHalf;       // pixels are those of the half frame
	uint BackAlbedo;  // sampled index, for shaders with BACK_PIXELS, which also read BaseColor and Material; NO_TEXTURE: of diffuse light alone
	uint Pad;
	FAddress Reservoirs; // FPathReservoirs, for shaders with PATH_RESERVOIRS
};
LANTERN_ASSERT_SIZE(FBruteForceConstants, 128);

// Of the pass that fills pixels which traced nothing.
struct FFillConstants
{
	FPassConstants Pass;
	uint Depth, Normals; // sampled indices
	uint Radiance;       // storage index
	uint Second;         // of what a second lobe reflects; NO_TEXTURE: there is none
};
LANTERN_ASSERT_SIZE(FFillConstants, 32);

LANTERN_SHARED_END

#endif
