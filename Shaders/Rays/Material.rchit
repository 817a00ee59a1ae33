// Shades a hit of a material ray: evaluates the material program and packs the surface into the payload.
// PROCEDURAL: the hit is in a box (an intersection shader's), not on a triangle.
#version 460
#extension GL_EXT_ray_tracing : require
#include "../Library/Bindings.glsl"
#include "../Materials/Material.glsl"
#include "HitSurface.glsl"
#include "StandIn.glsl"

layout(shaderRecordEXT, scalar) readonly buffer FRecord { FSectionData Section; };
layout(push_constant, scalar) uniform FPush { FPassConstants Pass; };
layout(location = 0) rayPayloadInEXT FMaterialPayload Payload;
#ifdef PROCEDURAL
hitAttributeEXT vec2 NormalAttribute; // see Intersection.glsl
#else
hitAttributeEXT vec2 Barycentrics;
#endif

void main()
{
	FSceneConstants Scene = FSceneRef(Pass.Scene).Data;
	CountStandIn(Scene.StandInHits, Section.Material);
	vec2 Cone = unpackHalf2x16(Payload.W2);
	FMaterialData Material = FMaterialRef(Scene.Materials).Data[Section.Material];
#ifdef HAS_LIGHT_EMISSION
	if (Payload.W1 == ASKS_FOR_LIGHT) { Material.Emissive = Material.LightEmissive; }
#endif
#ifdef PROCEDURAL
	vec3 TriangleHit = vec3(gl_HitTEXT, 0.0, 0.0);
	vec3 ObjectNormal = OctDecode(NormalAttribute);
	FMaterialInputs Inputs = FMaterialInputs(ObjectNormal, vec4(0.0), vec2(0.0), vec2(0.0), vec4(1.0), 0.0);
	const float UVArea = 0.0;
#else
	vec3 TriangleHit = vec3(gl_HitTEXT, Barycentrics), P0, P1, P2;
	FetchPositions(Section, gl_PrimitiveID, P0, P1, P2); // once: it is much code
	vec3 ObjectNormal = cross(P1 - P0, P2 - P0);         // any length
	if ((Section.Flags & SECTION_PIECES) != 0u)
	{
		TriangleHit = IntersectTriangle(P0, P1, P2, gl_ObjectRayOriginEXT, gl_ObjectRayDirectionEXT);
	}
	FMaterialInputs Inputs = FetchMaterialInputs(Section, gl_PrimitiveID, TriangleHit.yz, ObjectNormal);
	float UVArea = Cone != vec2(0.0) ? FetchUVArea(Section, gl_PrimitiveID) : 0.0;
#endif
	FHitPlace Place = FHitPlace(gl_InstanceCustomIndexEXT, TriangleHit.x, ObjectNormal, gl_WorldRayDirectionEXT, gl_ObjectToWorldEXT, gl_WorldToObjectEXT, Cone, UVArea);
	Payload = PackHit(MakeHitSurface(Scene, Section, Material, Inputs, Place));
}
