// What the raw dispatch knows of alpha-tested sections: the corner's texture coordinates, one texture, one cutoff.
#ifndef LANTERN_RAW_SECTIONS_GLSL
#define LANTERN_RAW_SECTIONS_GLSL

#extension GL_EXT_buffer_reference2 : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_nonuniform_qualifier : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require

struct FRawSection
{
	uint64_t Indices;   // uint[]
	uint64_t Coverage;  // vec2 every 28 bytes
	uint Texture;
	float Cutoff; // of the texture's alpha
	uint Pad0, Pad1;
};

struct FRawVertex
{
	vec2 UV;
	float Pad[5];
};

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FRawIndices { uvec3 Data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FRawVertices { FRawVertex Data[]; };
layout(set = 0, binding = 4) uniform sampler2D Coverage[];

bool IsHole(FRawSection Section, uint Primitive, vec2 Barycentrics)
{
	uvec3 T = FRawIndices(Section.Indices).Data[Primitive];
	FRawVertices V = FRawVertices(Section.Coverage);
	vec2 UV = (1.0 - Barycentrics.x - Barycentrics.y) * V.Data[T.x].UV + Barycentrics.x * V.Data[T.y].UV + Barycentrics.y * V.Data[T.z].UV;
	return textureLod(Coverage[nonuniformEXT(Section.Texture)], UV, 0.0).a < Section.Cutoff;
}

#endif
