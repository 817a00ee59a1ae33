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

// FVertexStreams by number.
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer FStreamArrayRef { FVertexStream Data[]; };

// Interpolates one attribute; Default: where the host has none. Formats of 0 to 1 are as they are, see DecodeDirection. Loops stay
// loops, because unrolled decoders made material shaders take five times as long to compile.
vec4 InterpolateStream(FSectionData Section, uint Stream, uvec3 Triangle, vec3 Weights, vec4 Default)
{
	FVertexStream Source = FStreamArrayRef(Section.Attributes).Data[Stream];
	if (Source.Address == 0ul) { return Default; }
	vec4 Sum = vec4(0.0);
	[[dont_unroll]] for (uint Corner = 0u; Corner < 3u; ++Corner) { Sum += Weights[Corner] * LoadStream(Source, Triangle[Corner]); }
	return Sum;
}

// Attributes First to STREAM_COLORS, each at its number.
void InterpolateStreams(FSectionData Section, uint First, uvec3 Triangle, vec3 Weights, inout vec4 Out[STREAM_COLORS + 1u])
{
	[[dont_unroll]] for (uint Stream = First; Stream <= STREAM_COLORS; ++Stream)
	{
		Out[Stream] = InterpolateStream(Section, Stream, Triangle, Weights, vec4(Stream == STREAM_COLORS ? 1.0 : 0.0));
	}
}

// Formats of 0 to 1 stand for −1 to 1. Zero where there is no stream.
vec4 DecodeDirection(FVertexStream Stream, vec4 Value)
{
	bool bUnsigned = Stream.Format == VERTEX_UNORM8X4 || Stream.Format == VERTEX_UNORM10X3;
	return bUnsigned && Stream.Address != 0ul ? 2.0 * Value - 1.0 : Value;
}

#endif
