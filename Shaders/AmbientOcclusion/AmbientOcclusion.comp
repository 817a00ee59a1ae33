// Ambient occlusion by inline ray query.
#version 460
#extension GL_EXT_ray_query : require
#include "AmbientOcclusion.glsl"
#include "../Rays/QueryRay.glsl"

layout(local_size_x = RAY_QUERY_GROUP_SIZE, local_size_y = RAY_QUERY_GROUP_SIZE) in;

bool IsUnoccluded(vec3 Origin, vec3 Direction, float Length)
{
	return QueryTransmittance(FSceneRef(Push.Pass.Scene).Data, 0u, Push.InstanceMask, Origin, Direction, Length) > 0.5;
}

void main() { TracePixel(gl_GlobalInvocationID.xy); }
