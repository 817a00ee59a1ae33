// Indirect light in the air, by inline ray query.
#version 460
#extension GL_EXT_ray_query : require
#define RAY_QUERY
#include "IndirectVolume.glsl"

layout(local_size_x = RAY_QUERY_GROUP_SIZE, local_size_y = RAY_QUERY_GROUP_SIZE) in;

void main() { LightPair(gl_GlobalInvocationID.xy); }
