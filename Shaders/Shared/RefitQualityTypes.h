#ifndef LANTERN_REFIT_QUALITY_TYPES_H
#define LANTERN_REFIT_QUALITY_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

#define REFIT_GROUP_TRIANGLES 32u // consecutive ones share a box
#define REFIT_GROUP_SIZE 32       // boxes for each work group
#define REFIT_INDEX_16 1u

struct FRefitQualityConstants
{
	FAddress Positions; // vec3[]
	FAddress Indices;   // a multiple of 4
	FAddress Sums;      // FRefitQualitySum[], one for each work group
	uint FirstIndex;
	uint TriangleCount;
	uint Flags; // REFIT_…
	uint Pad;
};
LANTERN_ASSERT_SIZE(FRefitQualityConstants, 40);

struct FRefitQualitySum
{
	float BoxArea;      // half the surface of the boxes
	float TriangleArea; // twice that of the triangles
};
LANTERN_ASSERT_SIZE(FRefitQualitySum, 8);

LANTERN_SHARED_END

#endif
