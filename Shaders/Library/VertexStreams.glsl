// Reads vertices that lie in a host's own buffers, in any of the formats of FVertexStream.
#ifndef LANTERN_VERTEX_STREAMS_GLSL
#define LANTERN_VERTEX_STREAMS_GLSL

#include "Bindings.glsl"
#include "Math.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer FStreamsRef { FVertexStreams Data; };

vec4 UnpackUnorm10x3(uint Word)
{
	uvec4 Fields = uvec4(Word, Word >> 10, Word >> 20, Word >> 30) & uvec4(1023u, 1023u, 1023u, 3u);
	return vec4(Fields) / vec4(1023.0, 1023.0, 1023.0, 3.0);
}

vec4 UnpackSnorm10x3(uint Word)
{
	ivec4 Fields = ivec4(int(Word) << 22, int(Word) << 12, int(Word) << 2, int(Word)) >> ivec4(22, 22, 22, 30);
	return max(vec4(Fields) / vec4(511.0, 511.0, 511.0, 1.0), vec4(-1.0));
}

// Components that the format lacks are 0, and w is 1. Stream must be there.
vec4 LoadStream(FVertexStream Stream, uint Vertex)
{
	FIndexRef Words = FIndexRef(Stream.Address + uint64_t(Vertex) * Stream.Stride);
	uint W0 = Words.Data[0];
	switch (Stream.Format)
	{
	case VERTEX_FLOAT2: return vec4(uintBitsToFloat(uvec2(W0, Words.Data[1])), 0.0, 1.0);
	case VERTEX_FLOAT3: return vec4(uintBitsToFloat(uvec3(W0, Words.Data[1], Words.Data[2])), 1.0);
	case VERTEX_FLOAT4: return uintBitsToFloat(uvec4(W0, Words.Data[1], Words.Data[2], Words.Data[3]));
	case VERTEX_HALF2: return vec4(unpackHalf2x16(W0), 0.0, 1.0);
	case VERTEX_HALF4: return vec4(unpackHalf2x16(W0), unpackHalf2x16(Words.Data[1]));
	case VERTEX_UNORM16X2: return vec4(unpackUnorm2x16(W0), 0.0, 1.0);
	case VERTEX_SNORM16X2: return vec4(unpackSnorm2x16(W0), 0.0, 1.0);
	case VERTEX_SNORM16X4: return vec4(unpackSnorm2x16(W0), unpackSnorm2x16(Words.Data[1]));
	case VERTEX_UNORM8X4: return unpackUnorm4x8(W0);
	case VERTEX_SNORM8X4: return unpackSnorm4x8(W0);
	case VERTEX_BGRA8: return unpackUnorm4x8(W0).zyxw;
	case VERTEX_UNORM10X3: return UnpackUnorm10x3(W0);
	case VERTEX_SNORM10X3: return UnpackSnorm10x3(W0);
	// As FVertexAttributes has tangents: the lowest bit of y is the sign.
	case VERTEX_OCTAHEDRAL16: return vec4(UnpackOct(W0), (W0 & 0x10000u) != 0u ? -1.0 : 1.0);
	}
	return vec4(0.0);
}

// Default: where there is no stream.
vec4 LoadStream(FVertexStream Stream, uint Vertex, vec4 Default)
{
	if (Stream.Address == 0ul) { return Default; }
	return LoadStream(Stream, Vertex);
}

// Formats of 0 to 1 stand for −1 to 1. Zero where there is no stream.
vec4 LoadDirection(FVertexStream Stream, uint Vertex)
{
	vec4 Direction = LoadStream(Stream, Vertex, vec4(0.0));
	bool bUnsigned = Stream.Format == VERTEX_UNORM8X4 || Stream.Format == VERTEX_UNORM10X3;
	return bUnsigned ? 2.0 * Direction - 1.0 : Direction;
}

vec4 InterpolateStream(FVertexStream Stream, uvec3 Triangle, vec3 Weights, vec4 Default)
{
	if (Stream.Address == 0ul) { return Default; }
	return Weights.x * LoadStream(Stream, Triangle.x) + Weights.y * LoadStream(Stream, Triangle.y) + Weights.z * LoadStream(Stream, Triangle.z);
}

#endif
