// Counts alpha tests of rays, in any-hit shaders and in the candidate loops of ray queries.
// COUNT_ANY_HITS: defined if r.RT.Opacity.Count is on; otherwise CountAnyHit does nothing.
#ifndef LANTERN_ANY_HIT_COUNT_GLSL
#define LANTERN_ANY_HIT_COUNT_GLSL

#include "../Library/Bindings.glsl"

#ifdef COUNT_ANY_HITS
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FAnyHitCountRef { uint Count; };
void CountAnyHit(FAddress Counter) { atomicAdd(FAnyHitCountRef(Counter).Count, 1u); }
#else
void CountAnyHit(FAddress) {}
#endif

#endif
