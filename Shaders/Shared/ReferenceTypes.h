#ifndef LANTERN_REFERENCE_TYPES_H
#define LANTERN_REFERENCE_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

struct FReferenceConstants
{
	FPassConstants Pass;
	FAddress Sum; // vec4[Width · Height], sum of all samples so far
	uint FirstSample;
	uint SampleCount; // of this dispatch
	uint MaxBounces;
	uint FirstRow; // a dispatch renders a band of rows, so that none runs for seconds
	uint bPixelCenters; // all camera rays through the pixel's centre
	float OcclusionRadius; // metres
	uint OcclusionMask;    // of objects that occlude
	uint Depth, Normals, BaseColor, Material; // sampled indices, where the raster's surfaces are taken
	uint Pad;
};
LANTERN_ASSERT_SIZE(FReferenceConstants, 72);

LANTERN_SHARED_END

#endif
