// Record value · 65536 + mark of the intersection · 256 + hit kind.
#version 460
#extension GL_EXT_ray_tracing : require
#extension GL_EXT_scalar_block_layout : require
layout(shaderRecordEXT, scalar) buffer Record { uint Value; };
layout(location = 0) rayPayloadInEXT uint Payload;
hitAttributeEXT uint Mark;
void main() { Payload = (Value << 16) | (Mark << 8) | gl_HitKindEXT; }
