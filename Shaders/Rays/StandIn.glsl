// Counts the rays that hit stand-ins, by material, so that the materials seen most are compiled first.
// STAND_IN: defined if this shader runs in place of one that is not compiled yet.
#ifndef LANTERN_STAND_IN_GLSL
#define LANTERN_STAND_IN_GLSL

#ifdef STAND_IN
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FStandInHitsRef { uint Data[]; };
void CountStandIn(FAddress Counts, uint Material)
{
	if (Counts != 0ul) { atomicAdd(FStandInHitsRef(Counts).Data[Material], 1u); }
}
#else
void CountStandIn(FAddress Counts, uint Material) {}
#endif

#endif
