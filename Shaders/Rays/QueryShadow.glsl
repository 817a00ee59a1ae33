// Traces a shadow ray by inline ray query. HAS_MASKED: the scene has alpha-tested sections, whose test runs here.
#ifndef LANTERN_QUERY_SHADOW_GLSL
#define LANTERN_QUERY_SHADOW_GLSL

#include "../Library/Bindings.glsl"
#ifdef HAS_MASKED
#include "../Materials/AlphaTest.glsl"
#include "AnyHitCount.glsl"
#endif

layout(set = 0, binding = 3) uniform accelerationStructureEXT Scenes[];

// Returns the distance to a blocker, which need not be the nearest one; negative: the ray is unblocked. Flags: gl_RayFlags….
float QueryBlockerDistance(FSceneConstants Scene, uint Flags, uint Mask, vec3 Origin, vec3 Direction, float MaxDistance)
{
	rayQueryEXT Query;
	rayQueryInitializeEXT(Query, Scenes[Scene.Tlas], Flags | gl_RayFlagsTerminateOnFirstHitEXT, Mask, Origin, 0.0, Direction, MaxDistance);
	while (rayQueryProceedEXT(Query))
	{
		// Boxes are skipped: their intersection shaders run in ray-tracing pipelines only.
		if (rayQueryGetIntersectionTypeEXT(Query, false) != gl_RayQueryCandidateIntersectionTriangleEXT) { continue; }
#ifdef HAS_MASKED
		uint Object = rayQueryGetIntersectionInstanceCustomIndexEXT(Query, false);
		uint SectionIndex = FObjectRef(Scene.Objects).Data[Object].FirstSection + rayQueryGetIntersectionGeometryIndexEXT(Query, false);
		FSectionData Section = FSectionRef(Scene.Sections).Data[SectionIndex];
		// Geometry that another object alpha-tests is a candidate here as well, without being masked.
		bool bMasked = (Section.Flags & SECTION_MASKED) != 0u;
		if (bMasked) { CountAnyHit(Scene.AnyHitCounter); }
		uint Primitive = rayQueryGetIntersectionPrimitiveIndexEXT(Query, false);
		vec3 TriangleHit = vec3(0.0, rayQueryGetIntersectionBarycentricsEXT(Query, false));
		if ((Section.Flags & SECTION_PIECES) != 0u)
		{
			TriangleHit = IntersectTriangle(Section, Primitive, rayQueryGetIntersectionObjectRayOriginEXT(Query, false),
			                          rayQueryGetIntersectionObjectRayDirectionEXT(Query, false));
		}
		bool bOutside = IsOutsideTriangle(Section, TriangleHit);
		if (!bMasked || !(bOutside || IsHitCutAway(FMaterialRef(Scene.Materials), Section, Primitive, TriangleHit.yz)))
		{
			rayQueryConfirmIntersectionEXT(Query);
		}
#else
		rayQueryConfirmIntersectionEXT(Query);
#endif
	}
	bool bVisible = rayQueryGetIntersectionTypeEXT(Query, true) == gl_RayQueryCommittedIntersectionNoneEXT;
	return bVisible ? -1.0 : rayQueryGetIntersectionTEXT(Query, true);
}

#endif
