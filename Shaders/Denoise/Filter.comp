// One pass of the edge-avoiding à-trous wavelet (Dammertz et al. 2010), steered by variance (Schied et al. 2017). The weight of a
// tap is the likelihood that it shows the same surface and, within the noise that accumulation has left, the same value.
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

vec4 Filter(FViewConstants View, ivec2 Pixel, FSurface Surface)
{
	ivec2 Size = ivec2(View.Width, View.Height);
	vec4 Values[Taps];
	Values[Center] = texelFetch(Textures[Push.Input], Pixel, 0);
	float Variance = GetVariance(Values[Center]);
	if (Variance <= 0.0) { return Values[Center]; } // a value without noise needs no filter; nothing more is read
	for (int Tap = 0; Tap < Taps; ++Tap)
	{
		ivec2 P = Pixel + ivec2(Tap % 3 - 1, Tap / 3 - 1) * int(Push.Step);
		if (Tap != Center) { Values[Tap] = texelFetch(Textures[Push.Input], clamp(P, ivec2(0), Size - 1), 0); }
	}
	vec3 Position = GetPosition(View, Pixel, Surface.Distance);
	float Cosine = max(abs(dot(Surface.Normal, ViewDirection(View, Position))), 0.05);
	float Reach = Push.SigmaDepth * PixelHeight(View, Surface.Distance) * float(Push.Step) / sqrt(Cosine);
	float CenterValue = GetBrightness(GetSignal(Values[Center]));
	float Narrow = 0.0;
#ifdef WITH_EXTENT
	// The reach is a part of the transition's extent: a wider one would blur the transition itself.
	float Width = max(Push.ReachExtent * Values[Center].z / float(Push.Step), 1.0e-3);
	Narrow = 0.5 / (Width * Width);
	if (Narrow > 8.0) { return Values[Center]; } // every other tap's weight would vanish
#endif
	FSignal Sum = FSignal(0.0);
	float SumVariance = 0.0, SumWeights = 0.0;
	for (int Tap = 0; Tap < Taps; ++Tap)
	{
		ivec2 P = Pixel + ivec2(Tap % 3 - 1, Tap / 3 - 1) * int(Push.Step);
		if (any(lessThan(P, ivec2(0))) || any(greaterThanEqual(P, Size))) { continue; }
		FSignal Value = GetSignal(Values[Tap]);
		vec2 Off = vec2(Tap % 3 - 1, Tap / 3 - 1);
		float Weight = GetKernel(Tap) * exp(-Narrow * dot(Off, Off));
		if (Tap != Center)
		{
			FSurface Other = LoadSurface(Push.Surface, P);
			if (Other.Distance <= 0.0) { continue; }
			float Height = abs(dot(Surface.Normal, GetPosition(View, P, Other.Distance) - Position)) / Reach;
			float Difference = GetBrightness(Value) - CenterValue;
			Difference *= Difference / (Push.SigmaValue * Push.SigmaValue * GetNoise(Variance, GetVariance(Values[Tap])) + 1.0e-12);
			Weight *= exp(-Height - Difference) * pow(max(dot(Surface.Normal, Other.Normal), 0.0), Push.SigmaNormal);
		}
		Sum += Value * Weight;
		SumVariance += Weight * Weight * GetVariance(Values[Tap]);
		SumWeights += Weight;
	}
	vec4 Result = WithVariance(Sum / SumWeights, SumVariance / (SumWeights * SumWeights));
#ifdef WITH_EXTENT
	Result.z = Values[Center].z;
#endif
	return Result;
}

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	ivec2 Pixel = ivec2(gl_GlobalInvocationID.xy);
	if (any(greaterThanEqual(Pixel, ivec2(View.Width, View.Height)))) { return; }
	FSurface Surface = LoadSurface(Push.Surface, Pixel);
	vec4 Result = Surface.Distance > 0.0 ? Filter(View, Pixel, Surface) : texelFetch(Textures[Push.Input], Pixel, 0);
	imageStore(Images[Push.Output], Pixel, RoundToHalf(Result));
}
