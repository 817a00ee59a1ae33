// Fetches vertices: from a section and a triangle to interpolated attributes. Hit shaders, ray queries and the raster share it.
#ifndef LANTERN_VERTEX_FETCH_GLSL
#define LANTERN_VERTEX_FETCH_GLSL

#include "Bindings.glsl"
#include "Math.glsl"
#include "VertexStreams.glsl"

// Input of EvaluateMaterial, in world space relative to the scene's origin.
struct FMaterialInputs
{
	vec3 Normal;  // interpolated, towards the front face
	vec4 Tangent; // w: sign of the bitangent; 0: the vertices have no tangents
	vec2 UV0, UV1;
	vec4 Color;
	float Footprint; // of a ray: width of what a texture averages, in texture coordinates UV0; 0: its finest level
};

// Returns the three vertex indices of a triangle. There is no branch on the index width, so that any-hit shaders can issue
// these loads early.
uvec3 FetchTriangle(FSectionData Section, uint Primitive)
{
	uint WordShift = Section.Flags & SECTION_INDEX_16; // the flag's bit is 1: two indices a word
	uvec3 Index = 3 * Primitive + ((Section.Flags & SECTION_INDEX_ODD) != 0u ? 1u : 0u) + uvec3(0, 1, 2);
	FIndexRef Words = FIndexRef(Section.Indices);
	uvec3 Word = uvec3(Words.Data[Index.x >> WordShift], Words.Data[Index.y >> WordShift], Words.Data[Index.z >> WordShift]);
	return WordShift == 0u ? Word : (Word >> ((Index & 1u) * 16u)) & 0xffffu;
}

// Object space.
FMaterialInputs UnpackVertex(FVertexAttributes V, uint SectionFlags)
{
	FMaterialInputs Inputs;
	Inputs.Normal = UnpackOct(V.Normal);
	Inputs.Tangent = vec4(0.0);
	if ((SectionFlags & SECTION_TANGENTS) != 0u)
	{
		Inputs.Tangent = vec4(UnpackOct(V.Tangent), (V.Tangent & 0x10000u) != 0u ? -1.0 : 1.0);
	}
	Inputs.UV0 = V.UV0;
	Inputs.UV1 = V.UV1;
	Inputs.Color = unpackUnorm4x8(V.Color);
	Inputs.Footprint = 0.0;
	return Inputs;
}

// Object space.
FMaterialInputs LoadVertex(FSectionData Section, uint Vertex)
{
	return UnpackVertex(FAttributeRef(Section.Attributes).Data[Vertex], Section.Flags);
}

// Interpolates only what textures need: coordinates and colour. Normal and Tangent are zero.
FMaterialInputs FetchTextureInputs(FSectionData Section, uint Primitive, vec2 Barycentrics)
{
	uvec3 Triangle = FetchTriangle(Section, Primitive);
	vec3 Weights = vec3(1.0 - Barycentrics.x - Barycentrics.y, Barycentrics);
	FMaterialInputs Inputs;
	Inputs.Normal = vec3(0.0);
	Inputs.Tangent = vec4(0.0);
	Inputs.Footprint = 0.0;
	if ((Section.Flags & SECTION_STREAMS) != 0u)
	{
		vec4 Values[STREAM_COLORS + 1u];
		InterpolateStreams(Section, STREAM_UV0, Triangle, Weights, Values);
		Inputs.UV0 = Values[STREAM_UV0].xy;
		Inputs.UV1 = Values[STREAM_UV1].xy;
		Inputs.Color = Values[STREAM_COLORS];
		return Inputs;
	}
	FAttributeRef Vertices = FAttributeRef(Section.Attributes);
	Inputs.UV0 = Weights.x * Vertices.Data[Triangle.x].UV0 + Weights.y * Vertices.Data[Triangle.y].UV0 +
	             Weights.z * Vertices.Data[Triangle.z].UV0;
	Inputs.UV1 = Weights.x * Vertices.Data[Triangle.x].UV1 + Weights.y * Vertices.Data[Triangle.y].UV1 +
	             Weights.z * Vertices.Data[Triangle.z].UV1;
	Inputs.Color = Weights.x * unpackUnorm4x8(Vertices.Data[Triangle.x].Color) + Weights.y * unpackUnorm4x8(Vertices.Data[Triangle.y].Color) +
	               Weights.z * unpackUnorm4x8(Vertices.Data[Triangle.z].Color);
	return Inputs;
}

// FVertexAttributes seen from one of its sets of texture coordinates on: a stride of 28 bytes.
struct FVertexUV
{
	vec2 UV;
	uint Pad[5];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FVertexUVRef { FVertexUV Data[]; };

// Interpolates the one set of texture coordinates that opacity uses. Alpha tests run on every candidate hit of a ray, and
// each word of a vertex is a separate load there. The section's flags come with its hit record, so that these loads do not
// wait for the material.
vec2 FetchOpacityUV(FSectionData Section, uvec3 Triangle, vec2 Barycentrics)
{
	bool bUV1 = (Section.Flags & SECTION_OPACITY_UV1) != 0u;
	vec3 Weights = vec3(1.0 - Barycentrics.x - Barycentrics.y, Barycentrics);
#ifndef PLAIN_OPACITY
	if ((Section.Flags & SECTION_STREAMS) != 0u)
	{
		return InterpolateStream(Section, bUV1 ? STREAM_UV1 : STREAM_UV0, Triangle, Weights, vec4(0.0)).xy;
	}
#endif
	FVertexUVRef V = FVertexUVRef(Section.Attributes + (bUV1 ? 16u : 8u)); // bytes to FVertexAttributes::UV1 or UV0
	return Weights.x * V.Data[Triangle.x].UV + Barycentrics.x * V.Data[Triangle.y].UV + Barycentrics.y * V.Data[Triangle.z].UV;
}

float FetchVertexAlpha(FSectionData Section, uvec3 Triangle, vec2 Barycentrics)
{
	vec3 Weights = vec3(1.0 - Barycentrics.x - Barycentrics.y, Barycentrics);
	if ((Section.Flags & SECTION_STREAMS) != 0u)
	{
		return InterpolateStream(Section, STREAM_COLORS, Triangle, Weights, vec4(1.0)).a;
	}
	FAttributeRef Vertices = FAttributeRef(Section.Attributes);
	vec3 Alpha = vec3(Vertices.Data[Triangle.x].Color >> 24u, Vertices.Data[Triangle.y].Color >> 24u, Vertices.Data[Triangle.z].Color >> 24u);
	return dot(Weights, Alpha) * (1.0 / 255.0);
}

void FetchPositions(FSectionData Section, uint Primitive, out vec3 P0, out vec3 P1, out vec3 P2)
{
	uvec3 Triangle = FetchTriangle(Section, Primitive);
	if ((Section.Flags & SECTION_STREAMS) != 0u)
	{
		FVertexStream Stream = FStreamArrayRef(Section.Attributes).Data[STREAM_POSITIONS];
		vec3 Corners[3];
		[[dont_unroll]] for (uint Corner = 0u; Corner < 3u; ++Corner) { Corners[Corner] = LoadStream(Stream, Triangle[Corner]).xyz; }
		P0 = Corners[0];
		P1 = Corners[1];
		P2 = Corners[2];
		return;
	}
	FPositionRef Positions = FPositionRef(Section.Positions);
	P0 = Positions.Data[Triangle.x];
	P1 = Positions.Data[Triangle.y];
	P2 = Positions.Data[Triangle.z];
}

vec3 FetchTriangleNormal(FSectionData Section, uint Primitive)
{
	vec3 P0, P1, P2;
	FetchPositions(Section, Primitive, P0, P1, P2);
	return cross(P1 - P0, P2 - P0);
}

// TriangleNormal: of any length, for a host that has no normals.
FMaterialInputs FetchStreamInputs(FSectionData Section, uvec3 Triangle, vec3 Weights, vec3 TriangleNormal)
{
	vec4 Values[STREAM_COLORS + 1u];
	InterpolateStreams(Section, STREAM_NORMALS, Triangle, Weights, Values);
	FVertexStreams Streams = FStreamsRef(Section.Attributes).Data;
	vec4 Normal = DecodeDirection(Streams.Normals, Values[STREAM_NORMALS]), Tangent = DecodeDirection(Streams.Tangents, Values[STREAM_TANGENTS]);
	float Sign = (Streams.Flags & STREAMS_SIGN_IN_NORMAL) != 0u ? Normal.w : Tangent.w;
	FMaterialInputs Inputs;
	Inputs.Normal = Streams.Normals.Address != 0ul ? Normal.xyz : TriangleNormal;
	Inputs.Tangent = vec4(Tangent.xyz, Streams.Tangents.Address == 0ul ? 0.0 : (Sign < 0.0 ? -1.0 : 1.0));
	Inputs.UV0 = Values[STREAM_UV0].xy;
	Inputs.UV1 = Values[STREAM_UV1].xy;
	Inputs.Color = Values[STREAM_COLORS];
	Inputs.Footprint = 0.0;
	return Inputs;
}

// Interpolates all attributes, in object space. TriangleNormal: of any length.
FMaterialInputs FetchMaterialInputs(FSectionData Section, uint Primitive, vec2 Barycentrics, vec3 TriangleNormal)
{
	uvec3 Triangle = FetchTriangle(Section, Primitive);
	vec3 Weights = vec3(1.0 - Barycentrics.x - Barycentrics.y, Barycentrics);
	if ((Section.Flags & SECTION_STREAMS) != 0u) { return FetchStreamInputs(Section, Triangle, Weights, TriangleNormal); }
	FMaterialInputs Inputs0 = LoadVertex(Section, Triangle.x);
	FMaterialInputs Inputs1 = LoadVertex(Section, Triangle.y);
	FMaterialInputs Inputs2 = LoadVertex(Section, Triangle.z);
	FMaterialInputs Inputs;
	Inputs.Normal = Weights.x * Inputs0.Normal + Weights.y * Inputs1.Normal + Weights.z * Inputs2.Normal;
	Inputs.Tangent = vec4(Weights.x * Inputs0.Tangent.xyz + Weights.y * Inputs1.Tangent.xyz + Weights.z * Inputs2.Tangent.xyz,
	                      Inputs0.Tangent.w);
	Inputs.UV0 = Weights.x * Inputs0.UV0 + Weights.y * Inputs1.UV0 + Weights.z * Inputs2.UV0;
	Inputs.UV1 = Weights.x * Inputs0.UV1 + Weights.y * Inputs1.UV1 + Weights.z * Inputs2.UV1;
	Inputs.Color = Weights.x * Inputs0.Color + Weights.y * Inputs1.Color + Weights.z * Inputs2.Color;
	Inputs.Footprint = 0.0;
	return Inputs;
}

FMaterialInputs FetchMaterialInputs(FSectionData Section, uint Primitive, vec2 Barycentrics)
{
	vec3 TriangleNormal = vec3(0.0);
	if ((Section.Flags & SECTION_STREAMS) != 0u) { TriangleNormal = FetchTriangleNormal(Section, Primitive); }
	return FetchMaterialInputs(Section, Primitive, Barycentrics, TriangleNormal);
}

// Returns twice the area of a triangle in texture coordinates UV0.
float FetchUVArea(FSectionData Section, uint Primitive)
{
	uvec3 Triangle = FetchTriangle(Section, Primitive);
	vec2 UV[3];
	if ((Section.Flags & SECTION_STREAMS) != 0u)
	{
		[[dont_unroll]] for (uint Corner = 0u; Corner < 3u; ++Corner)
		{
			UV[Corner] = InterpolateStream(Section, STREAM_UV0, uvec3(Triangle[Corner]), vec3(1.0, 0.0, 0.0), vec4(0.0)).xy;
		}
	}
	else
	{
		FVertexUVRef V = FVertexUVRef(Section.Attributes + 8u); // bytes to FVertexAttributes::UV0
		for (uint Corner = 0u; Corner < 3u; ++Corner) { UV[Corner] = V.Data[Triangle[Corner]].UV; }
	}
	return abs(determinant(mat2(UV[1] - UV[0], UV[2] - UV[0])));
}

// Intersects a ray with the plane of a triangle, in object space (Möller and Trumbore 1997). The result's x is the
// distance along the ray, yz are the barycentrics of the second and third corner.
vec3 IntersectTriangle(vec3 P0, vec3 P1, vec3 P2, vec3 Origin, vec3 Direction)
{
	vec3 Edge1 = P1 - P0, Edge2 = P2 - P0, FromP0 = Origin - P0;
	vec3 H = cross(Direction, Edge2), Q = cross(FromP0, Edge1);
	return vec3(dot(Edge2, Q), dot(FromP0, H), dot(Direction, Q)) / dot(Edge1, H);
}

vec3 IntersectTriangle(FSectionData Section, uint Primitive, vec3 Origin, vec3 Direction)
{
	vec3 P0, P1, P2;
	FetchPositions(Section, Primitive, P0, P1, P2);
	return IntersectTriangle(P0, P1, P2, Origin, Direction);
}

// Returns whether a hit lies on a piece but outside of the whole triangle (see SECTION_IS_PIECES). TriangleHit: from
// IntersectTriangle.
bool IsOutsideTriangle(FSectionData Section, vec3 TriangleHit)
{
	bool bOutside = TriangleHit.y < 0.0 || TriangleHit.z < 0.0 || TriangleHit.y + TriangleHit.z > 1.0;
	return bOutside && (Section.Flags & SECTION_IS_PIECES) != 0u;
}

#endif
