// The second launch of diffuse global illumination, by inline ray query: see DEFERRED_PATHS in DiffuseGI.glsl.
#version 460
#extension GL_EXT_ray_query : require
#define RAY_QUERY
#define DEFERRED_PATHS
#include "DiffuseGI.glsl"

layout(local_size_x = RAY_QUEUE_GROUP_SIZE) in;

void main()
{
	uvec2 Thread;
	uint Number = gl_GlobalInvocationID.y * (RAY_QUEUE_GROUP_SIZE * RAY_QUEUE_ROW_GROUPS) + gl_GlobalInvocationID.x;
	if (FindDeferred(Number, Thread)) { GatherPaths(Thread); }
}
