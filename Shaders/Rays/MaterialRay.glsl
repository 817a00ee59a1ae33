// Traces a ray and returns the surface that it hits: inline, or through a ray-tracing pipeline.
// STANDARD_HITS: all hits are seen as the standard material program shows them. STANDARD_HITS_UNSEEN: those are that only light what is
//   seen; SEES_HITS(true) stands before the first ray of what is. Neither counts where no material has a program of its own.
#ifndef LANTERN_MATERIAL_RAY_GLSL
#define LANTERN_MATERIAL_RAY_GLSL

#include "../Library/EmissionShare.glsl"
#include "PathRayCount.glsl"
#ifdef RAY_QUERY
#include "QueryHit.glsl"
#else
#include "MaterialPayload.glsl"
#include "RayCone.glsl"
#include "ShadowPayload.glsl"

layout(set = 0, binding = 3) uniform accelerationStructureEXT Scenes[];
layout(location = 0) rayPayloadEXT FMaterialPayload MaterialPayload;
layout(location = 1) rayPayloadEXT FShadowPayload ShadowPayload;
#endif

// HIT_TYPE: number of a ray's type, by which its hit and its miss are found.
#if defined(STANDARD_HITS_UNSEEN) && defined(STANDARD_RAY)
bool bSeesHits = true;
#define HIT_TYPE (bSeesHits ? MATERIAL_RAY : STANDARD_RAY)
#define SEES_HITS(bSees) bSeesHits = bSees
#else
#if defined(STANDARD_HITS) && defined(STANDARD_RAY)
#define HIT_TYPE STANDARD_RAY
#else
#define HIT_TYPE MATERIAL_RAY
#endif
#define SEES_HITS(bSees)
#endif

const float Infinity = 1.0e30;

// Surfaces that light shines through count as not opaque (FRangeFlags::bOpaqueGlass). Their meshes have other parts as well, which need not be met.
uint RayFlagsOf(uint Mask) { return Mask == MASK_TRANSMISSIVE ? gl_RayFlagsCullOpaqueEXT : 0u; }

// Shows: what of emission is asked for; SHOWS_NOTHING: what lights.
FMaterialHit TraceMaterial(FSceneConstants Scene, uint Mask, vec3 Origin, vec3 Direction, float MaxDistance, uint Shows)
{
	CountPathRay(Scene, PATH_RAY_SURFACE);
#ifdef RAY_QUERY
	return QueryMaterialHit(Scene, RayFlagsOf(Mask), Mask, Origin, Direction, MaxDistance, Shows == SHOWS_NOTHING);
#else
#ifdef HAS_LIGHT_EMISSION
	MaterialPayload.W1 = Shows == SHOWS_NOTHING ? ASKS_FOR_LIGHT : 0u;
#endif
	MaterialPayload.W2 = packHalf2x16(RayCone);
#ifdef REORDER
	// Threads that hit alike run the hit's shader together.
	hitObjectNV Hit;
	hitObjectTraceRayNV(Hit, Scenes[Scene.Tlas], RayFlagsOf(Mask), Mask, HIT_TYPE, RAY_TYPES, HIT_TYPE, Origin, 0.0, Direction, MaxDistance, 0);
	reorderThreadNV(Hit);
	hitObjectExecuteShaderNV(Hit, 0);
#else
	traceRayEXT(Scenes[Scene.Tlas], RayFlagsOf(Mask), Mask, HIT_TYPE, RAY_TYPES, HIT_TYPE, Origin, 0.0, Direction, MaxDistance, 0);
#endif
	return UnpackHit(MaterialPayload);
#endif
}

FMaterialHit TraceMaterial(FSceneConstants Scene, vec3 Origin, vec3 Direction)
{
	return TraceMaterial(Scene, MASK_VISIBLE, Origin, Direction, Infinity, SHOWS_ALL);
}

#endif
