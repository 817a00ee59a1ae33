// Surfaces that light shines through, by inline ray query.
#version 460
#extension GL_EXT_ray_query : require
#define RAY_QUERY
#include "Transmission.glsl"

layout(local_size_x = RAY_QUERY_GROUP_SIZE, local_size_y = RAY_QUERY_GROUP_SIZE) in;

void main()
{
	if (!IsOutsideView(FViewRef(Push.Pass.View).Data, gl_GlobalInvocationID.xy)) { ShowLayers(gl_GlobalInvocationID.xy); }
}
