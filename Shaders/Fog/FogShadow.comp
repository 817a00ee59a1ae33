// Light in fog by inline ray query.
#version 460
#extension GL_EXT_ray_query : require
#include "FogShadow.glsl"
#include "../Rays/QueryRay.glsl"

layout(local_size_x = RAY_QUERY_GROUP_SIZE, local_size_y = RAY_QUERY_GROUP_SIZE) in;

float UnblockedShare(vec3 Origin, vec3 Direction, float Length, uint Mask)
{
	return QueryTransmittance(FSceneRef(Push.Pass.Scene).Data, Push.RayFlags, Mask, Origin, Direction, Length);
}

void main() { LightPair(gl_GlobalInvocationID.xy); }
