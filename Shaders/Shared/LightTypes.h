// Lights as shaders see them: structures that C++ and GLSL share.
#ifndef LANTERN_LIGHT_TYPES_H
#define LANTERN_LIGHT_TYPES_H

#include "SharedTypes.h"

LANTERN_SHARED_BEGIN

// FLightData::Flags
#define LIGHT_TYPE_MASK 15u
#define LIGHT_NONE 0u // the slot is free
#define LIGHT_POINT 1u
#define LIGHT_DIRECTIONAL 2u
#define LIGHT_RECTANGLE 3u
#define LIGHT_DISK 4u
#define LIGHT_SPHERE 5u
#define LIGHT_TUBE 6u // the surface of a capsule
#define LIGHT_CASTS_SHADOW 16u
#define LIGHT_TWO_SIDED 32u // rectangle, disk: it shines to its back as well
#define LIGHT_HAS_CONE 64u
#define LIGHT_IN_FOG 128u // fog scatters it
#define LIGHT_CHANNELS_SHIFT 8  // 8 bits, exclusive-or CHANNELS_DEFAULT: it lights objects that share one of them
#define LIGHT_PROFILE_SHIFT 16  // 16 bits: number of its profile, from 1; 0: it has none
#define LIGHT_PROFILES_MOST 65535u

#define CHANNELS_DEFAULT 1u // of lights, of objects, and of pixels whose object is not known

// Lights have positions in the whole world, in steps of 1/LIGHT_POSITION_STEPS m modulo 2^32. The difference from the scene's
// origin is exact up to 262 km, and nothing is rewritten if the origin moves.
#define LIGHT_POSITION_STEPS 8192.0f

#define LIGHT_INDEX_BITS 24 // of a light's number; the highest tells emissive triangles from lights (LocalLightTypes.h)

// A light. Those without extent are of KHR_lights_punctual.
struct FLightData
{
	ivec3 Position; // steps
	uint Flags;     // LIGHT_…
	vec3 Color;     // point: cd, with a profile those at its peak; directional: lux; others: nits
	float Range;    // metres; 0: unlimited
	uint Direction; // octahedral, 2 × snorm16, in which the light travels; rectangle, disk: normal
	uint Tangent;   // octahedral: width of a rectangle, axis of a tube, horizontal angle 0 of a profile
	vec2 Size;      // metres; rectangle: half width, half height; disk, sphere: radius; tube: radius, half length; directional: 1 − cosine
	                // of its angular radius
	float SpotScale; // angular attenuation: saturate(cos · scale + offset)²
	float SpotOffset;
	uint Number; // names it to readers of the light mask; not 0, and another one for a later light of its slot
};
LANTERN_ASSERT_SIZE(FLightData, 60);

// Intensity of a luminaire by direction, over its peak: photometry of type C (IES LM-63-2002) on a regular grid. Vertical angles are
// from the light's direction. Horizontal ones turn from its tangent counterclockwise as seen along the direction, which is from above
// a lamp that shines down.
struct FLightProfile
{
	uint First;      // into the table of texels; there are two in a word, 65,535 being the peak, and those of a column follow each other
	uint Rows;       // of vertical angles, from FirstAngle on; 0: it shines nowhere
	uint Columns;    // of horizontal angles, all around; 1: it is the same all around
	float FirstAngle; // degrees. Before the first and behind the last row it is dark
	float RowsPerDegree;
	float ColumnsPerDegree;
};
LANTERN_ASSERT_SIZE(FLightProfile, 24);

LANTERN_SHARED_END

#endif
