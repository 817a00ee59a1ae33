#version 460
#extension GL_EXT_ray_tracing : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "Trace.glsl"
layout(location = 0) rayPayloadInEXT FHit Payload;
void main() { Payload = FHit(MissValue, 0, 0, -1); }
