#version 460
#extension GL_EXT_ray_tracing : require
#extension GL_GOOGLE_include_directive : require
#include "Common.glsl"
layout(location = 0) rayPayloadInEXT uint Payload;
void main() { Payload = 0xe0000000u | G; }
