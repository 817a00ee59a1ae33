// One pass of the edge-avoiding à-trous wavelet (Dammertz et al. 2010), steered by variance (Schied et al. 2017). The weight of a
// tap is the likelihood that it shows the same surface and, within the noise that accumulation has left, the same value.
// WITH_REACH: pixels say how far they reach.
// PAIR: two signals are filtered at once. They share what surfaces say, and nothing else.
#version 460
#include "../Shared/DenoiseTypes.h"
#include "../Library/View.glsl"
#include "Signal.glsl"

layout(local_size_x = DENOISE_GROUP_SIZE, local_size_y = DENOISE_GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FFilterConstants Push; };

const int Taps = 9, Center = 4;
const float Kernel[3] = float[3](0.25, 0.5, 0.25);

float GetKernel(int Tap) { return Kernel[Tap % 3] * Kernel[Tap / 3]; }

vec3 GetPosition(FViewConstants View, ivec2 Pixel, float Distance) { return RelativePosition(View, vec2(Pixel) + 0.5, Distance); }

// Variance of a difference. Colours take that of either side, so that each weighs the other alike: what stands out gives as much as it
// takes, and no light is lost. Visibility takes its own: its variance follows from its mean, and occlusion was 7 % worse otherwise.
float GetNoise(float Own, float Others) { return CHANNELS == 1 ? 2.0 * Own : Own + Others; }

#ifdef PAIR
const int Signals = 2;
#else
const int Signals = 1;
#endif

uint GetInput(int Signal) { return Signal == 0 ? Push.Input : Push.SecondInput; }

ivec2 GetPixel(ivec2 Pixel, int Tap) { return Pixel + ivec2(Tap % 3 - 1, Tap / 3 - 1) * int(Push.Step); }

// Reads what is around a pixel. Returns whether any of it is noisy; else nothing more than the pixel is read.
bool LoadTaps(ivec2 Pixel, ivec2 Size, out vec4 Values[Signals][Taps])
{
	bool bNoisy = false;
	for (int S = 0; S < Signals; ++S)
	{
		Values[S][Center] = texelFetch(Textures[GetInput(S)], Pixel, 0);
		bNoisy = bNoisy || GetVariance(Values[S][Center]) > 0.0;
	}
	if (!bNoisy) { return false; }
	for (int Tap = 0; Tap < Taps; ++Tap)
	{
		ivec2 P = clamp(GetPixel(Pixel, Tap), ivec2(0), Size - 1);
		for (int S = 0; S < Signals; ++S)
		{
			if (Tap != Center) { Values[S][Tap] = texelFetch(Textures[GetInput(S)], P, 0); }
		}
	}
	return true;
}

// How far taps may lie from the surface of the middle.
struct FReach
{
	vec3 Position;
	float Height; // metres
	float Narrow; // of the exponent by distance on the screen
};

#ifdef WITH_REACH
// Rays of one frame are far apart in their lengths. Returns the mean of those around, pixels.
float AverageReach(ivec2 Pixel, ivec2 Size)
{
	vec2 Sum = vec2(0.0);
	for (int Tap = 0; Tap < Taps; ++Tap)
	{
		float Its = texelFetch(Textures[Push.Reach], clamp(GetPixel(Pixel, Tap), ivec2(0), Size - 1), 0).x;
		if (Its > 0.0) { Sum += GetKernel(Tap) * vec2(Its, 1.0); }
	}
	return Sum.y > 0.0 ? Sum.x / Sum.y : 0.0;
}
#endif

FReach MakeReach(FViewConstants View, ivec2 Pixel, FSurface Surface, vec4 Middle)
{
	vec3 Position = GetPosition(View, Pixel, Surface.Distance);
	float Cosine = max(abs(dot(Surface.Normal, ViewDirection(View, Position))), 0.05);
	float Height = Push.SigmaDepth * PixelHeight(View, Surface.Distance) * float(Push.Step) / sqrt(Cosine);
	float Narrow = 0.0;
#if defined(WITH_REACH) || defined(WITH_EXTENT)
#ifdef WITH_REACH
	float Width = AverageReach(Pixel, ivec2(View.Width, View.Height));
#else
	// The reach is a part of the transition's extent: a wider one would blur the transition itself.
	float Width = Push.ReachExtent * Middle.z;
#endif
	Width = max(Width / float(Push.Step), 1.0e-3);
	Narrow = 0.5 / (Width * Width);
#endif
	return FReach(Position, Height, Narrow);
}

// Returns the exponent that says how unlike the surface of a tap is, and OutCosine between the normals. False: it shows none.
bool CompareSurface(FViewConstants View, ivec2 P, FSurface Surface, FReach Reach, out float OutHeight, out float OutCosine)
{
	FSurface Other = LoadSurface(Push.Surface, P);
	OutHeight = abs(dot(Surface.Normal, GetPosition(View, P, Other.Distance) - Reach.Position)) / Reach.Height;
	OutCosine = pow(max(dot(Surface.Normal, Other.Normal), 0.0), Push.SigmaNormal);
	return Other.Distance > 0.0;
}

float GetDifference(vec4 Middle, vec4 Value)
{
	float Difference = GetBrightness(GetSignal(Value)) - GetBrightness(GetSignal(Middle));
	float Noise = GetNoise(GetVariance(Middle), GetVariance(Value));
	return Difference * Difference / (Push.SigmaValue * Push.SigmaValue * Noise + 1.0e-12);
}

struct FSum
{
	FSignal Signal;
	float Variance, Weight;
};

void Filter(FViewConstants View, ivec2 Pixel, FSurface Surface, out vec4 Results[Signals])
{
	ivec2 Size = ivec2(View.Width, View.Height);
	vec4 Values[Signals][Taps];
	bool bNoisy = LoadTaps(Pixel, Size, Values);
	for (int S = 0; S < Signals; ++S) { Results[S] = Values[S][Center]; }
	if (!bNoisy) { return; }
	FReach Reach = MakeReach(View, Pixel, Surface, Values[0][Center]);
	if (Reach.Narrow > 8.0) { return; } // every other tap's weight would vanish
	FSum Sums[Signals];
	for (int S = 0; S < Signals; ++S) { Sums[S] = FSum(FSignal(0.0), 0.0, 0.0); }
	for (int Tap = 0; Tap < Taps; ++Tap)
	{
		ivec2 P = GetPixel(Pixel, Tap);
		if (any(lessThan(P, ivec2(0))) || any(greaterThanEqual(P, Size))) { continue; }
		vec2 Off = vec2(Tap % 3 - 1, Tap / 3 - 1);
		float Weight = GetKernel(Tap) * exp(-Reach.Narrow * dot(Off, Off)), Height = 0.0, Cosine = 1.0;
		if (Tap != Center && !CompareSurface(View, P, Surface, Reach, Height, Cosine)) { continue; }
		for (int S = 0; S < Signals; ++S)
		{
			float Its = Weight;
			if (Tap != Center) { Its *= exp(-Height - GetDifference(Values[S][Center], Values[S][Tap])) * Cosine; }
			Sums[S].Signal += GetSignal(Values[S][Tap]) * Its;
			Sums[S].Variance += Its * Its * GetVariance(Values[S][Tap]);
			Sums[S].Weight += Its;
		}
	}
	for (int S = 0; S < Signals; ++S)
	{
		if (GetVariance(Results[S]) <= 0.0) { continue; } // a value without noise needs no filter
		Results[S] = WithVariance(Sums[S].Signal / Sums[S].Weight, Sums[S].Variance / (Sums[S].Weight * Sums[S].Weight));
#ifdef WITH_EXTENT
		Results[S].z = Values[S][Center].z;
#endif
	}
}

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	ivec2 Pixel = ivec2(gl_GlobalInvocationID.xy);
	if (any(greaterThanEqual(Pixel, ivec2(View.Width, View.Height)))) { return; }
	FSurface Surface = LoadSurface(Push.Surface, Pixel);
	vec4 Results[Signals];
	if (Surface.Distance > 0.0) { Filter(View, Pixel, Surface, Results); }
	else
	{
		for (int S = 0; S < Signals; ++S) { Results[S] = texelFetch(Textures[GetInput(S)], Pixel, 0); }
	}
	imageStore(Images[Push.Output], Pixel, RoundToHalf(Results[0]));
#ifdef PAIR
	imageStore(Images[Push.SecondOutput], Pixel, RoundToHalf(Results[1]));
#endif
}
