// Tone mapping and the sRGB transfer function.
#ifndef LANTERN_TONE_MAP_GLSL
#define LANTERN_TONE_MAP_GLSL

// Applies a fit of the ACES curve (Narkowicz 2015, "ACES Filmic Tone Mapping Curve").
vec3 ToneMapFilmic(vec3 X)
{
	X = clamp(X, vec3(0.0), vec3(65504.0)); // squares must stay finite
	return clamp((X * (2.51 * X + 0.03)) / (X * (2.43 * X + 0.59) + 0.14), 0.0, 1.0);
}

// Encodes with the sRGB transfer function (IEC 61966-2-1).
vec3 LinearToSrgb(vec3 C) { return mix(1.055 * pow(C, vec3(1.0 / 2.4)) - 0.055, 12.92 * C, lessThanEqual(C, vec3(0.0031308))); }

#endif
