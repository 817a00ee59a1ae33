// How a host's fog reads the atlas. An engine's shader may do the same with FRTModuleFog.
#ifndef LANTERN_FOG_ATLAS_GLSL
#define LANTERN_FOG_ATLAS_GLSL

#include "Froxels.glsl"

// Returns the light of local lights (xyz) and the sun's visibility (w) at a pixel, without jitter, and a distance along the view
// axis, metres. Surface: distance of what the pixel shows; slices behind it are not read. NO_TEXTURE: no local light, and an unshadowed sun.
vec4 SampleFog(FFogGrid Grid, uint Visibility, uint Light, vec2 Pixel, float Distance, float Surface)
{
	ivec3 Last = ivec3(Grid.Columns, Grid.Rows, min(uint(FroxelSlice(Grid, min(Surface, Grid.Distance))) + 1u, Grid.Slices)) - 1;
	vec3 Place = vec3(Pixel / float(Grid.PixelSize), FroxelSlice(Grid, Distance)) - 0.5, Fraction = fract(Place);
	vec4 Sum = vec4(0.0);
	[[dont_unroll]] for (int Tap = 0; Tap < 8; ++Tap)
	{
		ivec3 Corner = ivec3(Tap & 1, (Tap >> 1) & 1, Tap >> 2);
		vec3 W = mix(1.0 - Fraction, Fraction, bvec3(Corner));
		ivec2 Texel = FroxelTexel(Grid, clamp(ivec3(floor(Place)) + Corner, ivec3(0), Last));
		vec4 Value = vec4(0.0, 0.0, 0.0, 1.0);
		if (Light != NO_TEXTURE) { Value.xyz = texelFetch(Textures[Light], Texel, 0).xyz; }
		if (Visibility != NO_TEXTURE) { Value.w = texelFetch(Textures[Visibility], Texel, 0).x; }
		Sum += Value * (W.x * W.y * W.z);
	}
	return Sum;
}

#endif
