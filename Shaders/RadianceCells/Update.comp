// Updates radiance cells by inline ray query.
#version 460
#extension GL_EXT_ray_query : require
#define RAY_QUERY
#include "Update.glsl"

layout(local_size_x = RADIANCE_CELL_UPDATE_GROUP) in;

void main() { UpdateCell(gl_GlobalInvocationID.y * RADIANCE_CELL_ROW + gl_GlobalInvocationID.x); }
