// Lists the clusters of emissive triangles that have changed since the last frame, with what they were, and keeps what all of them are.
#version 460
#include "../Shared/LampChangeTypes.h"
#include "../Library/Bindings.glsl"
#include "../Library/Random.glsl"
#include "ClusterLight.glsl"

layout(local_size_x = TILE_PIXELS) in;
layout(push_constant, scalar) uniform FPush { FListChangesConstants Push; };

layout(buffer_reference, scalar, buffer_reference_align = 8) buffer FBoundsRef { FEmitterCluster Data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FLampChangesRef { FLampChanges Data; };

// Kept tables lie in the cells of their objects, so that a moved origin changes nothing. Their First tells the cell.
FEmitterCluster LoadNow(FSceneConstants Scene, uint Number, ivec3 Cell)
{
	FEmitterCluster Now = FBoundsRef(Scene.EmissiveBounds).Data[Number];
	Now.First = HashPcg(uint(Cell.x) ^ HashPcg(uint(Cell.y) ^ HashPcg(uint(Cell.z))));
	return Now;
}

bool IsSame(FEmitterCluster A, FEmitterCluster B)
{
	return A.Center == B.Center && A.Half == B.Half && A.Normal == B.Normal && A.Power == B.Power && A.First == B.First;
}

void main()
{
	uint Number = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * TILE_PIXELS + gl_LocalInvocationIndex;
	if (Number >= Push.Count) { return; }
	FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
	ivec3 Cell = FObjectRef(Scene.Objects).Data[FEmissiveClusterRef(Scene.EmissiveClusters).Data[Number].Object].Cell;
	FEmitterCluster Now = LoadNow(Scene, Number, Cell), Before = FBoundsRef(Push.Kept).Data[Number];
	FBoundsRef(Push.Kept).Data[Number] = Now;
	if (Push.bFresh != 0u || IsSame(Now, Before)) { return; }
	FLampChangesRef List = FLampChangesRef(Push.List);
	uint Place = atomicAdd(List.Data.EmitterCount, 1u);
	if (Place >= EMITTER_CHANGES) { return; }
	List.Data.Emitters[Place] = FEmitterChange(Number, MoveCluster(Before, CellOffset(Scene, Cell)));
}
