#version 460
#extension GL_EXT_ray_tracing : require

layout(location = 0) rayPayloadInEXT uint bVisible;

void main() { bVisible = 1u; }
