// Output[i] = A + i · B
#version 460
#extension GL_GOOGLE_include_directive : require
#include "Common.glsl"
layout(local_size_x = 8) in;
void main()
{
	const uint i = gl_GlobalInvocationID.x;
	if (i < C) { Output.Item[i] = A + i * B; }
}
