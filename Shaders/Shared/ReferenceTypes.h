// Constants of the reference path tracer, shared by C++ and GLSL.
#ifndef LANTERN_REFERENCE_TYPES_H
#define LANTERN_REFERENCE_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

struct FReferenceConstants
{
	FPassConstants Pass;
	FAddress Sum; // vec4[Width · Height]: rgb sum of all samples so far, a their count
	uint FirstSample;
	uint SampleCount; // of this dispatch
	uint MaxBounces;
	uint FirstRow; // of this dispatch: the frame is split into bands of rows, so that no dispatch takes seconds
	uint bPixelCenters; // 1: all camera rays pass through the pixel's centre
	float OcclusionRadius; // metres
	uint OcclusionMask;    // instance mask of ambient occlusion rays
	uint Depth, Normals, BaseColor, Material; // sampled indices, FROM_GBUFFER only
	float ReflectedRoughness; // rougher surfaces trace no reflections; negative: none do
	uint Channels; // FROM_GBUFFER with HAS_LIGHT_CHANNELS only: see LoadPixelChannels
	uint Emissive; // sampled index, FROM_GBUFFER of the whole frame only
	uint ToonPixels; // sampled index, FROM_GBUFFER only, or NO_TEXTURE: see ChooseGatherMask
	uint BackAlbedo; // sampled index, FROM_GBUFFER with HAS_DIFFUSE_TRANSMISSION only
};
LANTERN_ASSERT_SIZE(FReferenceConstants, 88);

LANTERN_SHARED_END

#endif
