// Constants of the passes that find emissive triangles, shared by C++ and GLSL.
#ifndef LANTERN_EMISSIVE_TYPES_H
#define LANTERN_EMISSIVE_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

#define EMISSIVE_GROUP_SIZE 64u        // triangles of a cluster that a work group does at a time
#define EMISSIVE_POWERS_GROUP_SIZE 256u
#define EMISSIVE_TEXTURE_POINTS 16u    // of a triangle, at which its emissive texture is read

struct FEmissiveConstants
{
	FPassConstants Pass;
	FAddress Clusters; // uint[], those to do; 0: all
	uint Count;        // of clusters to do
	uint Pad;
};
LANTERN_ASSERT_SIZE(FEmissiveConstants, 32);

LANTERN_SHARED_END

#endif
