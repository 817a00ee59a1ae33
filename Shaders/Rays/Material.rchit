#version 460
#extension GL_EXT_ray_tracing : require
#include "../Library/Bindings.glsl"
#include "../Materials/Material.glsl"
#include "MaterialPayload.glsl"
#include "StandIn.glsl"

layout(shaderRecordEXT, scalar) readonly buffer FRecord { FSectionData Section; };
layout(push_constant, scalar) uniform FPush { FPassConstants Pass; };
layout(location = 0) rayPayloadInEXT FMaterialPayload Payload;
hitAttributeEXT vec2 Barycentrics;

void main()
{
	FSceneConstants Scene = FSceneRef(Pass.Scene).Data;
	CountStandIn(Scene.StandInHits, Section.Material);
	FMaterialData Material = FMaterialRef(Scene.Materials).Data[Section.Material];
	FMaterialInputs Inputs = FetchInputs(Section, gl_PrimitiveID, Barycentrics);
	Inputs.Normal = (Inputs.Normal * gl_WorldToObjectEXT).xyz;
	mat3 Linear = mat3(gl_ObjectToWorldEXT);
	Inputs.Tangent.xyz = Linear * Inputs.Tangent.xyz;
	if (determinant(Linear) < 0.0) { Inputs.Tangent.w = -Inputs.Tangent.w; } // the normal keeps the object's outside
	FMaterialSurface Surface = EvaluateMaterial(Material, Inputs, Scene.MaterialOverride);

	// The inverse transpose keeps the object's own outside, also where the transform mirrors.
	vec3 P0, P1, P2;
	FetchPositions(Section, gl_PrimitiveID, P0, P1, P2);
	vec3 Ng = normalize((cross(P1 - P0, P2 - P0) * gl_WorldToObjectEXT).xyz);
	bool bFront = dot(Ng, gl_WorldRayDirectionEXT) < 0.0;
	bool bCulledSide = !bFront && (Section.Flags & SECTION_DOUBLE_SIDED) == 0u;
	if (!bFront)
	{
		Ng = -Ng;
		Surface.Normal = -Surface.Normal;
	}

	FMaterialHit Hit;
	Hit.Distance = gl_HitTEXT;
	Hit.Normal = Surface.Normal;
	Hit.GeometricNormal = Ng;
	Hit.BaseColor = Surface.BaseColor;
	Hit.Roughness = Surface.Roughness;
	Hit.Metallic = Surface.Metallic;
	Hit.F0 = Surface.F0;
	Hit.Specular = Surface.Specular;
	Hit.Emissive = bCulledSide ? vec3(0.0) : Surface.Emissive;
	Hit.EmissiveWeight = (Section.Flags & SECTION_LIGHT) != 0u ? Material.EmissiveWeight : 0.0;
	Hit.Flags = bCulledSide ? HIT_CULLED_SIDE : 0u;
	Payload = PackHit(Hit);
}
