#version 460
#extension GL_EXT_ray_tracing : require
layout(location = 0) rayPayloadInEXT uint Payload;
void main() { Payload = 0xf0000001u; }
