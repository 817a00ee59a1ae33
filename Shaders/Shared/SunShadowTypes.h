// Constants of sun shadows, shared by C++ and GLSL.
#ifndef LANTERN_SUN_SHADOW_TYPES_H
#define LANTERN_SUN_SHADOW_TYPES_H

#include "ContactTypes.h"
#include "TileTypes.h"

LANTERN_SHARED_BEGIN

struct FSunShadowConstants
{
	FPassConstants Pass;
	FAddress Tiles;   // FTile[]
	FAddress Answers; // uint[pixels]
	FAddress Widths;  // as in FShadowQueueConstants; 0 without OutPenumbra
	uint Depth;       // sampled index
	uint Normals;     // sampled index: shading and geometric normal, both octahedral
	uint Output;      // storage index
	uint SamplesPerPixel;
	uint OutPenumbra; // storage index, or NO_TEXTURE
	uint Kept;        // sampled index: visibility of the frame before, for pixels whose rays had no room; NO_TEXTURE: those are lit
	uint OutKept;     // storage index: Kept of the next frame; NO_TEXTURE: all rays have room
	uint Settled;     // ADAPTIVE only, storage index: see FSettledConstants::Current
	FContactConstants Contact; // CONTACT only
	float SunOneMinusCos; // of the disk that rays go to, see FTilesConstants
	uint Pad;
};
LANTERN_ASSERT_SIZE(FSunShadowConstants, 96);

LANTERN_SHARED_END

#endif
