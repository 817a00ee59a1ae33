// What glass and water show of other pixels of the picture: a place, and a weight. A pixel has two such looks, one by reflection and one by
// what bends light. Where a ray meets a surface that the picture shows, the picture is as sharp and as free of noise as it is there.
//
// Each is two words of a texel: the place in the picture as 2 × unorm16, and the weight as Library/Rgbe.glsl packs it; a weight of 0 is none.
// Rough surfaces spread what they show. The alpha of Light is the spread of the first look, and that of Transmittance that of the second.
// The includer declares nothing: these are plain functions, also for an engine's own shaders.
#ifndef LANTERN_TRANSMISSION_LOOKS_GLSL
#define LANTERN_TRANSMISSION_LOOKS_GLSL

#include "../Library/Rgbe.glsl"

struct FLook
{
	vec2 Place;  // in the picture, 0 to 1
	vec3 Weight; // of its radiance
};

// How far a rough surface spreads a look: the scale of its GGX lobe, over the picture's height.
float PackSpread(float Spread) { return sqrt(clamp(Spread, 0.0, 1.0)); }
float UnpackSpread(float Packed) { return Packed * Packed; }

// Returns where a tap of a spread look lies, over the picture's height. Number: of Count; Turn: 0 to 1, of the pixel. Taps are as dense as the
// lobe, so that all weigh the same: tan² θ = α² u / (1 − u) (Walter et al. 2007), on a spiral (Vogel 1979).
vec2 SpreadTap(float Spread, uint Number, uint Count, float Turn)
{
	const float MostU = 0.95, GoldenAngle = 2.39996323;
	float U = MostU * (float(Number) + 0.5) / float(Count), Angle = GoldenAngle * float(Number) + 6.28318531 * Turn;
	return Spread * sqrt(U / (1.0 - U)) * vec2(cos(Angle), sin(Angle));
}

uvec2 PackLook(FLook Look) { return uvec2(packUnorm2x16(Look.Place), PackRgbe(Look.Weight, vec3(0.5))); }
FLook UnpackLook(uvec2 Packed) { return FLook(unpackUnorm2x16(Packed.x), UnpackRgbe(Packed.y)); }

#endif
