// Step "known" of the temporal filter, for shadows of the sun and of lamps: where the light may have changed, as the scene tells it.
//   Takes: casters that moved in the last frames (Push.Casters), the distances of Load.glsl, and the surface's own motion.
//   Gives: MayHaveChanged. NoteDistances needs the tile complete; FindTouched needs the distances of the whole group.
//   Why: chance looks like change. In dappled shade the test of Change.glsl dropped every tenth history of a scene that stood still.
//   Where nothing has moved, there is nothing to look for. A work group is a tile of the screen, and shares the casters.
#ifndef LANTERN_TEMPORAL_KNOWN_GLSL
#define LANTERN_TEMPORAL_KNOWN_GLSL

#include "../../Library/GroupBounds.glsl"
#include "Load.glsl"

shared uint bTouched;

// Before a barrier.
void StartTouched()
{
	if (gl_LocalInvocationIndex != 0u) { return; }
	bTouched = 0u;
	StartBounds();
}

void NoteDistances()
{
	float Inverse = TileInverseDepth[GetTileIndex(ivec2(0))];
	if (Push.CasterCount == 0u || !(Inverse > 0.0)) { return; }
	NoteDistance(1.0 / Inverse);
}

// Called by all threads.
void FindTouched(FViewConstants View)
{
	if (Push.CasterCount == 0u) { return; }
	if (HasBounds())
	{
		vec4 Bound = BoundGroup(View, gl_WorkGroupID.xy * GroupSize, GroupSize);
		FCasterList List = FCasterList(Push.Casters, Push.CasterCount, Push.CasterSpread);
		FSceneConstants Scene = FSceneRef(Push.Pass.Scene).Data;
#if CHANNELS == 1
		if (MayAnyShadow(Scene, View, List, Bound)) { bTouched = 1u; }
#else
		if (MayAnyShadowLamp(Scene, View, List, Bound)) { bTouched = 1u; }
#endif
	}
	barrier();
}

bool MayHaveChanged(FViewConstants View, uvec2 Pixel, float Distance)
{
	if (Push.bChangesKnown == 0u || bTouched != 0u) { return true; }
	return Push.Motion != NO_TEXTURE && MovedItself(View, Distance, Pixel, texelFetch(Textures[Push.Motion], ivec2(Pixel), 0));
}

#endif
