// Record value · 65536 + G · 256 + custom index.
#version 460
#extension GL_EXT_ray_tracing : require
#extension GL_GOOGLE_include_directive : require
#include "Common.glsl"
layout(shaderRecordEXT, scalar) buffer Record { uint Value; };
layout(location = 0) rayPayloadInEXT uint Payload;
void main() { Payload = (Value << 16) | (G << 8) | gl_InstanceCustomIndexEXT; }
