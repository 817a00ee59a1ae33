// Hit of a shadow ray whose pass wants to know the distance of the blocker.
#version 460
#extension GL_EXT_ray_tracing : require
#include "ShadowPayload.glsl"

layout(location = 0) rayPayloadInEXT FShadowPayload Payload;

void main() { Payload.BlockerDistance = gl_HitTEXT; }
