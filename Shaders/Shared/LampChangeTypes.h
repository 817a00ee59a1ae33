// Lights that have changed since the last frame, shared by C++ and GLSL.
#ifndef LANTERN_LAMP_CHANGE_TYPES_H
#define LANTERN_LAMP_CHANGE_TYPES_H

#include "LightTypes.h"
#include "LocalLightTypes.h"

LANTERN_SHARED_BEGIN

#define LAMP_CHANGES 64u // most lights that are followed; of more, what was accumulated is given up
#define LAMP_WORDS 15u   // of FLightData
#define LAMP_CHANGE_UNKNOWN -1.0f // in place of a standard deviation: what was accumulated is given up

struct FLampChange
{
	uint Light;        // index in the table of lights
	FLightData Before; // in the last frame
};
LANTERN_ASSERT_SIZE(FLampChange, 64);

struct FLampChanges
{
	uint Count; // may exceed LAMP_CHANGES; it does where nobody has noted what lights were
	FLampChange Changes[LAMP_CHANGES];
};
LANTERN_ASSERT_SIZE(FLampChanges, 4100);

struct FListLampsConstants
{
	FPassConstants Pass;
	FAddress Kept;  // FLightData[Slots]: as of the last frame, and then of this one
	FAddress List;  // FLampChanges
	uint Slots;
	uint bFresh;    // 1: there is no last frame
};
LANTERN_ASSERT_SIZE(FListLampsConstants, 40);

struct FFollowLampsConstants
{
	FPassConstants Pass;
	FAddress List;  // FLampChanges
	FAddress Guide; // FTileGuide[], this frame's
	uint Depth, Normals, BaseColor, Material; // sampled indices
	uint Output;    // storage index: by how much the lobe has changed, over its albedo; and the standard deviation of that
	uint bSpecular; // 1: of the specular lobe
	uint Channels;  // HAS_LIGHT_CHANNELS only: see LoadPixelChannels
	uint Pad;
};
LANTERN_ASSERT_SIZE(FFollowLampsConstants, 64);

LANTERN_SHARED_END

#endif
