// A shadow ray without a pipeline. HAS_MASKED: the scene has alpha-tested sections, whose test runs here.
#ifndef LANTERN_QUERY_SHADOW_GLSL
#define LANTERN_QUERY_SHADOW_GLSL

#include "../Library/Bindings.glsl"
#ifdef HAS_MASKED
#include "../Materials/AlphaTest.glsl"
#include "AnyHitCount.glsl"
#endif

layout(set = 0, binding = 3) uniform accelerationStructureEXT Scenes[];

// Distance to what is in the way, not the nearest; negative: nothing is.
float QueryBlocker(FSceneConstants Scene, uint Flags, uint Mask, vec3 Origin, vec3 Direction, float MaxDistance)
{
	rayQueryEXT Query;
	rayQueryInitializeEXT(Query, Scenes[Scene.Tlas], Flags | gl_RayFlagsTerminateOnFirstHitEXT, Mask, Origin, 0.0, Direction, MaxDistance);
	while (rayQueryProceedEXT(Query))
	{
		// What is in a box only a material program knows, and these run in pipelines alone.
		if (rayQueryGetIntersectionTypeEXT(Query, false) != gl_RayQueryCandidateIntersectionTriangleEXT) { continue; }
#ifdef HAS_MASKED
		uint Object = rayQueryGetIntersectionInstanceCustomIndexEXT(Query, false);
		uint SectionIndex = FObjectRef(Scene.Objects).Data[Object].FirstSection + rayQueryGetIntersectionGeometryIndexEXT(Query, false);
		FSectionData Section = FSectionRef(Scene.Sections).Data[SectionIndex];
		// A geometry whose alpha test is some other object's.
		bool bMasked = (Section.Flags & SECTION_MASKED) != 0u;
		if (bMasked) { CountAnyHit(Scene.AnyHitCounter); }
		uint Primitive = rayQueryGetIntersectionPrimitiveIndexEXT(Query, false);
		vec3 Where = vec3(0.0, rayQueryGetIntersectionBarycentricsEXT(Query, false));
		if ((Section.Flags & SECTION_PIECES) != 0u)
		{
			Where = IntersectTriangle(Section, Primitive, rayQueryGetIntersectionObjectRayOriginEXT(Query, false),
			                          rayQueryGetIntersectionObjectRayDirectionEXT(Query, false));
		}
		bool bBeside = IsBesideTriangle(Section, Where);
		if (!bMasked || !(bBeside || IsHitCutAway(FMaterialRef(Scene.Materials), Section, Primitive, Where.yz)))
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
