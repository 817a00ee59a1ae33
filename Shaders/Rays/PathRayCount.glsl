// Counts the rays of paths. COUNTS_PATH_RAYS: defined if r.RT.Rays.CountPaths is on; otherwise CountPathRay does nothing.
#ifndef LANTERN_PATH_RAY_COUNT_GLSL
#define LANTERN_PATH_RAY_COUNT_GLSL

#include "../Library/Bindings.glsl"

#ifdef COUNTS_PATH_RAYS
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FPathRayStatisticsRef { FPathRayStatistics Data; };

void CountPathRay(FSceneConstants Scene, uint Kind)
{
	if (Scene.PathRayStatistics == FAddress(0)) { return; } // memory was short
	atomicAdd(FPathRayStatisticsRef(Scene.PathRayStatistics).Data.Rays[Kind], 1u);
}
#else
void CountPathRay(FSceneConstants Scene, uint Kind) {}
#endif

#endif
