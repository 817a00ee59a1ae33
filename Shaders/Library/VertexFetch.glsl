// From a section and a triangle to interpolated attributes: once, for hit shaders, ray queries and raster.
#ifndef LANTERN_VERTEX_FETCH_GLSL
#define LANTERN_VERTEX_FETCH_GLSL

#include "Bindings.glsl"
#include "Math.glsl"

// What EvaluateMaterial gets. World space, relative to the scene's origin.
struct FMaterialInputs
{
	vec3 Normal;  // interpolated, towards the front face
	vec4 Tangent; // w: sign of the bitangent; 0: the vertices have none
	vec2 UV0, UV1;
	vec4 Color;
};

// Without a branch on the width: any-hit shaders wait for as little as possible before these loads.
uvec3 FetchTriangle(FSectionData Section, uint Primitive)
{
	uint Half = Section.Flags & SECTION_INDEX_16; // 1: two indices in a word
	uvec3 Index = 3 * Primitive + ((Section.Flags & SECTION_INDEX_ODD) != 0u ? 1u : 0u) + uvec3(0, 1, 2);
	FIndexRef Words = FIndexRef(Section.Indices);
	uvec3 Word = uvec3(Words.Data[Index.x >> Half], Words.Data[Index.y >> Half], Words.Data[Index.z >> Half]);
	return Half == 0u ? Word : (Word >> ((Index & 1u) * 16u)) & 0xffffu;
}

FMaterialInputs InputsFromVertex(FVertexAttributes V, uint SectionFlags)
{
	FMaterialInputs I;
	I.Normal = UnpackOct(V.Normal);
	I.Tangent = vec4(0.0);
	if ((SectionFlags & SECTION_TANGENTS) != 0u)
	{
		I.Tangent = vec4(UnpackOct(V.Tangent), (V.Tangent & 0x10000u) != 0u ? -1.0 : 1.0);
	}
	I.UV0 = V.UV0;
	I.UV1 = V.UV1;
	I.Color = unpackUnorm4x8(V.Color);
	return I;
}

// Only what the alpha test needs.
FMaterialInputs FetchCoverageInputs(FSectionData Section, uint Primitive, vec2 Barycentrics)
{
	uvec3 T = FetchTriangle(Section, Primitive);
	FAttributeRef A = FAttributeRef(Section.Attributes);
	vec3 W = vec3(1.0 - Barycentrics.x - Barycentrics.y, Barycentrics);
	FMaterialInputs I;
	I.Normal = vec3(0.0);
	I.Tangent = vec4(0.0);
	I.UV0 = W.x * A.Data[T.x].UV0 + W.y * A.Data[T.y].UV0 + W.z * A.Data[T.z].UV0;
	I.UV1 = W.x * A.Data[T.x].UV1 + W.y * A.Data[T.y].UV1 + W.z * A.Data[T.z].UV1;
	I.Color = W.x * unpackUnorm4x8(A.Data[T.x].Color) + W.y * unpackUnorm4x8(A.Data[T.y].Color) + W.z * unpackUnorm4x8(A.Data[T.z].Color);
	return I;
}

struct FVertexUV
{
	vec2 UV;
	uint Pad[5];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FVertexUVRef { FVertexUV Data[]; };

// What opacity needs, of the one set of coordinates that it uses. Any-hit shaders and ray queries run on all that a
// ray meets, where each word of a vertex is a load of its own; the section's flags come with its record, so that
// nothing here waits for the material.
vec2 FetchOpacityUV(FSectionData Section, uvec3 Triangle, vec2 Barycentrics)
{
	uint Offset = (Section.Flags & SECTION_OPACITY_UV1) != 0u ? 16u : 8u; // of FVertexAttributes::UV1, UV0
	FVertexUVRef V = FVertexUVRef(Section.Attributes + Offset);
	return (1.0 - Barycentrics.x - Barycentrics.y) * V.Data[Triangle.x].UV + Barycentrics.x * V.Data[Triangle.y].UV +
	       Barycentrics.y * V.Data[Triangle.z].UV;
}

float FetchVertexAlpha(FSectionData Section, uvec3 Triangle, vec2 Barycentrics)
{
	FAttributeRef A = FAttributeRef(Section.Attributes);
	vec3 Alpha = vec3(A.Data[Triangle.x].Color >> 24u, A.Data[Triangle.y].Color >> 24u, A.Data[Triangle.z].Color >> 24u);
	return dot(vec3(1.0 - Barycentrics.x - Barycentrics.y, Barycentrics), Alpha) * (1.0 / 255.0);
}

// All of it, still in object space.
FMaterialInputs FetchInputs(FSectionData Section, uint Primitive, vec2 Barycentrics)
{
	uvec3 T = FetchTriangle(Section, Primitive);
	FAttributeRef A = FAttributeRef(Section.Attributes);
	FMaterialInputs I0 = InputsFromVertex(A.Data[T.x], Section.Flags);
	FMaterialInputs I1 = InputsFromVertex(A.Data[T.y], Section.Flags);
	FMaterialInputs I2 = InputsFromVertex(A.Data[T.z], Section.Flags);
	vec3 W = vec3(1.0 - Barycentrics.x - Barycentrics.y, Barycentrics);
	FMaterialInputs I;
	I.Normal = W.x * I0.Normal + W.y * I1.Normal + W.z * I2.Normal;
	I.Tangent = vec4(W.x * I0.Tangent.xyz + W.y * I1.Tangent.xyz + W.z * I2.Tangent.xyz, I0.Tangent.w);
	I.UV0 = W.x * I0.UV0 + W.y * I1.UV0 + W.z * I2.UV0;
	I.UV1 = W.x * I0.UV1 + W.y * I1.UV1 + W.z * I2.UV1;
	I.Color = W.x * I0.Color + W.y * I1.Color + W.z * I2.Color;
	return I;
}

void FetchPositions(FSectionData Section, uint Primitive, out vec3 P0, out vec3 P1, out vec3 P2)
{
	uvec3 T = FetchTriangle(Section, Primitive);
	FPositionRef P = FPositionRef(Section.Positions);
	P0 = P.Data[T.x];
	P1 = P.Data[T.y];
	P2 = P.Data[T.z];
}

// Where a ray, in the object's space, meets a triangle: distance and barycentrics (Möller and Trumbore 1997).
vec3 IntersectTriangle(FSectionData Section, uint Primitive, vec3 Origin, vec3 Direction)
{
	vec3 P0, P1, P2;
	FetchPositions(Section, Primitive, P0, P1, P2);
	vec3 E1 = P1 - P0, E2 = P2 - P0, S = Origin - P0;
	vec3 H = cross(Direction, E2), Q = cross(S, E1);
	return vec3(dot(E2, Q), dot(S, H), dot(Direction, Q)) / dot(E1, H);
}

// Of what IntersectTriangle returned at a hit: whether only the piece reaches there.
bool IsBesideTriangle(FSectionData Section, vec3 Where)
{
	bool bBeside = Where.y < 0.0 || Where.z < 0.0 || Where.y + Where.z > 1.0;
	return bBeside && (Section.Flags & SECTION_IS_PIECES) != 0u;
}

#endif
