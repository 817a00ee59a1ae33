// Number of rays that a pixel traces. The includer declares the push constants Push, which have SamplesPerPixel, before.
// ONE_SAMPLE: SamplesPerPixel is known to be 1. Without the loop, only the pixel's coordinates stay live across the trace.
#ifndef LANTERN_SAMPLES_PER_PIXEL_GLSL
#define LANTERN_SAMPLES_PER_PIXEL_GLSL

#ifdef ONE_SAMPLE
const uint SamplesPerPixel = 1u;
#else
#define SamplesPerPixel Push.SamplesPerPixel
#endif

#endif
