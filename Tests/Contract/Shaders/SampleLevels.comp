// Output[i]: red in the middle of mip i of texture A with sampler B, times 1000.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "Common.glsl"
layout(local_size_x = 8) in;
void main()
{
	const uint i = gl_GlobalInvocationID.x;
	if (i < C) { Output.Item[i] = uint(textureLod(sampler2D(Textures[A], Samplers[B]), vec2(0.5), i).r * 1000.0 + 0.5); }
}
