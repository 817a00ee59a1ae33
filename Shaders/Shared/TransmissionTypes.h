// Surfaces in front of the G-buffer's that light shines through.
#ifndef LANTERN_TRANSMISSION_TYPES_H
#define LANTERN_TRANSMISSION_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

// Constants of Transmission/Transmission.rgen and .comp.
struct FTransmissionConstants
{
	FPassConstants Pass;
	uint Depth, Normals; // sampled indices
	uint Light;         // storage index: radiance that the surfaces send to the camera
	uint Transmittance; // storage index: what they leave of what lies behind
	uint Looks;         // storage index: what they show of other pixels, see Transmission/Looks.glsl
	uint MostLayers;    // sheets that a pixel shows one behind the other
	uint MaxBounces;    // scattering events of a path, where no radiance cells end it
	uint FirstVoter;    // place in FRadianceGrid::Votes from which on those of this pass lie
	FAddress RadianceCells; // FRadianceGrid; 0: there are none
};
LANTERN_ASSERT_SIZE(FTransmissionConstants, 56);

// Constants of Transmission/Composite.comp.
struct FTransmissionCompositeConstants
{
	FPassConstants Pass;
	uint Lighting, Light, Transmittance, Looks; // sampled indices
	uint Output;                                // storage index
	uint Pad;
};
LANTERN_ASSERT_SIZE(FTransmissionCompositeConstants, 40);

LANTERN_SHARED_END

#endif
