// The queue of shadow rays by inline ray query.
#version 460
#extension GL_EXT_ray_query : require
#include "ShadowQueue.glsl"
#include "QueryRay.glsl"

layout(local_size_x = RAY_QUEUE_GROUP_SIZE) in;

float TraceShadowRay(vec3 Origin, vec3 Direction, float Length, uint Flags, uint Mask)
{
	TraceRayQuery(FSceneRef(Push.Pass.Scene).Data, Flags | gl_RayFlagsTerminateOnFirstHitEXT, Mask, Origin, Direction, Length);
	return IsRayQueryMiss() ? PassOrBlock(exp(-RayDepth)) : rayQueryGetIntersectionTEXT(RayQuery, true);
}

void main() { TraceRequest(gl_GlobalInvocationID.y * (RAY_QUEUE_GROUP_SIZE * RAY_QUEUE_ROW_GROUPS) + gl_GlobalInvocationID.x); }
