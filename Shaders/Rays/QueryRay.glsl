// Traces a ray by inline ray query, with the alpha test in its loop. HAS_MASKED: the scene has alpha-tested sections.
// HAS_TRANSMISSION: light shines through some.
#ifndef LANTERN_QUERY_RAY_GLSL
#define LANTERN_QUERY_RAY_GLSL

#include "../Library/Bindings.glsl"
#ifdef HAS_MASKED
#include "../Materials/AlphaTest.glsl"
#include "AnyHitCount.glsl"
#endif
#ifdef HAS_TRANSMISSION
#include "../Materials/SeeThrough.glsl"
#endif

layout(set = 0, binding = 3) uniform accelerationStructureEXT Scenes[];

rayQueryEXT RayQuery; // of the thread's last ray
float RayDepth;       // −ln of what surfaces that it shone through have left of it

bool IsCandidateCutAway(FSceneConstants Scene, FSectionData Section, uint Primitive)
{
#ifdef HAS_MASKED
	if ((Section.Flags & SECTION_MASKED) == 0u) { return false; }
	CountAnyHit(Scene.AnyHitCounter);
	vec3 TriangleHit = vec3(0.0, rayQueryGetIntersectionBarycentricsEXT(RayQuery, false));
	if ((Section.Flags & SECTION_PIECES) != 0u)
	{
		TriangleHit = IntersectTriangle(Section, Primitive, rayQueryGetIntersectionObjectRayOriginEXT(RayQuery, false),
		                          rayQueryGetIntersectionObjectRayDirectionEXT(RayQuery, false));
	}
	return IsOutsideTriangle(Section, TriangleHit) || IsHitCutAway(FMaterialRef(Scene.Materials), Section, Primitive, TriangleHit.yz);
#else
	return false;
#endif
}

// Leaves what it has met in RayQuery. Flags: gl_RayFlags….
void TraceRayQuery(FSceneConstants Scene, uint Flags, uint Mask, vec3 Origin, vec3 Direction, float MaxDistance)
{
	bool bToLight = (Flags & gl_RayFlagsTerminateOnFirstHitEXT) != 0u; // light shines through; who looks for surfaces meets them
	RayDepth = 0.0;
	rayQueryInitializeEXT(RayQuery, Scenes[Scene.Tlas], Flags, Mask, Origin, 0.0, Direction, MaxDistance);
	while (rayQueryProceedEXT(RayQuery))
	{
		// Boxes are skipped: their intersection shaders run in ray-tracing pipelines only.
		if (rayQueryGetIntersectionTypeEXT(RayQuery, false) != gl_RayQueryCandidateIntersectionTriangleEXT) { continue; }
#if defined(HAS_MASKED) || defined(HAS_TRANSMISSION)
		uint Object = rayQueryGetIntersectionInstanceCustomIndexEXT(RayQuery, false);
		uint SectionIndex = FObjectRef(Scene.Objects).Data[Object].FirstSection + rayQueryGetIntersectionGeometryIndexEXT(RayQuery, false);
		FSectionData Section = FSectionRef(Scene.Sections).Data[SectionIndex];
		uint Primitive = rayQueryGetIntersectionPrimitiveIndexEXT(RayQuery, false);
#ifdef HAS_TRANSMISSION
		if (bToLight && (Section.Flags & SECTION_TRANSMISSIVE) != 0u)
		{
			float Depth = SeeThroughDepth(FMaterialRef(Scene.Materials), Section, Primitive, rayQueryGetIntersectionBarycentricsEXT(RayQuery, false),
			                              rayQueryGetIntersectionObjectRayDirectionEXT(RayQuery, false));
			RayDepth += Depth;
			if (Depth < SolidDepth) { continue; }
		}
#endif
		// Geometry that another object alpha-tests is a candidate here as well, without being masked.
		if (!IsCandidateCutAway(Scene, Section, Primitive)) { rayQueryConfirmIntersectionEXT(RayQuery); }
#else
		rayQueryConfirmIntersectionEXT(RayQuery);
#endif
	}
}

bool IsRayQueryMiss() { return rayQueryGetIntersectionTypeEXT(RayQuery, true) == gl_RayQueryCommittedIntersectionNoneEXT; }

// Returns the share of light that arrives along a ray.
float QueryTransmittance(FSceneConstants Scene, uint Flags, uint Mask, vec3 Origin, vec3 Direction, float MaxDistance)
{
	TraceRayQuery(Scene, Flags | gl_RayFlagsTerminateOnFirstHitEXT, Mask, Origin, Direction, MaxDistance);
	return IsRayQueryMiss() ? exp(-RayDepth) : 0.0;
}

#endif
