// Diffuse global illumination by inline ray query.
#version 460
#extension GL_EXT_ray_query : require
#define RAY_QUERY
#include "DiffuseGI.glsl"

layout(local_size_x = RAY_QUERY_GROUP_SIZE, local_size_y = RAY_QUERY_GROUP_SIZE) in;

void main()
{
	// Groups at the border reach beyond it.
#ifdef SCREEN_PROBES
	GatherPaths(gl_GlobalInvocationID.xy);
#else
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	if (all(lessThan(gl_GlobalInvocationID.xy, TurnThreads(uvec2(View.Width, View.Height))))) { GatherPaths(gl_GlobalInvocationID.xy); }
#endif
}
