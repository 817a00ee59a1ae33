// Type of the signal that is filtered. CHANNELS is 1 (visibility, 0 to 1) or 3 (a colour, 0 or more).
#ifndef LANTERN_DENOISE_SIGNAL_GLSL
#define LANTERN_DENOISE_SIGNAL_GLSL

#include "../Library/History.glsl"

const float MaxHalf = 65504.0; // the largest number of a half float

// GetVariance, WithVariance: texels that hold a mean beside the variance of its brightness.
#if CHANNELS == 1
#define FSignal float
FSignal GetSignal(vec4 V) { return V.x; }
float GetVariance(vec4 V) { return V.y; }
vec4 WithVariance(FSignal S, float Variance) { return vec4(S, Variance, 0.0, 0.0); }
float GetBrightness(FSignal S) { return S; }
bool IsSignalFinite(FSignal S) { return IsFinite(S); }
#else
#define FSignal vec3
FSignal GetSignal(vec4 V) { return V.xyz; }
float GetVariance(vec4 V) { return V.w; }
vec4 WithVariance(FSignal S, float Variance) { return vec4(S, Variance); }
float GetBrightness(FSignal S) { return Luminance(S); }
bool IsSignalFinite(FSignal S) { return AreFinite(S); }
#endif
FSignal SanitizeSignal(FSignal Value, bool bValid) { return bValid ? clamp(Value, FSignal(0.0), FSignal(MaxHalf)) : FSignal(0.0); }

#endif
