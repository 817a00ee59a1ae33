// Makes the surface of a hit, for hit shaders and for ray queries. The includer includes a material program before.
#ifndef LANTERN_HIT_SURFACE_GLSL
#define LANTERN_HIT_SURFACE_GLSL

#include "../Library/ObjectChannels.glsl"
#include "MaterialPayload.glsl"
#include "RayCone.glsl"

// Where a ray has met the surface of an object.
struct FHitPlace
{
	uint Object;
	float Distance;    // metres
	vec3 ObjectNormal; // geometric, object space, of any length
	vec3 Direction;    // of the ray
	mat4x3 ObjectToWorld, WorldToObject;
	vec2 Cone;         // RayCone of the ray
	float UVArea;      // FetchUVArea; not read if Cone is 0
};

// Inputs: object space. Material: its Emissive is what is asked for.
FMaterialHit MakeHitSurface(FSceneConstants Scene, FSectionData Section, FMaterialData Material, FMaterialInputs Inputs, FHitPlace Place)
{
	Inputs.Normal = (Inputs.Normal * Place.WorldToObject).xyz;
	mat3 ObjectToWorld = mat3(Place.ObjectToWorld);
	Inputs.Tangent.xyz = ObjectToWorld * Inputs.Tangent.xyz;
	float Volume = determinant(ObjectToWorld);
	if (Volume < 0.0) { Inputs.Tangent.w = -Inputs.Tangent.w; } // the normal keeps the object's outside
	// The inverse transpose keeps the object's own outside, also where the transform mirrors.
	vec3 Area = (Place.ObjectNormal * Place.WorldToObject).xyz;
	if (Place.Cone != vec2(0.0))
	{
		Inputs.Footprint = GetConeFootprint(Place.Cone, Place.Distance, Area * Volume, Place.UVArea, Place.Direction);
	}
	FMaterialSurface Surface = EvaluateMaterial(Material, Inputs, Scene.MaterialOverride);

	vec3 Ng = normalize(Area);
	bool bFront = dot(Ng, Place.Direction) < 0.0;
	bool bCulledSide = !bFront && (Section.Flags & SECTION_DOUBLE_SIDED) == 0u;
#ifdef HAS_TRANSMISSION
	bool bTransmissive = Material.Transmission > 0.0 && (Material.Metallic < 1.0 || HasTexture(Material, TEXTURE_METALLIC_ROUGHNESS));
	bool bSolid = bTransmissive && (Material.Flags & MATERIAL_SOLID) != 0u, bBlended = (Material.Flags & MATERIAL_BLENDED) != 0u;
	bCulledSide = bCulledSide && !bSolid; // a camera in a solid sees its surface
#endif
	if (!bFront)
	{
		Ng = -Ng;
		Surface.Normal = -Surface.Normal;
	}

	FMaterialHit Hit;
	Hit.Distance = Place.Distance;
	Hit.Normal = Surface.Normal;
	Hit.GeometricNormal = Ng;
	Hit.BaseColor = Surface.BaseColor;
	Hit.Roughness = Surface.Roughness;
	Hit.Metallic = Surface.Metallic;
	Hit.F0 = Surface.F0;
	Hit.Specular = Surface.Specular;
	Hit.Emissive = bCulledSide ? vec3(0.0) : Surface.Emissive;
	Hit.EmissiveWeight = (Section.Flags & SECTION_LIGHT) != 0u ? Material.EmissiveWeight : 0.0;
	uint ObjectFlags = FObjectRef(Scene.Objects).Data[Place.Object].Flags;
	Hit.Flags = (bCulledSide ? HIT_CULLED_SIDE : 0u) | ((ObjectFlags & OBJECT_CHARACTER) != 0u ? HIT_CHARACTER : 0u);
	Hit.Channels = LoadObjectChannels(Scene, Place.Object);
	Hit.Object = Place.Object;
#ifdef HAS_TRANSMISSION
	Hit.Transmission = bBlended ? 1.0 - clamp(Surface.Opacity, 0.0, 1.0) : bTransmissive ? Surface.Transmission : 0.0;
	Hit.Flags |= (bTransmissive || bBlended ? HIT_TRANSMISSIVE : 0u) | (bBlended ? HIT_BLENDED : 0u);
	if (bBlended) { Hit.Emissive *= 1.0 - Hit.Transmission; }
	Hit.Material = Section.Material;
	Hit.Flags |= bSolid ? (bFront ? HIT_SOLID : HIT_SOLID | HIT_INSIDE) : 0u;
#endif
#ifdef HAS_DIFFUSE_TRANSMISSION
	vec4 Back = BackOf(Material, Surface);
	Hit.BackAlbedo = Back.rgb;
	Hit.DiffuseTransmission = Back.a;
#endif
	const uint Foliage = SECTION_MASKED | SECTION_DOUBLE_SIDED;
	if ((Section.Flags & Foliage) == Foliage) { Hit.Flags |= HIT_FOLIAGE; }
	return Hit;
}

#endif
