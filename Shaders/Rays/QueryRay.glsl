// Traces a ray by inline ray query, with the alpha test in its loop. HAS_MASKED: the scene has alpha-tested sections.
#ifndef LANTERN_QUERY_RAY_GLSL
#define LANTERN_QUERY_RAY_GLSL

#include "../Library/Bindings.glsl"
#ifdef HAS_MASKED
#include "../Materials/AlphaTest.glsl"
#include "AnyHitCount.glsl"
#endif

layout(set = 0, binding = 3) uniform accelerationStructureEXT Scenes[];

rayQueryEXT RayQuery; // of the thread's last ray

// Leaves what it has met in RayQuery. Flags: gl_RayFlags….
void TraceRayQuery(FSceneConstants Scene, uint Flags, uint Mask, vec3 Origin, vec3 Direction, float MaxDistance)
{
	bool bToLight = (Flags & gl_RayFlagsTerminateOnFirstHitEXT) != 0u; // light shines through; who looks for surfaces meets them
	rayQueryInitializeEXT(RayQuery, Scenes[Scene.Tlas], Flags, Mask, Origin, 0.0, Direction, MaxDistance);
	while (rayQueryProceedEXT(RayQuery))
	{
		// Boxes are skipped: their intersection shaders run in ray-tracing pipelines only.
		if (rayQueryGetIntersectionTypeEXT(RayQuery, false) != gl_RayQueryCandidateIntersectionTriangleEXT) { continue; }
#ifdef HAS_MASKED
		uint Object = rayQueryGetIntersectionInstanceCustomIndexEXT(RayQuery, false);
		uint SectionIndex = FObjectRef(Scene.Objects).Data[Object].FirstSection + rayQueryGetIntersectionGeometryIndexEXT(RayQuery, false);
		FSectionData Section = FSectionRef(Scene.Sections).Data[SectionIndex];
		// Geometry that another object alpha-tests is a candidate here as well, without being masked.
		bool bMasked = (Section.Flags & SECTION_MASKED) != 0u;
		if (bToLight && (Section.Flags & SECTION_TRANSMISSIVE) != 0u) { continue; }
		if (bMasked) { CountAnyHit(Scene.AnyHitCounter); }
		uint Primitive = rayQueryGetIntersectionPrimitiveIndexEXT(RayQuery, false);
		vec3 TriangleHit = vec3(0.0, rayQueryGetIntersectionBarycentricsEXT(RayQuery, false));
		if ((Section.Flags & SECTION_PIECES) != 0u)
		{
			TriangleHit = IntersectTriangle(Section, Primitive, rayQueryGetIntersectionObjectRayOriginEXT(RayQuery, false),
			                          rayQueryGetIntersectionObjectRayDirectionEXT(RayQuery, false));
		}
		bool bOutside = IsOutsideTriangle(Section, TriangleHit);
		if (!bMasked || !(bOutside || IsHitCutAway(FMaterialRef(Scene.Materials), Section, Primitive, TriangleHit.yz)))
		{
			rayQueryConfirmIntersectionEXT(RayQuery);
		}
#else
		rayQueryConfirmIntersectionEXT(RayQuery);
#endif
	}
}

bool IsRayQueryMiss() { return rayQueryGetIntersectionTypeEXT(RayQuery, true) == gl_RayQueryCommittedIntersectionNoneEXT; }

// Returns the distance to a blocker, which need not be the nearest one; negative: the ray is unblocked.
float QueryBlockerDistance(FSceneConstants Scene, uint Flags, uint Mask, vec3 Origin, vec3 Direction, float MaxDistance)
{
	TraceRayQuery(Scene, Flags | gl_RayFlagsTerminateOnFirstHitEXT, Mask, Origin, Direction, MaxDistance);
	return IsRayQueryMiss() ? -1.0 : rayQueryGetIntersectionTEXT(RayQuery, true);
}

#endif
