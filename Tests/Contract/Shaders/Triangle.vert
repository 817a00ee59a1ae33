// Vertices (x, y, z, unused) from Input.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "Common.glsl"
void main()
{
	const uint i = gl_VertexIndex * 4;
	gl_Position = vec4(Input.Item[i], Input.Item[i + 1], Input.Item[i + 2], 1.0);
}
