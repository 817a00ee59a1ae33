// Reflections by inline ray query.
#version 460
#extension GL_EXT_ray_query : require
#define RAY_QUERY
#include "Paths.glsl"

layout(local_size_x = RAY_QUEUE_GROUP_SIZE) in;

void main() { ReflectPixel(gl_GlobalInvocationID.y * (RAY_QUEUE_GROUP_SIZE * RAY_QUEUE_ROW_GROUPS) + gl_GlobalInvocationID.x); }
