// Traces a ray by inline ray query and makes the surface of what it hits, by the standard material program. Materials of other programs
// are seen through their standard parameters, and own shapes are not seen.
#ifndef LANTERN_QUERY_HIT_GLSL
#define LANTERN_QUERY_HIT_GLSL

#include "../Materials/Material.glsl"
#include "HitSurface.glsl"
#include "QueryRay.glsl"

// Flags: gl_RayFlags…. bForLight: the emission is what lights, and not what is seen (FMaterialData::LightEmissive).
FMaterialHit QueryMaterialHit(FSceneConstants Scene, uint Flags, uint Mask, vec3 Origin, vec3 Direction, float MaxDistance, bool bForLight)
{
	FMaterialHit Hit;
	Hit.Distance = -1.0;
	TraceRayQuery(Scene, Flags, Mask, Origin, Direction, MaxDistance);
	if (IsRayQueryMiss()) { return Hit; }
	FHitPlace Place;
	Place.Object = rayQueryGetIntersectionInstanceCustomIndexEXT(RayQuery, true);
	Place.Direction = Direction;
	Place.ObjectToWorld = rayQueryGetIntersectionObjectToWorldEXT(RayQuery, true);
	Place.WorldToObject = rayQueryGetIntersectionWorldToObjectEXT(RayQuery, true);
	uint SectionIndex = FObjectRef(Scene.Objects).Data[Place.Object].FirstSection + rayQueryGetIntersectionGeometryIndexEXT(RayQuery, true);
	FSectionData Section = FSectionRef(Scene.Sections).Data[SectionIndex];
	FMaterialData Material = FMaterialRef(Scene.Materials).Data[Section.Material];
#ifdef HAS_LIGHT_EMISSION
	if (bForLight) { Material.Emissive = Material.LightEmissive; }
#endif
	uint Primitive = rayQueryGetIntersectionPrimitiveIndexEXT(RayQuery, true);
	vec3 TriangleHit = vec3(rayQueryGetIntersectionTEXT(RayQuery, true), rayQueryGetIntersectionBarycentricsEXT(RayQuery, true)), P0, P1, P2;
	FetchPositions(Section, Primitive, P0, P1, P2);
	Place.ObjectNormal = cross(P1 - P0, P2 - P0);
	if ((Section.Flags & SECTION_PIECES) != 0u)
	{
		TriangleHit = IntersectTriangle(P0, P1, P2, rayQueryGetIntersectionObjectRayOriginEXT(RayQuery, true),
		                          rayQueryGetIntersectionObjectRayDirectionEXT(RayQuery, true));
	}
	Place.Distance = TriangleHit.x;
	Place.Cone = unpackHalf2x16(packHalf2x16(RayCone)); // as pipelines have it
	Place.UVArea = RayCone != vec2(0.0) ? FetchUVArea(Section, Primitive) : 0.0;
	FMaterialInputs Inputs = FetchMaterialInputs(Section, Primitive, TriangleHit.yz, Place.ObjectNormal);
	return MakeHitSurface(Scene, Section, Material, Inputs, Place);
}

#endif
