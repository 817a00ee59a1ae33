// What is known of the sun's visibility before a ray is traced, shared by C++ and GLSL.
#ifndef LANTERN_SETTLED_TYPES_H
#define LANTERN_SETTLED_TYPES_H

#include "TileTypes.h"

LANTERN_SHARED_BEGIN

// Frames in which all of a pixel's rays had one answer, from which on the pixel counts as settled.
#define SETTLED_FRAMES 16u
// Frames for which a tile is traced in full after a moved caster's shadow may have touched it.
#define SETTLED_FRAMES_AFTER 4u
#define SETTLED_MOST_CASTERS 256

// A texel of the history (R8_UNORM): frames with one answer, at most SETTLED_FRAMES, and this bit if the rays saw the sun.
#define SETTLED_LIT 128u

// Sphere around a caster, swept from where it was to where it is, relative to the scene's origin.
struct FMovedCaster
{
	vec3 From;
	float Radius; // metres
	vec3 To;
	float Changed;  // about the part of what it hides, or of how it looks, that is new: 0 to 1
	float Emission; // mean radiance of what it emits; 0 as well if that is as it was, and nothing moved
	uint Object;    // into FObjectData[]
	uint bCasts;    // 0: it looks different, and no shadow has changed by that
};
LANTERN_ASSERT_SIZE(FMovedCaster, 44);

struct FSettledConstants
{
	FAddress Casters; // FMovedCaster[CasterCount]
	uint CasterCount; // at most SETTLED_MOST_CASTERS
	uint bAnywhere;   // 1: any shadow may have moved, and all tiles are traced in full
	uint Turn;        // counts the view's frames
	float RateDistance; // from which on fewer pixels are traced, metres; 0: all are
	uint Surface, Reprojection, Motion;    // sampled indices, see FTemporalConstants
	uint Previous;                         // sampled index: history of the frame before; NO_TEXTURE, with Reprojection and Motion: none
	uint Current;                          // storage index: history for the next frame; NO_TEXTURE: none, and no Surface
	uint Pad;
};
LANTERN_ASSERT_SIZE(FSettledConstants, 48);

// Constants of Tiles/CheckSettled.comp.
struct FCheckSettledConstants
{
	FPassConstants Pass;
	FAddress Tiles;    // FTile[]
	FAddress Answers;  // uint[pixels]
	FAddress Marks; // FSunQueueConstants::Marks, of SunRest
	uint Settled; // storage index: see FSettledConstants::Current
	uint Pad;
};
LANTERN_ASSERT_SIZE(FCheckSettledConstants, 48);

// Constants of Tiles/TileView.comp.
struct FTileViewConstants
{
	FPassConstants Pass;
	FAddress Tiles; // FTile[]
	uint Output;    // storage index
	uint bRays;     // 1: rays of each pixel; 0: classes of tiles
};
LANTERN_ASSERT_SIZE(FTileViewConstants, 32);

LANTERN_SHARED_END

#endif
