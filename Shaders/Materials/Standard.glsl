// The glTF 2.0 metallic-roughness material, which other material programs may build on. EvaluateMaterial (Material.glsl) alone
// defines the material of a surface: the raster G-buffer, the hit groups and the alpha test all call it.
//
// MATERIAL_IMPLICIT_LOD: textures are sampled with the level of detail of screen-space derivatives (fragment shaders).
// Otherwise they are sampled at the level of FMaterialInputs::Footprint.
#ifndef LANTERN_STANDARD_MATERIAL_GLSL
#define LANTERN_STANDARD_MATERIAL_GLSL

#include "../Library/VertexFetch.glsl"

struct FMaterialSurface
{
	vec3 BaseColor;
	float Opacity;
	vec3 Emissive; // nits
	float Metallic;
	vec3 Normal;     // unit length
	float Roughness; // perceptual
	float Occlusion; // 1: unoccluded
	float F0;        // reflectance of the dielectric at normal incidence
	float Specular;  // weight of the dielectric layer
	float Transmission; // share of what the layer lets in that shines through. Counts only where FMaterialData::Transmission is not 0
	// What leaves the surface on its other side of the diffuse layer's light. Counts only where FMaterialData::DiffuseTransmission is not 0.
	float DiffuseTransmission;     // share
	vec3 DiffuseTransmissionColor; // factor of what leaves there, as BaseColor is of the rest
};

// Blended surfaces of at least this opacity are solid: the raster shows them. What shows less is a layer before it.
const float LeastSolidOpacity = 1.0 - 0.5 / 255.0;

#ifdef MATERIAL_IMPLICIT_LOD
#define SampleMaterialTexture(Slot, UV, Level)                                                                         \
	texture(sampler2D(Textures[nonuniformEXT(SLOT_TEXTURE(Slot))], Samplers[nonuniformEXT(SLOT_SAMPLER(Slot))]), UV)
#else
#define SampleMaterialTexture(Slot, UV, Level)                                                                         \
	textureLod(sampler2D(Textures[nonuniformEXT(SLOT_TEXTURE(Slot))], Samplers[nonuniformEXT(SLOT_SAMPLER(Slot))]), UV, Level)
#endif

// Slot: TEXTURE_….
vec2 TransformUV(FMaterialData Material, vec2 UV, uint Slot)
{
	vec4 T = Material.UVTransform[Slot];
	return vec2(dot(T.xy, UV), dot(T.zw, UV)) + Material.UVOffset[Slot];
}

vec2 MaterialUV(FMaterialData Material, FMaterialInputs Inputs, uint Slot)
{
	return TransformUV(Material, (Material.UVSets & (1u << Slot)) != 0u ? Inputs.UV1 : Inputs.UV0, Slot);
}

// Nothing tells how large the second set of texture coordinates is.
float TextureLevel(FMaterialData Material, FMaterialInputs Inputs, uint Slot)
{
	if (Inputs.Footprint <= 0.0 || (Material.UVSets & (1u << Slot)) != 0u) { return 0.0; }
	vec4 T = Material.UVTransform[Slot];
	vec2 Size = vec2(textureSize(Textures[nonuniformEXT(SLOT_TEXTURE(Material.Textures[Slot]))], 0));
	float Scale = Size.x * Size.y * abs(T.x * T.w - T.y * T.z);
	return max(log2(Inputs.Footprint) + 0.5 * log2(max(Scale, 1.0e-20)), 0.0);
}

vec4 MaterialTexture(FMaterialData Material, FMaterialInputs Inputs, uint Slot)
{
	return SampleMaterialTexture(Material.Textures[Slot], MaterialUV(Material, Inputs, Slot), TextureLevel(Material, Inputs, Slot));
}

bool HasTexture(FMaterialData Material, uint Slot) { return Material.Textures[Slot] != NO_TEXTURE; }

vec4 EvaluateBaseColor(FMaterialData Material, FMaterialInputs Inputs)
{
	vec4 Color = Material.BaseColor * Inputs.Color;
	if (HasTexture(Material, TEXTURE_BASE_COLOR)) { Color *= MaterialTexture(Material, Inputs, TEXTURE_BASE_COLOR); }
	return Color;
}

float EvaluateOpacity(FMaterialData Material, FMaterialInputs Inputs) { return EvaluateBaseColor(Material, Inputs).a; }

// Returns whether the alpha test discards the surface: its opacity is below the cutoff (glTF 2.0).
bool IsCutAway(FMaterialData Material, FMaterialInputs Inputs)
{
	return (Material.Flags & MATERIAL_MASKED) != 0u && EvaluateOpacity(Material, Inputs) < Material.AlphaCutoff;
}

// Tests a hit on a masked section as IsCutAway does, but loads only what the test needs.
bool IsStandardHitCutAway(FMaterialRef Materials, FSectionData Section, uint Primitive, vec2 Barycentrics)
{
	FMaterialData Material = Materials.Data[Section.Material];
	uvec3 Triangle = FetchTriangle(Section, Primitive);
	vec2 UV = FetchOpacityUV(Section, Triangle, Barycentrics);
	float Opacity = Material.BaseColor.a;
#ifndef PLAIN_OPACITY
	if ((Section.Flags & SECTION_PLAIN_OPACITY) == 0u)
	{
		UV = TransformUV(Material, UV, TEXTURE_BASE_COLOR);
		Opacity *= FetchVertexAlpha(Section, Triangle, Barycentrics);
	}
#endif
	if (HasTexture(Material, TEXTURE_BASE_COLOR)) { Opacity *= SampleMaterialTexture(Material.Textures[TEXTURE_BASE_COLOR], UV, 0.0).a; }
	return Opacity < Material.AlphaCutoff;
}

vec3 EvaluateEmission(FMaterialData Material, FMaterialInputs Inputs)
{
	vec3 Emission = Material.Emissive;
	if (MaxComponent(Emission) > 0.0 && HasTexture(Material, TEXTURE_EMISSIVE))
	{
		Emission *= MaterialTexture(Material, Inputs, TEXTURE_EMISSIVE).rgb;
	}
	return Emission;
}

// HAS_LIGHT_EMISSION: some material of the scene lights otherwise than it looks.
vec3 EvaluateLightEmission(FMaterialData Material, FMaterialInputs Inputs)
{
#ifdef HAS_LIGHT_EMISSION
	Material.Emissive = Material.LightEmissive;
#endif
	return EvaluateEmission(Material, Inputs);
}

vec3 EvaluateNormal(FMaterialData Material, FMaterialInputs Inputs)
{
	vec3 N = NormalizeOr(Inputs.Normal, vec3(0.0, 0.0, 1.0));
	if (!HasTexture(Material, TEXTURE_NORMAL) || Inputs.Tangent.w == 0.0) { return N; }
	vec3 T = Inputs.Tangent.xyz - N * dot(Inputs.Tangent.xyz, N);
	float LengthSquared = dot(T, T);
	if (LengthSquared < 1.0e-12) { return N; }
	T *= inversesqrt(LengthSquared);
	vec3 Map = MaterialTexture(Material, Inputs, TEXTURE_NORMAL).xyz * 2.0 - 1.0;
	Map.xy *= Material.NormalScale;
	return NormalizeOr(T * Map.x + cross(N, T) * (Inputs.Tangent.w * Map.y) + N * Map.z, N);
}

float EvaluateTransmission(FMaterialData Material, FMaterialInputs Inputs)
{
	bool bTextured = Material.Transmission > 0.0 && HasTexture(Material, TEXTURE_TRANSMISSION);
	return bTextured ? Material.Transmission * MaterialTexture(Material, Inputs, TEXTURE_TRANSMISSION).r : Material.Transmission;
}

void EvaluateDiffuseTransmission(FMaterialData Material, FMaterialInputs Inputs, inout FMaterialSurface Surface)
{
	Surface.DiffuseTransmission = Material.DiffuseTransmission;
	Surface.DiffuseTransmissionColor = Material.DiffuseTransmissionColor;
	if (Material.DiffuseTransmission <= 0.0) { return; }
	if (HasTexture(Material, TEXTURE_DIFFUSE_TRANSMISSION))
	{
		Surface.DiffuseTransmission *= MaterialTexture(Material, Inputs, TEXTURE_DIFFUSE_TRANSMISSION).a;
	}
	if (HasTexture(Material, TEXTURE_DIFFUSE_TRANSMISSION_COLOR))
	{
		Surface.DiffuseTransmissionColor *= MaterialTexture(Material, Inputs, TEXTURE_DIFFUSE_TRANSMISSION_COLOR).rgb;
	}
}

// Returns the albedo of the other side (FBrdf::BackAlbedo), and in a the share that the front's base loses to it.
vec4 BackOf(FMaterialData Material, FMaterialSurface Surface)
{
	if (Material.DiffuseTransmission <= 0.0) { return vec4(0.0); }
	float Share = clamp(Surface.DiffuseTransmission, 0.0, 1.0);
	return Share > 0.0 ? vec4(Surface.DiffuseTransmissionColor * (Share * (1.0 - Surface.Metallic)), Share) : vec4(0.0);
}

// Override: value of r.RT.Material.Override; 0: none.
FMaterialSurface EvaluateStandard(FMaterialData Material, FMaterialInputs Inputs, uint Override)
{
	FMaterialSurface Surface;
	vec4 Color = EvaluateBaseColor(Material, Inputs);
	Surface.BaseColor = Color.rgb;
	Surface.Opacity = Color.a;
	Surface.Emissive = EvaluateEmission(Material, Inputs);
	Surface.Occlusion = 1.0;
	if (Override != 0u)
	{
		Surface.BaseColor = Override == 1u ? Color.rgb : vec3(0.5);
		Surface.Metallic = 0.0;
		Surface.Roughness = 1.0;
		Surface.F0 = 0.0;
		Surface.Specular = 0.0;
		Surface.Transmission = Surface.DiffuseTransmission = 0.0;
		Surface.DiffuseTransmissionColor = vec3(0.0);
		Surface.Normal = NormalizeOr(Inputs.Normal, vec3(0.0, 0.0, 1.0));
		return Surface;
	}
	Surface.Metallic = Material.Metallic;
	Surface.Roughness = Material.Roughness;
	if (HasTexture(Material, TEXTURE_METALLIC_ROUGHNESS))
	{
		vec2 RoughnessMetallic = MaterialTexture(Material, Inputs, TEXTURE_METALLIC_ROUGHNESS).gb;
		Surface.Roughness *= RoughnessMetallic.x;
		Surface.Metallic *= RoughnessMetallic.y;
	}
	if (HasTexture(Material, TEXTURE_OCCLUSION))
	{
		Surface.Occlusion = mix(1.0, MaterialTexture(Material, Inputs, TEXTURE_OCCLUSION).r, Material.OcclusionStrength);
	}
	float Ratio = (Material.Ior - 1.0) / (Material.Ior + 1.0);
	Surface.F0 = Ratio * Ratio;
	Surface.Specular = Material.Specular;
	Surface.Transmission = EvaluateTransmission(Material, Inputs);
	EvaluateDiffuseTransmission(Material, Inputs, Surface);
	Surface.Normal = EvaluateNormal(Material, Inputs);
	return Surface;
}

#endif
