// @TITLE@ by ray queries.
#version 460
#extension GL_EXT_ray_query : require
#include "@NAME@.glsl"

layout(local_size_x = RAY_QUERY_GROUP_SIZE, local_size_y = RAY_QUERY_GROUP_SIZE) in;

void main() { ShadePixel(gl_GlobalInvocationID.xy); }
