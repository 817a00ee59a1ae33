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
};
LANTERN_ASSERT_SIZE(FReferenceConstants, 40);

LANTERN_SHARED_END

#endif
