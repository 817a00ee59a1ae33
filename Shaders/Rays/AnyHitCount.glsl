// COUNT_ANY_HITS (r.RT.Opacity.Count): alpha tests under rays, in any-hit shaders or in loops over a ray query's
// candidates, count themselves.
#ifndef LANTERN_ANY_HIT_COUNT_GLSL
#define LANTERN_ANY_HIT_COUNT_GLSL

#include "../Library/Bindings.glsl"

#ifdef COUNT_ANY_HITS
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FAnyHitCountRef { uint Calls; };
void CountAnyHit(FAddress Counter) { atomicAdd(FAnyHitCountRef(Counter).Calls, 1u); }
#else
void CountAnyHit(FAddress) {}
#endif

#endif
