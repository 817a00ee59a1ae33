// How a host's fog reads the atlas. An engine's shader may do the same with FRTModuleFog.
#ifndef LANTERN_FOG_ATLAS_GLSL
#define LANTERN_FOG_ATLAS_GLSL

#include "Froxels.glsl"

// Returns the light of local lights (xyz) and the sun's visibility (w) at a pixel, without jitter, and a distance along the view
// axis, metres. Surface: distance of what the pixel shows; slices behind it are not read. NO_TEXTURE: no local light, and an unshadowed sun.
vec4 SampleFog(FFogGrid Grid, uint Visibility, uint Light, vec2 Pixel, float Distance, float Surface)
{
	FFroxelTaps Taps = FindFroxelTaps(Grid, Pixel, Distance, Surface);
	vec4 Sum = vec4(0.0);
	[[dont_unroll]] for (int Tap = 0; Tap < 8; ++Tap)
	{
		float Weight;
		ivec2 Texel = TapTexel(Grid, Taps, Tap, Weight);
		vec4 Value = vec4(0.0, 0.0, 0.0, 1.0);
		if (Light != NO_TEXTURE) { Value.xyz = texelFetch(Textures[Light], Texel, 0).xyz; }
		if (Visibility != NO_TEXTURE) { Value.w = texelFetch(Textures[Visibility], Texel, 0).x; }
		Sum += Value * Weight;
	}
	return Sum;
}

#endif
