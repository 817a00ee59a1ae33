// Volumes that light shines through: what they take from it, and what they scatter. HAS_SCATTERING: some scatter.
#ifndef LANTERN_VOLUMES_GLSL
#define LANTERN_VOLUMES_GLSL

#include "../Library/Phase.glsl"

struct FVolume
{
	vec3 Extinction; // FMaterialData::Extinction; 0: air, or nothing is known of it
#ifdef HAS_SCATTERING
	vec3 Albedo;
	float Anisotropy;
#endif
};

FVolume Air()
{
	FVolume Volume;
	Volume.Extinction = vec3(0.0);
#ifdef HAS_SCATTERING
	Volume.Albedo = vec3(0.0);
	Volume.Anisotropy = 0.0;
#endif
	return Volume;
}

// Returns the volume behind the surface of one: within its material, whichever side a ray has met.
FVolume VolumeOf(FSceneConstants Scene, FMaterialHit Hit)
{
	FVolume Volume = Air();
	if ((Hit.Flags & HIT_SOLID) == 0u) { return Volume; }
	FMaterialRef Materials = FMaterialRef(Scene.Materials);
	Volume.Extinction = Materials.Data[Hit.Material].Extinction;
#ifdef HAS_SCATTERING
	Volume.Albedo = Materials.Data[Hit.Material].ScatterAlbedo;
	Volume.Anisotropy = clamp(Materials.Data[Hit.Material].ScatterAnisotropy, -0.99, 0.99);
#endif
	return Volume;
}

bool IsAir(FVolume Volume) { return Volume.Extinction == vec3(0.0); }

// Returns by how much a volume dims light for each metre straight down. Light that is scattered forward goes on, and half of the rest does.
// A fit to simulated layers of water of 0.1 to 10 mean free paths, off by up to a fifth of the exponent.
vec3 DownwardExtinction(FVolume Volume)
{
#ifdef HAS_SCATTERING
	vec3 Absorbed = 1.0 - Volume.Albedo;
	return Volume.Extinction * (Absorbed + Volume.Albedo * (1.0 - Volume.Anisotropy) * (0.27 + 0.75 * Absorbed));
#else
	return Volume.Extinction;
#endif
}

#ifdef HAS_SCATTERING
// Returns by how much a volume dims what is seen in it, for each metre. What is scattered forward is still seen, in about its place: the blur
// is left out. Where much is scattered, so is more of the light that was turned once. A fit, as DownwardExtinction.
vec3 SeenExtinction(FVolume Volume) { return mix(Volume.Extinction, DownwardExtinction(Volume), smoothstep(0.2, 0.9, Volume.Albedo)); }

bool Scatters(FVolume Volume) { return Volume.Extinction * Volume.Albedo != vec3(0.0); }

// A surface of water, and a ray that goes down from there.
struct FWaterRay
{
	vec3 Depth;  // optical, of the ray up to what lies below
	float Slope; // cosine of its angle against the surface's normal
	float Index; // refractive, against the air
};

// Returns what a ray gathers of light that arrives on the surface from one direction, over its irradiance there. Cosine: of that direction
// below the surface, against its normal. Phase: cosine of the angle between the ray and the direction to the light.
//
// Light that is scattered once is exact but for the surface: what is scattered forward counts as if it went on. That is the similarity of
// volumes of another anisotropy, with the phase function of the first (Nakajima & Tanaka 1988). Light that is scattered more often is even, and
// a fit to simulated layers of water over a black bed. The sum is within 13 % RMS of these ("Water that scatters", Docs/Performance.md).
vec3 GatherScattered(FVolume Volume, FWaterRay Ray, float Cosine, float Phase)
{
	vec3 Kept = 1.0 - Volume.Albedo * Volume.Anisotropy; // of the extinction
	vec3 Depth = Ray.Depth * Kept, Albedo = Volume.Albedo / Kept, Even = Albedo * (1.0 - Volume.Anisotropy);
#ifdef NO_SCATTERED_DEPTH // r.RT.Debug.Transmission.Scattering
	float Way = 0.0;
#else
	float Way = Ray.Slope / Cosine; // of the light, over that of the ray
#endif
	vec3 Once = (1.0 - exp(-Depth * (1.0 + Way))) / (Cosine * (1.0 + Way));
	vec3 Power = Even * Even * Even;
	Power *= Power;
	vec3 Again = Even * (0.81 + 0.09 * Power) * (1.0 - exp(-(2.05 - 0.5 * Power) * pow(Depth * Ray.Slope, vec3(0.75))));
	float Turned = PhaseFunction(Phase, Volume.Anisotropy);
	vec3 Sources = Albedo * Turned + Even * (Again / (1.0 - Again) * (1.0 + 0.3 * Volume.Anisotropy) / (4.0 * Pi));
	return Once * Sources / (Ray.Index * Ray.Index);
}
#endif

#endif
