// What the steps of the temporal filter hand on: the estimate of this frame, and what is known from the frames before.
#ifndef LANTERN_TEMPORAL_TYPES_GLSL
#define LANTERN_TEMPORAL_TYPES_GLSL

#ifdef KNOWN_NOISE // colours; see FDenoiseInputs::bKnownNoise
#include "../Signal.glsl"
struct FNeighborhood
{
	float Mean; // brightness of the pixel alone
};
#else
#include "Neighborhood.glsl"
#include "Window.glsl"
#endif

// What this frame alone says about a pixel.
struct FFrameEstimate
{
	FSignal Value;
	bool bHasValue; // false: the signal is not finite, or Value stands for it
#if CHANNELS != 1 && !defined(KNOWN_NOISE)
	FWindow Window;
#endif
	FNeighborhood Neighborhood;
	float NoiseVariance; // variance of a value of one unit of rays; for visibility as if every transition were soft
	float Rays;          // of which the value is the mean. Its unit: what most pixels have, for visibility Push.RaysPerPixel
	float Extent;        // width of the transition (penumbra), pixels; MaxHalf: as wide as can be
};

// What a pixel keeps from frame to frame.
struct FAccumulated
{
	FSignal Mean;
	float NoiseSigma;       // standard deviation of one frame's noise
	float Frames;           // number of frames that the mean is worth; 0: nothing is known
	float NeighborhoodMean; // mean brightness of the neighbourhood, over time
};

// The accumulated signal where the pixel's surface was in the previous frame.
struct FHistory
{
	FAccumulated Past;
	float ResamplingVariance; // error of the mean by resampling, as a variance
	bool bResampled;          // read between texels; false: the position is that of a texel, which is the very same point
	ivec2 Texel;              // texel that is nearest to the position
};

#endif
