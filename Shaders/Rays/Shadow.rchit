#version 460
#extension GL_EXT_ray_tracing : require
#include "ShadowPayload.glsl"

layout(location = 0) rayPayloadInEXT FShadowPayload Payload;

void main() { Payload.Blocker = gl_HitTEXT; }
