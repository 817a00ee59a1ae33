// Indirect light in the air, by froxels: constants that C++ and GLSL share. FogTypes.h says where a froxel lies.
#ifndef LANTERN_INDIRECT_VOLUME_TYPES_H
#define LANTERN_INDIRECT_VOLUME_TYPES_H

#include "FogTypes.h"

LANTERN_SHARED_BEGIN

struct FIndirectVolumeConstants
{
	FPassConstants Pass;
	FFogGrid Grid;
	uint PreviousColumns, PreviousRows;
	uint Counts, PreviousCounts;        // sampled indices, as in FFogShadowConstants
	uint PreviousLight, PreviousMoment; // sampled indices, or NO_TEXTURE
	uint OutLight, OutMoment;           // storage indices
	float Share;     // of what is traced, against the history
	uint Samples;    // paths of a froxel that is traced
	uint MaxBounces; // of paths that meet no radiance cell
	uint FirstVoter; // of FRadianceGrid::Votes; each column of a traced slice has one
	FAddress RadianceCells; // FRadianceGrid
};
LANTERN_ASSERT_SIZE(FIndirectVolumeConstants, 96);

LANTERN_SHARED_END

#endif
