// Miss of a shadow ray: nothing blocks the light.
#version 460
#extension GL_EXT_ray_tracing : require
#include "ShadowPayload.glsl"

layout(location = 0) rayPayloadInEXT FShadowPayload Payload;

void main() { Payload.BlockerDistance = NotBlocked; }
