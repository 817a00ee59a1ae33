// Shades a hit of a material ray: evaluates the material program and packs the surface into the payload.
// PROCEDURAL: the hit is in a box (an intersection shader's), not on a triangle.
#version 460
#extension GL_EXT_ray_tracing : require
#include "../Library/Bindings.glsl"
#include "../Library/ObjectChannels.glsl"
#include "../Materials/Material.glsl"
#include "MaterialPayload.glsl"
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
	FMaterialData Material = FMaterialRef(Scene.Materials).Data[Section.Material];
#ifdef HAS_LIGHT_EMISSION
	if (Payload.W1 == ASKS_FOR_LIGHT) { Material.Emissive = Material.LightEmissive; }
#endif
#ifdef PROCEDURAL
	vec3 TriangleHit = vec3(gl_HitTEXT, 0.0, 0.0);
	vec3 ObjectNormal = OctDecode(NormalAttribute);
	FMaterialInputs Inputs = FMaterialInputs(ObjectNormal, vec4(0.0), vec2(0.0), vec2(0.0), vec4(1.0));
#else
	vec3 TriangleHit = vec3(gl_HitTEXT, Barycentrics), P0, P1, P2;
	FetchPositions(Section, gl_PrimitiveID, P0, P1, P2); // once: it is much code
	vec3 ObjectNormal = cross(P1 - P0, P2 - P0);         // any length
	if ((Section.Flags & SECTION_PIECES) != 0u)
	{
		TriangleHit = IntersectTriangle(P0, P1, P2, gl_ObjectRayOriginEXT, gl_ObjectRayDirectionEXT);
	}
	FMaterialInputs Inputs = FetchMaterialInputs(Section, gl_PrimitiveID, TriangleHit.yz, ObjectNormal);
#endif
	Inputs.Normal = (Inputs.Normal * gl_WorldToObjectEXT).xyz;
	mat3 ObjectToWorld = mat3(gl_ObjectToWorldEXT);
	Inputs.Tangent.xyz = ObjectToWorld * Inputs.Tangent.xyz;
	if (determinant(ObjectToWorld) < 0.0) { Inputs.Tangent.w = -Inputs.Tangent.w; } // the normal keeps the object's outside
	FMaterialSurface Surface = EvaluateMaterial(Material, Inputs, Scene.MaterialOverride);

	// The inverse transpose keeps the object's own outside, also where the transform mirrors.
	vec3 Ng = normalize((ObjectNormal * gl_WorldToObjectEXT).xyz);
	bool bFront = dot(Ng, gl_WorldRayDirectionEXT) < 0.0;
	bool bCulledSide = !bFront && (Section.Flags & SECTION_DOUBLE_SIDED) == 0u;
	if (!bFront)
	{
		Ng = -Ng;
		Surface.Normal = -Surface.Normal;
	}

	FMaterialHit Hit;
	Hit.Distance = TriangleHit.x;
	Hit.Normal = Surface.Normal;
	Hit.GeometricNormal = Ng;
	Hit.BaseColor = Surface.BaseColor;
	Hit.Roughness = Surface.Roughness;
	Hit.Metallic = Surface.Metallic;
	Hit.F0 = Surface.F0;
	Hit.Specular = Surface.Specular;
	Hit.Emissive = bCulledSide ? vec3(0.0) : Surface.Emissive;
	Hit.EmissiveWeight = (Section.Flags & SECTION_LIGHT) != 0u ? Material.EmissiveWeight : 0.0;
	uint ObjectFlags = FObjectRef(Scene.Objects).Data[gl_InstanceCustomIndexEXT].Flags;
	Hit.Flags = (bCulledSide ? HIT_CULLED_SIDE : 0u) | ((ObjectFlags & OBJECT_CHARACTER) != 0u ? HIT_CHARACTER : 0u);
	Hit.Channels = LoadObjectChannels(Scene, gl_InstanceCustomIndexEXT);
	Payload = PackHit(Hit);
}
