// Finds where each cluster of emissive triangles lies in this frame: what EmissiveTriangles.comp knows, seen from the scene's origin.
#version 460
#include "../Shared/LocalLightTypes.h"
#include "../Library/Bindings.glsl"
#include "ClusterLight.glsl"

layout(local_size_x = EMITTER_GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FEmitterClustersConstants Push; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer FBoundsRef { FEmitterCluster Data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) writeonly buffer FOutRef
{
	FEmitterHeader Header;
	FEmitterCluster Data[];
};

void main()
{
	uint Number = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * EMITTER_GROUP_SIZE + gl_LocalInvocationIndex;
	if (Number >= Push.Count) { return; }
	FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
	uint Object = FEmissiveClusterRef(Scene.EmissiveClusters).Data[Number].Object;
	vec3 Offset = CellOffset(Scene, FObjectRef(Scene.Objects).Data[Object].Cell);
	FOutRef(Push.Clusters).Data[Number] = MoveCluster(FBoundsRef(Scene.EmissiveBounds).Data[Number], Offset);
	if (Number == 0u) { FOutRef(Push.Clusters).Header = FEmitterHeader(Push.ReflectedRoughness, Push.Dim, uint[2](0u, 0u)); }
}
