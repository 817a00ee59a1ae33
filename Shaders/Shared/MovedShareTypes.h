// By how much objects that move and lamps that change may have changed a surface's light.
#ifndef LANTERN_MOVED_SHARE_TYPES_H
#define LANTERN_MOVED_SHARE_TYPES_H

#include "SettledTypes.h"

LANTERN_SHARED_BEGIN

struct FMovedShareConstants
{
	FPassConstants Pass;
	FAddress Casters; // FMovedCaster[CasterCount]
	uint CasterCount; // at most SETTLED_MOST_CASTERS
	uint Depth, Normals; // sampled indices
	uint Output;         // storage index; x: share of the light, y: radiance
	uint LampCount;      // at most RADIANCE_CELL_MOST_EVENTS
	float Moment;        // see FRadianceGrid, with Changes
	FAddress Lamps;      // FRadianceEvent[LampCount]
	FAddress Changes;    // FPathChange[tiles] of the paths that brought the light; 0: nobody knows by how much it has changed of late
	uint Material;       // sampled index: the light of specular lobes is asked for. NO_TEXTURE: that from all around
	uint Shown;          // sampled index, with Material: FDenoiseInputs::Surface of what mirrors show
};
LANTERN_ASSERT_SIZE(FMovedShareConstants, 72);

LANTERN_SHARED_END

#endif
