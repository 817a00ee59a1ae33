// Constants of skinning, shared by C++ and GLSL.
#ifndef LANTERN_SKINNING_TYPES_H
#define LANTERN_SKINNING_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

// One deformed geometry. A dispatch processes several, one for each z of its work groups.
struct FSkinItem
{
	FAddress SourcePositions;  // float3[], bind pose
	FAddress SourceAttributes; // FVertexAttributes[], bind pose
	FAddress Weights; // FSkinVertex[]
	FAddress Joints;  // mat4[]
	FAddress Positions;         // float3[], output
	FAddress Attributes;        // FVertexAttributes[], output
	FAddress PreviousPositions; // float3[], receives the old content of Positions; 0: not wanted
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
	vec4 Weights;            // their sum is 1
};
LANTERN_ASSERT_SIZE(FSkinVertex, 24);

#define SKIN_GROUP_SIZE 64 // vertices for each work group

LANTERN_SHARED_END

#endif
