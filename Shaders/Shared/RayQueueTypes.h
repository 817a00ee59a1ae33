// The queue of shadow rays, shared by C++ and GLSL: who asks for a ray writes a request, one shader traces all of them, and the
// answers lie in a word for each pixel.
#ifndef LANTERN_RAY_QUEUE_TYPES_H
#define LANTERN_RAY_QUEUE_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

#define RAY_QUEUE_GROUP_SIZE 64 // rays of a work group of the ray-query path
#define RAY_QUEUE_ROW_GROUPS 64 // work groups in x; y grows, since a device need not dispatch more than 65,535 in one direction

// Kinds of rays. An index names what a ray belongs to; a slot tells several rays of one index apart.
#define RAY_KIND_SUN 0u // index: pixel, row by row; a request is for all samples of the pixel; slot: 0, or RAY_SLOT_SUN_LIT
#define RAY_KIND_LOCAL 1u // index: pixel; slot: place of the light in the list of the pixel's tile
#define RAY_KIND_CHOSEN 2u // index: pixel; slot: which of the lights that the pixel chose
#define RAY_SLOT_SUN_LIT 1u // the pixel is lit by the host's shadow map: rays look for other casters

#define RAY_INDEX_BITS 26u
#define RAY_SLOT_BITS 3u

struct FRayRequest
{
	uint Packed; // index, slot and kind, from the lowest bit on
};
LANTERN_ASSERT_SIZE(FRayRequest, 4);

// The queue is filled in segments, one pass after the other. Each lies behind those before it.
#define RAY_SEGMENT_SUN 0u
#define RAY_SEGMENT_LOCAL 1u
#define RAY_SEGMENTS 2u

struct FRaySegment
{
	uint Wanted; // requests that were made, those without room included
	uint Kept;   // requests that are there after they were shared out; read if Wanted exceeds the room behind earlier segments
};

// Zeroed in each frame before requests are written. The first two are arguments of indirect commands.
struct FRayQueueCounters
{
	uint Groups[3]; // of the ray-query path
	uint Launch[3]; // width, height and depth of the ray-tracing pipeline's launch
	FRaySegment Segments[RAY_SEGMENTS];
};
LANTERN_ASSERT_SIZE(FRayQueueCounters, 40);

// A pixel's answers. Each kind has bits of its own, which start as 0. Those of the sun are counts and add up; others are combined by or.
// The order of rays never shows in them.
#define ANSWER_LOCAL_SEEN 0u // lowest of 8 bits, one for each slot: its light is seen
#define ANSWER_LOCAL_TRACED 8u // lowest of 8 bits: its ray was traced
#define ANSWER_CHOSEN_SEEN 16u // bit: the chosen light is seen; of further choices, ANSWER_LOCAL_SEEN and so on
#define ANSWER_CHOSEN_TRACED 17u
#define ANSWER_SUN_SEEN 18u   // lowest of 7 bits: samples that see the sun
#define ANSWER_SUN_UNSEEN 25u // lowest of 7 bits: samples that do not; without an answer, either number is 0
#define ANSWER_SUN_MASK 0x7fu

// Further rays of a pixel to a light in a slot, each in a thread of its own. Their answers are a word for each pixel: the lowest 8 bits
// say which slots have some, and behind them are LOCAL_MORE_RAYS bits for each slot, of the rays that see the light.
#define LOCAL_MORE_RAYS 3u
#define ANSWER_MORE_SLOTS 0xffu
#define ANSWER_MORE_SEEN 8u // lowest bit of the first slot

struct FShadowQueueConstants
{
	FPassConstants Pass;
	FAddress Requests; // FRayRequest[Capacity]
	FAddress Counters; // FRayQueueCounters
	FAddress Answers;  // uint[pixels]
	// float[pixels]: width of the penumbra across the sun's direction, by the mean distance of what blocks the pixel's rays, metres.
	// < 0: no ray met anything. Written for pixels that ask for rays, with WITH_PENUMBRA.
	FAddress SunWidths;
	FAddress TileLights; // FTileLights[]; 0: no rays to local lights
	FAddress Choices;    // FLightChoice[choices][pixels]; 0: no pixel chooses
	uint Capacity;
	uint Depth;           // sampled index
	uint Normals;         // sampled index: shading and geometric normal, both octahedral
	uint SamplesPerPixel; // of the sun, 1 to 64
	float MaxDistance;    // of sun rays, metres
	uint RayFlags;        // of all rays: gl_RayFlags… to add to those that the pass needs
	uint InstanceMask;    // of sun rays
	uint LitMask;         // of sun rays with RAY_SLOT_SUN_LIT
	float SunOneMinusCos; // of the disk that sun rays go to, see FSceneConstants; 0: hard shadows, from its centre
	uint Motion;          // sampled index, or NO_TEXTURE: FGBuffer::Motion, for HAS_CHARACTERS
	uint Classes;         // sampled index, or NO_TEXTURE: FGBuffer::Classes, for HAS_CHARACTERS
	uint ClassesOffset;   // of the view in Classes, pixels: x | y << 16
	// Further samples of each request, each in a thread of its own: of the sun, which come on top of earlier answers, or LOCAL_MORE_RAYS of a
	// light in a slot. 0: a thread traces what a request asks for at first.
	uint MoreSamples;
	uint Pad;
	FAddress MoreAnswers; // uint[pixels]: see LOCAL_MORE_RAYS; 0: MoreSamples are of the sun
};
LANTERN_ASSERT_SIZE(FShadowQueueConstants, 128);

LANTERN_SHARED_END

#endif
