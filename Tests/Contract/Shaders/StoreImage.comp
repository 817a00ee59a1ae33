// Image A, C × D: red is x, green is y.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "Common.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
void main()
{
	const uvec2 At = gl_GlobalInvocationID.xy;
	if (At.x < C && At.y < D) { imageStore(Images[A], ivec2(At), vec4(At, 0.25, 1.0)); }
}
