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

#define EMITTER_CHANGES 64u // most clusters that are followed; of more, none is

struct FEmitterChange
{
	uint Cluster;           // FEmissiveCluster[]
	FEmitterCluster Before; // in the last frame, relative to this frame's origin of the scene
};
LANTERN_ASSERT_SIZE(FEmitterChange, 68);

struct FLampChanges
{
	uint Count;         // may exceed LAMP_CHANGES; it does where nobody has noted what lights were
	uint EmitterCount;  // may exceed EMITTER_CHANGES
	FLampChange Changes[LAMP_CHANGES];
	FEmitterChange Emitters[EMITTER_CHANGES];
};
LANTERN_ASSERT_SIZE(FLampChanges, 8456);

// Of ListLamps.comp and ListEmitters.comp.
struct FListChangesConstants
{
	FPassConstants Pass;
	FAddress Kept; // FLightData[] or FEmitterCluster[], Count of them: as of the last frame, and then of this one
	FAddress List; // FLampChanges
	uint Count;
	uint bFresh;   // 1: there is no last frame
};
LANTERN_ASSERT_SIZE(FListChangesConstants, 40);

struct FFollowLampsConstants
{
	FPassConstants Pass;
	FAddress List;  // FLampChanges
	FAddress Guide; // FTileGuide[], this frame's
	uint Depth, Normals, BaseColor, Material; // sampled indices
	uint OutDiffuse, OutSpecular; // storage indices, or NO_TEXTURE: by how much lobes have changed, over their albedo; and the standard deviation of that
	uint Channels;  // HAS_LIGHT_CHANNELS only: see LoadPixelChannels
	uint BackAlbedo; // sampled index, or NO_TEXTURE
};
LANTERN_ASSERT_SIZE(FFollowLampsConstants, 64);

LANTERN_SHARED_END

#endif
