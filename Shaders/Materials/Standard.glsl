// glTF 2.0 metallic-roughness, and what other material programs may build on. EvaluateMaterial (Material.glsl) is the one
// place that says what a surface is made of: the raster G-buffer, the hit groups and the alpha test all call it.
//
// The includer may define
//   MATERIAL_TEXTURE(Slot, UV)  how a texture is sampled (default: finest level, as rays do)
//   MATERIAL_COVERAGE_ONLY      only Opacity is wanted
#ifndef LANTERN_STANDARD_MATERIAL_GLSL
#define LANTERN_STANDARD_MATERIAL_GLSL

#include "../Library/VertexFetch.glsl"

struct FMaterialSurface
{
	vec3 BaseColor;
	float Opacity;
	vec3 Emissive; // nits
	float Metallic;
	vec3 Normal; // unit
	float Roughness; // perceptual
	float Occlusion;
	float F0; // of the dielectric
	float Specular;
};

#ifdef MATERIAL_IMPLICIT_LOD
#define SampleMaterialTexture(Slot, UV)                                                                                \
	texture(sampler2D(Textures[nonuniformEXT((Slot)&0xffffffu)], Samplers[nonuniformEXT((Slot) >> 24)]), UV)
#else
#define SampleMaterialTexture(Slot, UV)                                                                                \
	textureLod(sampler2D(Textures[nonuniformEXT((Slot)&0xffffffu)], Samplers[nonuniformEXT((Slot) >> 24)]), UV, 0.0)
#endif

vec2 TransformUV(FMaterialData M, vec2 UV, uint Slot)
{
	vec4 T = M.UVTransform[Slot];
	return vec2(dot(T.xy, UV), dot(T.zw, UV)) + M.UVOffset[Slot];
}

vec2 MaterialUV(FMaterialData M, FMaterialInputs I, uint Slot)
{
	return TransformUV(M, (M.UVSets & (1u << Slot)) != 0u ? I.UV1 : I.UV0, Slot);
}

vec4 MaterialTexture(FMaterialData M, FMaterialInputs I, uint Slot)
{
	return SampleMaterialTexture(M.Textures[Slot], MaterialUV(M, I, Slot));
}

bool HasTexture(FMaterialData M, uint Slot) { return M.Textures[Slot] != NO_TEXTURE; }

vec4 EvaluateBaseColor(FMaterialData M, FMaterialInputs I)
{
	vec4 Color = M.BaseColor * I.Color;
	if (HasTexture(M, TEXTURE_BASE_COLOR)) { Color *= MaterialTexture(M, I, TEXTURE_BASE_COLOR); }
	return Color;
}

float EvaluateOpacity(FMaterialData M, FMaterialInputs I) { return EvaluateBaseColor(M, I).a; }

// Cut away by the alpha test? glTF: an alpha below the cutoff is.
bool IsCutAway(FMaterialData M, FMaterialInputs I)
{
	return (M.Flags & MATERIAL_MASKED) != 0u && EvaluateOpacity(M, I) < M.AlphaCutoff;
}

// The same at a hit on a masked section, reading only what it needs.
bool IsStandardHitCutAway(FMaterialRef Materials, FSectionData Section, uint Primitive, vec2 Barycentrics)
{
	FMaterialData M = Materials.Data[Section.Material];
	uvec3 Triangle = FetchTriangle(Section, Primitive);
	vec2 UV = FetchOpacityUV(Section, Triangle, Barycentrics);
	float Opacity = M.BaseColor.a;
	if ((Section.Flags & SECTION_PLAIN_OPACITY) == 0u)
	{
		UV = TransformUV(M, UV, TEXTURE_BASE_COLOR);
		Opacity *= FetchVertexAlpha(Section, Triangle, Barycentrics);
	}
	if (HasTexture(M, TEXTURE_BASE_COLOR)) { Opacity *= SampleMaterialTexture(M.Textures[TEXTURE_BASE_COLOR], UV).a; }
	return Opacity < M.AlphaCutoff;
}

vec3 EvaluateEmission(FMaterialData M, FMaterialInputs I)
{
	vec3 E = M.Emissive;
	if (MaxComponent(E) > 0.0 && HasTexture(M, TEXTURE_EMISSIVE)) { E *= MaterialTexture(M, I, TEXTURE_EMISSIVE).rgb; }
	return E;
}

vec3 EvaluateNormal(FMaterialData M, FMaterialInputs I)
{
	vec3 N = NormalizeOr(I.Normal, vec3(0.0, 0.0, 1.0));
	if (!HasTexture(M, TEXTURE_NORMAL) || I.Tangent.w == 0.0) { return N; }
	vec3 T = I.Tangent.xyz - N * dot(I.Tangent.xyz, N);
	float Length2 = dot(T, T);
	if (Length2 < 1.0e-12) { return N; }
	T *= inversesqrt(Length2);
	vec3 Map = MaterialTexture(M, I, TEXTURE_NORMAL).xyz * 2.0 - 1.0;
	Map.xy *= M.NormalScale;
	return NormalizeOr(T * Map.x + cross(N, T) * (I.Tangent.w * Map.y) + N * Map.z, N);
}

// Override: r.RT.Material.Override.
FMaterialSurface EvaluateStandard(FMaterialData M, FMaterialInputs I, uint Override)
{
	FMaterialSurface S;
	vec4 Color = EvaluateBaseColor(M, I);
	S.BaseColor = Color.rgb;
	S.Opacity = Color.a;
	S.Emissive = EvaluateEmission(M, I);
	S.Occlusion = 1.0;
	if (Override != 0u)
	{
		S.BaseColor = Override == 1u ? Color.rgb : vec3(0.5);
		S.Metallic = 0.0;
		S.Roughness = 1.0;
		S.F0 = 0.0;
		S.Specular = 0.0;
		S.Normal = NormalizeOr(I.Normal, vec3(0.0, 0.0, 1.0));
		return S;
	}
	S.Metallic = M.Metallic;
	S.Roughness = M.Roughness;
	if (HasTexture(M, TEXTURE_METALLIC_ROUGHNESS))
	{
		vec2 RoughnessMetallic = MaterialTexture(M, I, TEXTURE_METALLIC_ROUGHNESS).gb;
		S.Roughness *= RoughnessMetallic.x;
		S.Metallic *= RoughnessMetallic.y;
	}
	if (HasTexture(M, TEXTURE_OCCLUSION))
	{
		S.Occlusion = mix(1.0, MaterialTexture(M, I, TEXTURE_OCCLUSION).r, M.OcclusionStrength);
	}
	float R = (M.Ior - 1.0) / (M.Ior + 1.0);
	S.F0 = R * R;
	S.Specular = M.Specular;
	S.Normal = EvaluateNormal(M, I);
	return S;
}

#endif
