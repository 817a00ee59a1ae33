// Accumulation over time: where the pixel's surface was seen before, the frame's value joins the mean of those before it.
//   Noise: rays that see or do not see have the variance p (1 − p), which needs no estimate but p's. How much of it is
//     edges and not noise is known where the signal comes with the extent of its transitions: one that is narrower than a
//     pixel is an edge, and a frame alone is right about it. Of colours nothing is known: what a pixel differs from all
//     that is next to it by is noise, for edges and lines have company. A signal without noise needs no other frames and no
//     filter, however much structure it has: hard shadows stay what they are.
//   Weights: by the variances of both sides (Kalman 1960). That of the history is what is left of the noise, and what
//     resampling makes of it where it is not smooth. Once it has been accumulated for long, the weights are exponential,
//     with a time constant in seconds.
//   Clamp: the mean stays within what the neighbourhood says now (Salvi 2016, "An Excursion in Temporal Supersampling").
//     Where all of it says the same, that is about what the mean becomes: lit and shadowed regions have no lag.
//   Change: where the neighbourhood's mean is off its own mean over time by more than chance explains, the light has
//     changed, and accumulation starts anew (the question of Schied et al. 2018, "Gradient Estimation for Real-Time Adaptive
//     Temporal Filtering", asked of the samples that there are).
#version 460
#extension GL_EXT_control_flow_attributes : require
#include "../Shared/DenoiseTypes.h"
#include "../Library/View.glsl"
#include "Signal.glsl"

layout(local_size_x = DENOISE_GROUP_SIZE, local_size_y = DENOISE_GROUP_SIZE) in;
layout(push_constant, scalar) uniform FPush { FTemporalConstants Push; };

const int Radius = DENOISE_WINDOW_RADIUS;
const int Group = DENOISE_GROUP_SIZE;
const int Rows = Group + 2 * Radius; // of a window's sums, for all of the group
const int NoiseRadius = 2;
// Transitions of so few pixels are edges, and of so many are not.
const float EdgePixels = 0.2, SoftPixels = 1.0;
// 49 rays that all see may belong to a pixel that 6 % of the rays do not see from (the rule of three), and in a penumbra
// neighbours differ. Occlusion as slight as that is better off smooth than exact.
#ifdef WITH_EXTENT
const float ClampSlack = 0.2;
#else
const float ClampSlack = 0.0;
#endif
const int Side = Rows + 2;           // of the tile: noise asks for the pixels next to those of the window

shared FSignal Values[Side * Side];
shared float Depths[Side * Side]; // 1 / distance, linear over planes; 0: no value
shared FSignal RowSums[Rows * Group], RowSquares[Rows * Group];
shared float RowCounts[Rows * Group];
#ifdef WITH_EXTENT
shared float Extents[Side * Side]; // 0: unknown
#endif
shared float Noises[Rows * Rows]; // of each pixel; negative: it cannot be told

// Over what lies about as far away as the pixel.
struct FNear
{
	float Mean;  // of the brightness
	float Noise; // negative: it cannot be told
	float Count; // pixels
};

struct FWindow // 7×7, whatever it shows
{
	FSignal Mean, Sigma;
	float Variance; // of the brightness
	float Noise;    // what of it is noise; of visibility: what it would be without edges
	FNear Near;
	float Extent; // of the transition, pixels
};

struct FAccumulated
{
	FSignal Mean;
	float Sigma;      // of one frame's noise
	float Frames;     // that the mean is worth; 0: nothing
	float WindowMean; // of the brightness around it
	float WindowNoise; // of visibility: of one frame, mean around it
	float Resampling; // variance that resampling may have added to the mean
	bool bMoved;      // the history is not that of the pixel itself
};

void LoadTile(ivec2 Size)
{
	ivec2 First = ivec2(gl_WorkGroupID.xy) * Group - (Radius + 1);
	[[dont_unroll]] for (int I = int(gl_LocalInvocationIndex); I < Side * Side; I += Group * Group)
	{
		ivec2 P = First + ivec2(I % Side, I / Side);
		bool bInside = all(greaterThanEqual(P, ivec2(0))) && all(lessThan(P, Size));
		P = clamp(P, ivec2(0), Size - 1);
		FSignal Value = GetSignal(texelFetch(Textures[Push.Signal], P, 0));
		float Distance = texelFetch(Textures[Push.Surface], P, 0).x;
		bool bValid = bInside && Distance > 0.0 && IsFinite(Distance) && IsSignalFinite(Value);
		Depths[I] = bValid ? 1.0 / Distance : 0.0;
#ifdef WITH_EXTENT
		float Extent = bValid ? texelFetch(Textures[Push.Extent], P, 0).x : 0.0;
		Extents[I] = IsFinite(Extent) ? Extent : 0.0;
#endif
		Values[I] = bValid ? clamp(Value, FSignal(0.0), FSignal(MaxHalf)) : FSignal(0.0);
	}
}

// Whether a pixel and those on both sides lie on one plane.
bool IsFlat(int I, int Step)
{
	float Sum = Depths[I - Step] + Depths[I + Step];
	return Depths[I - Step] > 0.0 && Depths[I + Step] > 0.0 && abs(Sum - 2.0 * Depths[I]) < 0.02 * Depths[I];
}

// Square of what the pixel differs from at least three of its four neighbours by, or from two where only these are of its
// surface. For zeros and ones at random this is the variance, to a quarter. Negative: it cannot be told.
float FindNoise(int I)
{
	if (Depths[I] <= 0.0) { return -1.0; }
	bool bX = IsFlat(I, 1), bY = IsFlat(I, Side);
	if (!bX && !bY) { return -1.0; }
	vec2 X = vec2(GetBrightness(Values[I - 1]), GetBrightness(Values[I + 1]));
	vec2 Y = vec2(GetBrightness(Values[I - Side]), GetBrightness(Values[I + Side]));
	vec2 Between = bX ? X : Y;
	if (bX && bY) { Between = vec2(max(min(X.x, X.y), min(Y.x, Y.y)), min(max(X.x, X.y), max(Y.x, Y.y))); }
	float Value = GetBrightness(Values[I]);
	float Off = Value - clamp(Value, min(Between.x, Between.y), max(Between.x, Between.y));
	return Off * Off;
}

void FindNoises()
{
	[[dont_unroll]] for (int I = int(gl_LocalInvocationIndex); I < Rows * Rows; I += Group * Group) { Noises[I] = FindNoise((I / Rows + 1) * Side + I % Rows + 1); }
}

// Extent of the transition that the pixel lies in or beside: what those around it that know say, the nearest most.
float FindExtent()
{
#ifdef WITH_EXTENT
	ivec2 Own = ivec2(gl_LocalInvocationID.xy) + Radius + 1;
	float Depth = Depths[Own.y * Side + Own.x];
	float Sum = 0.0, Weights = 0.0;
	[[dont_unroll]] for (int Y = -Radius; Y <= Radius; ++Y)
	{
		[[dont_unroll]] for (int X = -Radius; X <= Radius; ++X)
		{
			int I = (Own.y + Y) * Side + Own.x + X;
			if (Extents[I] <= 0.0 || abs(Depths[I] - Depth) > 0.1 * Depth) { continue; }
			float Weight = 1.0 / float(1 + X * X + Y * Y);
			Sum += Weight * Extents[I];
			Weights += Weight;
		}
	}
	return Weights > 0.0 ? min(Sum / Weights, MaxHalf) : MaxHalf;
#else
	return MaxHalf;
#endif
}

FNear LookAround()
{
	ivec2 Own = ivec2(gl_LocalInvocationID.xy) + Radius;
	float Depth = Depths[(Own.y + 1) * Side + Own.x + 1];
	float Sum = 0.0, Count = 0.0, NoiseSum = 0.0, NoiseCount = 0.0;
	[[dont_unroll]] for (int Y = -NoiseRadius; Y <= NoiseRadius; ++Y)
	{
		[[dont_unroll]] for (int X = -NoiseRadius; X <= NoiseRadius; ++X)
		{
			int I = (Own.y + Y + 1) * Side + Own.x + X + 1;
			if (abs(Depths[I] - Depth) > 0.1 * Depth) { continue; }
			Sum += GetBrightness(Values[I]);
			Count += 1.0;
			float Noise = Noises[(Own.y + Y) * Rows + Own.x + X];
			if (Noise < 0.0) { continue; }
			NoiseSum += Noise;
			NoiseCount += 1.0;
		}
	}
	return FNear(Sum / max(Count, 1.0), NoiseCount >= 3.0 ? NoiseSum / NoiseCount : -1.0, max(Count, 1.0));
}

void SumRows()
{
	[[dont_unroll]] for (int I = int(gl_LocalInvocationIndex); I < Rows * Group; I += Group * Group)
	{
		int Start = (I / Group + 1) * Side + I % Group + 1;
		FSignal Sum = FSignal(0.0), Squares = FSignal(0.0);
		float Count = 0.0;
		[[dont_unroll]] for (int X = 0; X <= 2 * Radius; ++X)
		{
			FSignal Value = Values[Start + X];
			Sum += Value;
			Squares += Value * Value;
			Count += Depths[Start + X] > 0.0 ? 1.0 : 0.0;
		}
		RowSums[I] = Sum;
		RowSquares[I] = Squares;
		RowCounts[I] = Count;
	}
}

// Of the mean of a frame's rays, of which P see.
float GetNoise(float P)
{
	P = clamp(P, 0.0, 1.0);
	return P * (1.0 - P) / Push.RaysPerPixel;
}

FWindow SumColumns()
{
	FSignal Sum = FSignal(0.0), Squares = FSignal(0.0);
	float Count = 0.0;
	[[dont_unroll]] for (int Y = 0; Y <= 2 * Radius; ++Y)
	{
		int I = (int(gl_LocalInvocationID.y) + Y) * Group + int(gl_LocalInvocationID.x);
		Sum += RowSums[I];
		Squares += RowSquares[I];
		Count += RowCounts[I];
	}
	FWindow W;
	W.Mean = Sum / max(Count, 1.0);
	FSignal Variance = max(Squares / max(Count, 1.0) - W.Mean * W.Mean, FSignal(0.0));
	// What rounding leaves of no variance at all.
	Variance *= FSignal(greaterThan(vec3(Variance), 1.0e-6 * vec3(W.Mean * W.Mean)));
	W.Sigma = sqrt(Variance);
	float Sigma = GetBrightness(W.Sigma);
	W.Variance = Sigma * Sigma;
	W.Near = LookAround();
#if CHANNELS == 1
	W.Noise = GetNoise(W.Near.Mean);
#else
	W.Noise = W.Near.Noise >= 0.0 ? W.Near.Noise : W.Variance;
#endif
	W.Extent = FindExtent();
	return W;
}

// Mean square of the second differences around the middle of 4×4 texels: none where the picture is a slope, much at edges.
float GetRoughness(float Texels[16])
{
	const ivec4 Inner = ivec4(5, 6, 9, 10);
	float Sum = 0.0;
	[[dont_unroll]] for (int I = 0; I < 4; ++I)
	{
		int T = Inner[I];
		vec2 Bend = vec2(Texels[T - 1] + Texels[T + 1], Texels[T - 4] + Texels[T + 4]) - 2.0 * Texels[T];
		Sum += dot(Bend, Bend);
	}
	return Sum / 8.0;
}

// By cubic weights, within what the four nearest texels say. Texels that show another surface count as what has been
// sampled Smoothly.
void SampleSharply(FViewConstants View, FReprojection R, FSurface Surface, FSignal Low, FSignal High, inout FAccumulated A)
{
	vec4 X = CubicWeights(R.Fraction.x), Y = CubicWeights(R.Fraction.y);
	FSignal Sum = FSignal(0.0);
	float Texels[16];
	[[dont_unroll]] for (int Tap = 0; Tap < 16; ++Tap)
	{
		ivec2 P = clamp(R.Base + ivec2(Tap & 3, Tap >> 2) - 1, ivec2(0), ivec2(View.Width, View.Height) - 1);
		vec4 H = texelFetch(Textures[Push.History], P, 0);
		bool bSame = AreFinite(H) && IsSameSurface(Surface, LoadSurface(Push.PreviousSurface, P), R.Expected, 2.0 * R.Slope);
		FSignal Value = bSame ? GetSignal(H) : A.Mean;
		Sum += Value * (X[Tap & 3] * Y[Tap >> 2]);
		Texels[Tap] = GetBrightness(Value);
	}
	// Noise is rough too: second differences have six times its variance.
	float OfNoise = 2.0 * 6.0 * A.Sigma * A.Sigma / A.Frames;
	vec2 Between = R.Fraction * (1.0 - R.Fraction);
	float Spread = GetBrightness(High - Low);
	A.Resampling = Push.Resampling * (max(GetRoughness(Texels) - OfNoise, 0.0) * min(Between.x + Between.y, 0.25) + 0.05 * max(Spread * Spread - OfNoise, 0.0));
	A.Mean = clamp(Sum, Low, High);
}

#if CHANNELS == 1
// What the history says of the noise around the pixel: none in what has always been lit or shadowed, so that what moves there is
// seen at once. Few frames that agree prove little (Laplace's rule, with half a ray of either kind).
float FindWindowNoise(ivec2 Center, ivec2 Size, float Frames)
{
	float Sum = 0.0;
	[[dont_unroll]] for (int Y = -NoiseRadius; Y <= NoiseRadius; ++Y)
	{
		[[dont_unroll]] for (int X = -NoiseRadius; X <= NoiseRadius; ++X)
		{
			float P = texelFetch(Textures[Push.History], clamp(Center + ivec2(X, Y), ivec2(0), Size - 1), 0).x;
			P = IsFinite(P) ? clamp((P * Frames + 0.5) / (Frames + 1.0), 0.0, 1.0) : 0.5;
			Sum += GetNoise(P);
		}
	}
	float Side = float(2 * NoiseRadius + 1);
	return Sum / (Side * Side);
}
#endif

FAccumulated LoadHistory(FViewConstants View, uvec2 Pixel, FSurface Surface, FWindow Window)
{
	const FAccumulated None = FAccumulated(FSignal(0.0), 0.0, 0.0, 0.0, 0.0, 0.0, false);
	if (Push.History == NO_TEXTURE) { return None; }
	vec3 ToCamera = -normalize(CameraRay(View, vec2(Pixel) + 0.5));
	vec4 Motion = texelFetch(Textures[Push.Motion], ivec2(Pixel), 0);
	FReprojection R = Reproject(View, Push.PreviousSurface, Pixel, Surface, Motion, ToCamera);
	FAccumulated A = None;
	float Sum = 0.0;
	FSignal Low = FSignal(MaxHalf), High = FSignal(0.0);
	[[dont_unroll]] for (int Tap = 0; Tap < 4; ++Tap)
	{
		float Weight = R.Weights[Tap];
		if (Weight <= 0.0) { continue; }
		vec4 H = texelFetch(Textures[Push.History], GetTap(R, Tap), 0);
#if CHANNELS == 1
		vec4 M = vec4(H.y, H.w, 0.0, 0.0);
		float Frames = H.z;
#else
		vec4 M = texelFetch(Textures[Push.Moments], GetTap(R, Tap), 0);
		float Frames = H.w;
#endif
		if (!AreFinite(H) || !AreFinite(M.xy) || Frames <= 0.0) { continue; }
		A.Mean += GetSignal(H) * Weight;
		A.Sigma += M.x * Weight;
		A.WindowMean += M.y * Weight;
		A.Frames += Weight / Frames; // variances add up, not frames
		Sum += Weight;
		Low = min(Low, GetSignal(H));
		High = max(High, GetSignal(H));
	}
	if (Sum <= 0.0) { return None; }
	// What a few neighbours alone remember is worth less: it is as noisy as they are, and in the same way.
	float Known = R.Known * Sum;
	A = FAccumulated(A.Mean / Sum, A.Sigma / Sum, Sum / A.Frames * Known * Known, A.WindowMean / Sum, 0.0, 0.0, any(greaterThan(R.Fraction * (1.0 - R.Fraction), vec2(1.0e-4))));
#if CHANNELS == 1
	if (abs(Window.Near.Mean - A.WindowMean) > 0.01) { A.WindowNoise = FindWindowNoise(R.Base + ivec2(R.Fraction + 0.5), ivec2(View.Width, View.Height), A.Frames); }
#endif
	// Between equals, and at the texel itself, nothing is to be gained.
	if (Low != High && A.bMoved) { SampleSharply(View, R, Surface, Low, High, A); }
	return A;
}

// How much of the history's length may be kept.
float KeepAfterChange(FWindow Window, FAccumulated History)
{
	if (Push.ChangeSigma <= 0.0 || History.Frames <= 0.0) { return 1.0; }
#if CHANNELS == 1
	if (History.WindowNoise <= 0.0) { return 1.0; } // the same mean
	// Where a shadow has moved the history is blurred, and sees noise in all that has passed. What is sharp now is not noise.
	float Noise = min(History.WindowNoise, max(Window.Near.Noise, 0.3 * Window.Noise));
#else
	float Noise = max(max(Window.Noise, History.Sigma * History.Sigma), 0.25 * Window.Variance);
#endif
	float Variance = Noise / Window.Near.Count * (1.0 + 1.0 / History.Frames);
	float Difference = abs(Window.Near.Mean - History.WindowMean);
	float Z = Difference * inversesqrt(Variance + 1.0e-6 * History.WindowMean * History.WindowMean + 1.0e-12);
	return 1.0 - smoothstep(Push.ChangeSigma, 1.75 * Push.ChangeSigma, Z);
}

float GetAlpha(FAccumulated History, float Noise)
{
	if (History.Frames <= 0.0) { return 1.0; }
#ifdef NO_ADAPTION // r.RT.Debug.Denoise.Adapt
	return max(1.0 / (History.Frames + 1.0), Push.MinAlpha);
#endif
	float OfHistory = Noise / History.Frames + History.Resampling;
	return Noise > 1.0e-6 * (1.0 + OfHistory) ? max(OfHistory / (OfHistory + Noise), Push.MinAlpha) : 1.0;
}

FAccumulated Accumulate(FAccumulated History, FSignal Value, bool bHasValue, FWindow Window)
{
	float Keep = KeepAfterChange(Window, History);
	float Noise = History.Frames > 0.0 ? mix(Window.Noise, History.Sigma * History.Sigma, (1.0 - Push.NoiseAlpha) * Keep) : Window.Noise;
	History.Frames *= Keep;
#if CHANNELS == 1
	float Soft = smoothstep(EdgePixels, SoftPixels, Window.Extent);
	float Off = Value - History.Mean;
	// Beside an edge, a history of somewhere else that disagrees is wrong. One of the pixel's own is not: its rays do differ.
	if (History.bMoved && bHasValue) { History.Resampling += (1.0 - Soft) * Off * Off; }
	Noise = GetNoise(mix(Window.Near.Mean, History.Mean, History.Frames / (History.Frames + 16.0))) * max(Soft, 1.0e-3);
#endif
	if (Push.ClampSigma > 0.0)
	{
		FSignal Range = Window.Sigma * Push.ClampSigma + ClampSlack;
		FSignal Clamped = clamp(History.Mean, Window.Mean - Range, Window.Mean + Range);
		float Moved = GetBrightness(abs(Clamped - History.Mean));
		History.Frames *= 1.0 - clamp(Moved / max(max(GetBrightness(History.Mean), GetBrightness(Clamped)), 1.0e-6), 0.0, 1.0);
		History.Mean = Clamped;
	}
	if (!bHasValue)
	{
		// No value of its own: what was, or else what is around it.
		if (History.Frames <= 0.0) { History = FAccumulated(Window.Mean, sqrt(Noise), 0.0, Window.Near.Mean, 0.0, 0.0, false); }
		return History;
	}
	float Alpha = GetAlpha(History, Noise);
	return FAccumulated(mix(History.Mean, Value, Alpha), sqrt(Noise), 1.0 / Alpha, mix(History.WindowMean, Window.Near.Mean, Alpha), 0.0, 0.0, false);
}

// Around: variance of one frame, by what is around the pixel.
void Store(ivec2 Pixel, FAccumulated A, float Extent, float Around)
{
	// That of few frames is known less well, and a blurred start is better than a wrong one.
	float Frames = max(A.Frames, 1.0);
	float Variance = A.Sigma * A.Sigma / Frames * (1.0 + 1.0 / Frames);
#if CHANNELS == 1 && !defined(WITH_EXTENT)
	// One ray in many is blocked: those that have met none know as little as those that have.
	Variance = max(Variance, 0.5 * Around / Frames);
#endif
	imageStore(Images[Push.Output], Pixel, WithVariance(A.Mean, min(Variance, MaxHalf)) + vec4(0.0, 0.0, CHANNELS == 1 ? Extent : 0.0, 0.0));
	float Sigma = min(A.Sigma, MaxHalf), WindowMean = min(A.WindowMean, MaxHalf);
#if CHANNELS == 1
	imageStore(Images[Push.OutHistory], Pixel, vec4(A.Mean, Sigma, A.Frames, WindowMean));
#else
	imageStore(Images[Push.OutHistory], Pixel, vec4(A.Mean, A.Frames));
	imageStore(Images[Push.OutMoments], Pixel, vec4(Sigma, WindowMean, 0.0, 0.0));
#endif
}

void main()
{
	FViewConstants View = FViewRef(Push.Pass.View).Data;
	ivec2 Size = ivec2(View.Width, View.Height);
	LoadTile(Size);
	barrier();
	FindNoises();
	SumRows();
	barrier();
	ivec2 Pixel = ivec2(gl_GlobalInvocationID.xy);
	if (any(greaterThanEqual(Pixel, Size))) { return; }
	FSurface Surface = LoadSurface(Push.Surface, Pixel);
	if (Surface.Distance <= 0.0) // the sky: the signal as it is
	{
		FSignal Value = GetSignal(texelFetch(Textures[Push.Signal], Pixel, 0));
		Value = IsSignalFinite(Value) ? clamp(Value, FSignal(0.0), FSignal(MaxHalf)) : FSignal(0.0);
		Store(Pixel, FAccumulated(Value, 0.0, 0.0, 0.0, 0.0, 0.0, false), 0.0, 0.0);
		return;
	}
	int Own = (int(gl_LocalInvocationID.y) + Radius + 1) * Side + int(gl_LocalInvocationID.x) + Radius + 1;
	FWindow Window = SumColumns();
	Store(Pixel, Accumulate(LoadHistory(View, uvec2(Pixel), Surface, Window), Values[Own], Depths[Own] > 0.0, Window), Window.Extent, Window.Noise);
}
