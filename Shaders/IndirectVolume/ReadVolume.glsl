// How a host's fog, particles and translucent surfaces read indirect light in the air. An engine's shader may do the same with
// FRTModuleIndirectVolume.
#ifndef LANTERN_READ_VOLUME_GLSL
#define LANTERN_READ_VOLUME_GLSL

#include "../Fog/Froxels.glsl"

// Light at a place, as a constant and a linear part over directions: L(ω) = Mean + 3 Moment · ω, the latter by luminance.
struct FAirLight
{
	vec3 Mean;   // of radiance over all directions, nits
	vec3 Moment; // mean of luminance times direction
};

// Light, Moment: sampled indices. Pixel: without jitter. Distance: along the view axis, metres. Surface: that of what the pixel shows; slices
// behind it are not read.
FAirLight SampleIndirectVolume(FFogGrid Grid, uint Light, uint Moment, vec2 Pixel, float Distance, float Surface)
{
	FFroxelTaps Taps = FindFroxelTaps(Grid, Pixel, Distance, Surface);
	FAirLight Sum = FAirLight(vec3(0.0), vec3(0.0));
	[[dont_unroll]] for (int Tap = 0; Tap < 8; ++Tap)
	{
		float Weight;
		ivec2 Texel = TapTexel(Grid, Taps, Tap, Weight);
		Sum.Mean += Weight * texelFetch(Textures[Light], Texel, 0).xyz;
		Sum.Moment += Weight * texelFetch(Textures[Moment], Texel, 0).xyz;
	}
	return Sum;
}

// Returns the colour of light by how much its luminance comes from a side. Side: 3 Moment · ω for one direction, and less for lobes.
vec3 TurnLight(FAirLight Air, float Side)
{
	float Brightness = dot(Air.Mean, vec3(0.2126, 0.7152, 0.0722));
	return Brightness > 0.0 ? Air.Mean * max(1.0 + Side / Brightness, 0.0) : vec3(0.0);
}

// Returns the irradiance over π on a surface with a normal.
vec3 AirIrradiance(FAirLight Air, vec3 Normal) { return TurnLight(Air, 2.0 * dot(Air.Moment, Normal)); }

// Returns the radiance that fog scatters towards the camera, over its scattering coefficient. Direction: of the camera's ray. G: of Henyey and
// Greenstein (1941), whose linear part it is.
vec3 AirScattered(FAirLight Air, vec3 Direction, float G) { return TurnLight(Air, 3.0 * G * dot(Air.Moment, Direction)); }

#endif
