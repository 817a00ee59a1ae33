// Traces the queue of shadow rays; the ray-tracing pipeline and the ray-query path share it. A request's kind and index give origin,
// direction, length, mask and flags. The includer defines
//   float TraceShadowRay(vec3 Origin, vec3 Direction, float Length, uint Flags, uint Mask)
//     distance to a blocker; negative: the ray is unblocked. What leaves no more than LeastTransmittance of the light blocks it
//
// HAS_TRANSMISSION: light shines through some surfaces. NO_SHARES: what leaves more than half of it blocks none.
// SUN_RAYS, LOCAL_RAYS, MANY_LIGHTS: defined if somebody asks for rays to the sun, to local lights, to lights chosen of many.
// WITH_PENUMBRA: also writes the width of the sun's penumbra, for the filter.
// ONE_SAMPLE: see SamplesPerPixel.glsl.
#ifndef LANTERN_SHADOW_QUEUE_GLSL
#define LANTERN_SHADOW_QUEUE_GLSL

#include "../Shared/RayQueueTypes.h"
#include "../Library/Casters.glsl"
#include "../Library/GBuffer.glsl"
#include "../Library/Random.glsl"
#include "../Library/Sun.glsl"
#include "RayQueue.glsl"

layout(push_constant, scalar) uniform FPush { FShadowQueueConstants Push; };

float TraceShadowRay(vec3 Origin, vec3 Direction, float Length, uint Flags, uint Mask);

// A ray sees its light or does not. Behind what lets a share of light through it sees as often as that share says, where a filter follows:
// the threshold is drawn. Those of a pixel follow each other by the golden ratio, so that few frames have a good mean.
float LeastTransmittance = 0.5;
const float SoftBlockerDistance = 16.0; // metres, of what blocks by chance: the filter then takes the noise for a wide penumbra

// Number: of the pixel's rays in a frame. bFiltered: else what leaves more than half passes whole, which has no noise.
void DrawLeastTransmittance(uint Index, uint Number, bool bFiltered)
{
#if defined(HAS_TRANSMISSION) && !defined(NO_SHARES)
	const uint GoldenRatio = 0x9e3779b9u; // of 2^32
	uint Start = HashPcg(Index ^ HashPcg(Number));
	LeastTransmittance = bFiltered ? float((Start + FViewRef(Push.Pass.View).Data.FrameIndex * GoldenRatio) >> 8u) / 16777216.0 : 0.5;
#endif
}

// Share: of the light that arrives where nothing solid is in the way.
float PassOrBlock(float Share) { return Share > LeastTransmittance ? -1.0 : SoftBlockerDistance; }

#include "SamplesPerPixel.glsl"

// Characters cast on everything but characters.
bool ShowsCharacter(FSceneConstants Scene, uvec2 Pixel)
{
#ifdef HAS_CHARACTERS
	return IsCharacterPixel(Scene, Push.Classes, Push.ClassesOffset, Push.Motion, ivec2(Pixel));
#else
	return false;
#endif
}

#ifdef SUN_RAYS
// MoreSample: of Push.MoreSamples.
void TraceSun(uint Index, uint Casters, uint MoreSample)
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
	Scene.SunOneMinusCos = Push.SunOneMinusCos;
	uvec2 Pixel = uvec2(Index % View.Width, Index / View.Width);
	FGBufferPoint Point = LoadGBufferPoint(View, Push.Normals, ivec2(Pixel), LoadDepth(Push.Depth, ivec2(Pixel)));
	uint Mask = ShowsCharacter(Scene, Pixel) ? Casters & ~MASK_CHARACTER : Casters;
	float BlockerDistanceSum = 0.0;
	uint Seen = 0u, Blocked = 0u;
	FTileSequence Sequence = MakeTileSequence(Pixel, View.FrameIndex, HashPcg(View.Seed));
	bool bMore = Push.MoreSamples > 0u;
	uint Samples = bMore ? 1u : SamplesPerPixel, FirstSample = Sequence.Index * SamplesPerPixel;
	if (bMore)
	{
		FirstSample = Sequence.Index * Push.MoreSamples + MoreSample;
		Sequence.Seed = HashPcg(Sequence.Seed); // the pixel's first rays have points of their own
	}
	for (uint Sample = 0; Sample < Samples; ++Sample)
	{
		vec3 Direction = -Scene.SunDirection;
		if (Push.SunOneMinusCos > 0.0) { Direction = SampleSunDirection(Scene, SobolOwen2(FirstSample + Sample, Sequence.Seed)); }
		FaceDirection(Point, Direction);
		if (!LeavesSurface(View, Point, Direction)) { continue; }
#ifdef WITH_PENUMBRA
		DrawLeastTransmittance(Index, bMore ? SamplesPerPixel + MoreSample : Sample, Push.SunOneMinusCos > 0.0);
#endif
		float BlockerDistance =
			TraceShadowRay(RasterRayOrigin(Scene, View, Point), Direction, Push.MaxDistance, Push.RayFlags, Mask);
		Seen += BlockerDistance < 0.0 ? 1u : 0u;
		Blocked += BlockerDistance < 0.0 ? 0u : 1u;
		BlockerDistanceSum += max(BlockerDistance, 0.0);
	}
	atomicAdd(FAnswerRef(Push.Answers).Data[Index], PackSunAnswer(Seen, Samples - Seen));
#ifdef WITH_PENUMBRA
	if (bMore) { return; } // the last of several threads would win
	float Diameter = 2.0 * sqrt(2.0 * Scene.SunOneMinusCos);
	FWidthRef(Push.SunWidths).Data[Index] = Blocked > 0u ? Diameter * BlockerDistanceSum / float(Blocked) : -1.0;
#endif
}
#endif

#ifdef LOCAL_RAYS
#include "../LocalLights/LocalRays.glsl"
#endif

void TraceRequest(uint Number)
{
	uint MoreSample = 0u;
	if (Push.MoreSamples > 0u)
	{
		MoreSample = Number % Push.MoreSamples;
		Number /= Push.MoreSamples;
	}
	FRayQueueCounters Counters = FRayQueueCountersRef(Push.Counters).Data;
	// Launches are rounded up, or made for a full queue.
	if (Number >= SegmentEnd(Counters, RAY_SEGMENTS - 1u, Push.Capacity)) { return; }
	FRayRequest Request = FRayRequestRef(Push.Requests).Data[Number];
	switch (RayKind(Request))
	{
#ifdef SUN_RAYS
	case RAY_KIND_SUN: TraceSun(RayIndex(Request), RaySlot(Request) == RAY_SLOT_SUN_LIT ? Push.LitMask : Push.InstanceMask, MoreSample); break;
#endif
#ifdef LOCAL_RAYS
	case RAY_KIND_LOCAL: TraceLocal(RayIndex(Request), RaySlot(Request), MoreSample); break;
#endif
#ifdef MANY_LIGHTS
	case RAY_KIND_CHOSEN: TraceChosen(RayIndex(Request), RaySlot(Request)); break;
#endif
	}
}

#endif
