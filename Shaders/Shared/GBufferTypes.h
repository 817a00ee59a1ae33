#ifndef LANTERN_GBUFFER_TYPES_H
#define LANTERN_GBUFFER_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

struct FGBufferConstants
{
	FPassConstants Pass;
	FAddress Objects; // uint[instances of the draw]
	uint Section;     // of each of these objects
	uint Pad;
};
LANTERN_ASSERT_SIZE(FGBufferConstants, 32);

// One deformed geometry; a dispatch takes several, one in each layer of its groups.
struct FSkinItem
{
	FAddress SourcePositions;
	FAddress SourceAttributes;
	FAddress Weights; // FSkinVertex[]
	FAddress Joints;  // mat4[]
	FAddress Positions;
	FAddress Attributes;
	FAddress PreviousPositions; // gets what Positions held; 0: nobody wants it
	uint VertexCount;
	uint Pad;
};
LANTERN_ASSERT_SIZE(FSkinItem, 64);

struct FSkinConstants
{
	FAddress Items; // FSkinItem[]
};
LANTERN_ASSERT_SIZE(FSkinConstants, 8);

struct FSkinVertex
{
	uint Joints01, Joints23; // 16 bits each
	vec4 Weights;            // sum 1
};
LANTERN_ASSERT_SIZE(FSkinVertex, 24);

#define SKIN_GROUP_SIZE 64

LANTERN_SHARED_END

#endif
