// Constants of the pass that finds the channels of pixels, shared by C++ and GLSL.
#ifndef LANTERN_PIXEL_CHANNELS_TYPES_H
#define LANTERN_PIXEL_CHANNELS_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

#define PIXEL_CHANNELS_GROUP_SIZE 8 // threads in x and y

struct FPixelChannelsConstants
{
	FPassConstants Pass;
	uint Host;        // sampled index of FGBuffer::Channels, or NO_TEXTURE: Motion names the objects
	uint Motion;      // sampled index of FGBuffer::Motion
	uint HostOffset;  // of the view in Host, pixels, 2 × 16 bits
	uint Output;      // storage index, R8_UNORM: the channels over 255
};
LANTERN_ASSERT_SIZE(FPixelChannelsConstants, 32);

LANTERN_SHARED_END

#endif
