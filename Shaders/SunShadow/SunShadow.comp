// Sun shadows by inline ray query.
#version 460
#extension GL_EXT_ray_query : require
#include "SunShadow.glsl"
#include "../Rays/QueryShadow.glsl"

layout(local_size_x = RAY_QUERY_GROUP_SIZE, local_size_y = RAY_QUERY_GROUP_SIZE) in;

float TraceSunRay(vec3 Origin, vec3 Direction)
{
	return QueryBlockerDistance(FSceneRef(Push.Pass.Scene).Data, Push.RayFlags, Push.InstanceMask, Origin, Direction, Push.MaxDistance);
}

void main() { TracePixel(gl_GlobalInvocationID.xy); }
