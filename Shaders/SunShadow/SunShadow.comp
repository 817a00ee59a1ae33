#version 460
#extension GL_EXT_ray_query : require
#include "SunShadow.glsl"
#include "../Rays/QueryShadow.glsl"

layout(local_size_x = RAY_QUERY_GROUP_SIZE, local_size_y = RAY_QUERY_GROUP_SIZE) in;

float TraceSun(vec3 Origin, vec3 Direction)
{
	return QueryBlocker(FSceneRef(Push.Pass.Scene).Data, Push.RayFlags, Push.InstanceMask, Origin, Direction, Push.MaxDistance);
}

void main() { ShadePixel(gl_GlobalInvocationID.xy); }
