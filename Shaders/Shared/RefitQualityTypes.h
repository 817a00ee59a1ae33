// Constants of the measurement of refit quality, shared by C++ and GLSL.
#ifndef LANTERN_REFIT_QUALITY_TYPES_H
#define LANTERN_REFIT_QUALITY_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

#define REFIT_GROUP_TRIANGLES 32u // consecutive triangles that share a box
#define REFIT_GROUP_SIZE 32       // boxes for each work group
#define REFIT_INDEX_16 1u

struct FRefitQualityConstants
{
	FAddress Positions; // vec3[]
	FAddress Indices;   // 16 or 32 bits each; the address is a multiple of 4
	FAddress Sums;      // FRefitQualitySum[], one for each work group
	uint FirstIndex;
	uint TriangleCount;
	uint Flags; // REFIT_…
	uint Pad;
};
LANTERN_ASSERT_SIZE(FRefitQualityConstants, 40);

struct FRefitQualitySum
{
	float BoxArea;      // half the surface area of the boxes
	float TriangleArea; // twice the area of the triangles
};
LANTERN_ASSERT_SIZE(FRefitQualitySum, 8);

LANTERN_SHARED_END

#endif
