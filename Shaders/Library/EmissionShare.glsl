// Who counts emissive triangles that a surface sees directly, so that nothing is counted twice (EMISSIVE_IS_DIRECT): light sampling
// all that the diffuse lobe reflects, and reflections a share of what the specular lobe does.
#ifndef LANTERN_EMISSION_SHARE_GLSL
#define LANTERN_EMISSION_SHARE_GLSL

// Returns the share of reflections; the rest is that of light sampling. ReflectedRoughness: rougher surfaces have none traced.
// Narrow lobes find emitters by their own ray, wide ones by light sampling.
float EmissionOfRays(float Roughness, float ReflectedRoughness)
{
	return Roughness <= ReflectedRoughness ? 1.0 - smoothstep(0.2, 0.3, Roughness) : 0.0;
}

// HAS_LIGHT_EMISSION: some materials light otherwise than they look. Cameras see what they look like, and so does the share of a specular
// lobe that is left to rays, as long as a path from the camera has met nothing else. All other light is FMaterialData::LightEmissive.
#define SHOWS_NOTHING 0u  // the path has met what is no mirror
#define SHOWS_MIRRORED 1u // the share that the surface mirrors
#define SHOWS_ALL 2u

#endif
