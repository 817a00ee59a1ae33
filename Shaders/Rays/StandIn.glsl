// STAND_IN: the shader runs in place of one that is not compiled yet. The rays that hit it are counted by material, so that
// what is seen most is compiled first.
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
