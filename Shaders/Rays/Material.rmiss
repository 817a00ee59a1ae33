// Miss of a material ray: a negative distance.
#version 460
#extension GL_EXT_ray_tracing : require
#include "MaterialPayload.glsl"

layout(location = 0) rayPayloadInEXT FMaterialPayload Payload;

void main() { Payload.Distance = -1.0; }
