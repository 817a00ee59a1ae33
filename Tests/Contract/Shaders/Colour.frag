// Red: A / 255.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "Common.glsl"
layout(location = 0) out vec4 Target;
void main() { Target = vec4(A / 255.0, 0, 0, 1); }
