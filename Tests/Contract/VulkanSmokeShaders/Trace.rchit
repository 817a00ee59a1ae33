#version 460
#extension GL_EXT_ray_tracing : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "Trace.glsl"
layout(shaderRecordEXT, scalar) buffer Record { uint Value; uint Ignore; };
layout(location = 0) rayPayloadInEXT FHit Payload;
void main() { Payload = FHit(Value + Add, gl_HitKindEXT, gl_InstanceCustomIndexEXT, gl_HitTEXT); }
