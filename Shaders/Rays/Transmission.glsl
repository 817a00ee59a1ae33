// How light passes surfaces that it shines through: thin sheets, and the surfaces of volumes. The model is that of
// KHR_materials_transmission and KHR_materials_volume: under the dielectric layer, a share of the base is a lobe that transmits.
// Rough surfaces of volumes follow Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces".
// PathTracing.glsl includes it if HAS_TRANSMISSION is defined.
#ifndef LANTERN_TRANSMISSION_GLSL
#define LANTERN_TRANSMISSION_GLSL

#include "Volumes.glsl"

const uint MostPassages = 16u; // surfaces of this kind on a path; one that is caught between more ends

// Whether the hit is one of a surface that covers a share of its place, and leaves the rest as it is.
bool IsBlended(FMaterialHit Hit) { return (Hit.Flags & HIT_BLENDED) != 0u; }

// Whether it covers nothing there.
bool IsClear(FMaterialHit Hit) { return IsBlended(Hit) && Hit.Transmission > LeastSolidOpacity; }

// The share of light that meets a mere interface, and neither base colour nor metal; of a blended surface, that meets nothing.
float InterfaceShare(FMaterialHit Hit) { return IsBlended(Hit) ? Hit.Transmission : Hit.Transmission * (1.0 - Hit.Metallic); }

// What an interface leaves of light that passes.
vec3 InterfaceTint(FMaterialHit Hit) { return IsBlended(Hit) ? vec3(1.0) : Hit.BaseColor; }

// Whether light that passes a sheet goes straight on.
bool PassesStraight(FMaterialHit Hit) { return IsBlended(Hit) || Hit.Roughness * Hit.Roughness < MinAlpha; }

// Refractive index of a dielectric of F0, against the air.
float IndexOf(float F0)
{
	float Root = min(sqrt(F0), 0.99);
	return (1.0 + Root) / (1.0 - Root);
}

// Reflectance of the interface, or of a sheet with all that goes to and fro within: 2R / (1 + R). Cosine: of the angle of incidence.
// Eta: index on the side of the ray over that behind.
float InterfaceReflectance(FMaterialHit Hit, float Cosine, float Eta)
{
	if (IsBlended(Hit)) { return 0.0; }
	if ((Hit.Flags & HIT_SOLID) == 0u)
	{
		return SheetReflectance(Hit.Specular * mix(Hit.F0, 1.0, SchlickWeight(Cosine)));
	}
	float SineSquared = Eta * Eta * (1.0 - Cosine * Cosine); // of the angle behind
	if (SineSquared >= 1.0) { return 1.0; }
	// Schlick's angle is that in the thinner medium.
	return Hit.Specular * mix(Hit.F0, 1.0, SchlickWeight(Eta > 1.0 ? sqrt(1.0 - SineSquared) : Cosine));
}

float EtaOf(FMaterialHit Hit)
{
	float Index = IndexOf(Hit.F0);
	return (Hit.Flags & HIT_INSIDE) != 0u ? Index : 1.0 / Index;
}

// Whether light is found from a place within a volume, where it is scattered. The thread sets it before.
bool bScattersThere = false;
FVolume PlaceVolume = Air(); // that rays to lights start in, if it is known; of TINTED_SHADOWS. The thread sets it before

// What remains of light along a ray that goes straight on through a hit. From: distance from the last such surface.
//
// Light bends as it enters a volume, whose surface counts as flat: its way within is shorter than the ray's. It is within a cone then. Rays
// leave through that cone alone, so the eye sees 1 / index² of it, and the rest is reflected within.
vec3 StraightTransmittance(FSceneConstants Scene, FMaterialHit Hit, vec3 Direction, float From)
{
	float Cosine = min(abs(dot(Hit.Normal, Direction)), 1.0);
	bool bSolid = (Hit.Flags & HIT_SOLID) != 0u;
	float R = bSolid ? Hit.Specular * mix(Hit.F0, 1.0, SchlickWeight(Cosine)) : InterfaceReflectance(Hit, Cosine, 1.0);
	vec3 T = InterfaceTint(Hit) * (InterfaceShare(Hit) * (1.0 - R));
	if (!bSolid) { return T; }
	float Index = IndexOf(Hit.F0);
	if ((Hit.Flags & HIT_INSIDE) == 0u) { return T * Index * Index; }
	float Bent = sqrt(max(1.0 - (1.0 - Cosine * Cosine) / (Index * Index), 1.0e-4));
	T *= exp(-VolumeOf(Scene, Hit).Extinction * From * Cosine / Bent) / (Index * Index);
	return bScattersThere ? T * Cosine / Bent : T; // which lies in no surface, and has no cosine
}

struct FPassage
{
	vec3 Direction; // world
	vec3 Weight;    // 0: absorbed
	bool bThrough;  // else reflected
};

float SmithLambda(float Cosine, float Alpha)
{
	float Squared = max(Cosine * Cosine, 1.0e-12);
	return 0.5 * (sqrt(1.0 + Alpha * Alpha * (1.0 - Squared) / Squared) - 1.0);
}

// Samples GGX visible normals of all of the hemisphere (Dupuy & Benyoub 2023): those that transmit need not reflect upwards.
vec3 SampleVisibleNormal(vec3 V, float Alpha, vec2 U)
{
	vec3 Stretched = normalize(vec3(V.xy * Alpha, V.z));
	float Phi = 2.0 * Pi * U.x, Z = fma(1.0 - U.y, 1.0 + Stretched.z, -Stretched.z);
	vec3 H = vec3(sqrt(clamp(1.0 - Z * Z, 0.0, 1.0)) * vec2(cos(Phi), sin(Phi)), Z) + Stretched;
	return normalize(vec3(H.xy * Alpha, max(H.z, 1.0e-9)));
}

// Chooses where a path goes on from an interface. V: towards where it comes from, local to Basis. U: z chooses between both sides.
FPassage SamplePassage(FMaterialHit Hit, mat3 Basis, vec3 V, vec3 U)
{
	FPassage Passage;
	float Alpha = Hit.Roughness * Hit.Roughness;
#ifdef LIKELIEST_PASSAGE
	const bool bSmooth = true; // what is rough spreads what it shows
#else
	bool bSmooth = PassesStraight(Hit);
#endif
	bool bSolid = (Hit.Flags & HIT_SOLID) != 0u;
	vec3 H = bSmooth ? vec3(0.0, 0.0, 1.0) : SampleVisibleNormal(V, Alpha, U.xy);
	float Cosine = clamp(dot(V, H), 0.0, 1.0), Eta = EtaOf(Hit);
	Passage.bThrough = U.z >= InterfaceReflectance(Hit, Cosine, Eta);
	vec3 Local = reflect(-V, H);
	if (Passage.bThrough) { Local = bSolid ? refract(-V, H, Eta) : vec3(Local.xy, -Local.z); }
	if (Passage.bThrough && !bSolid && bSmooth) { Local = -V; } // exactly straight on
	Passage.Weight = Passage.bThrough ? InterfaceTint(Hit) : vec3(1.0);
	if (!bSmooth)
	{
		float Before = SmithLambda(V.z, Alpha), Behind = SmithLambda(Local.z, Alpha);
		// On the same side masking is correlated with height, as that of reflections is (Heitz 2014).
		Passage.Weight *= Passage.bThrough && bSolid ? 1.0 / (1.0 + Behind) : (1.0 + Before) / (1.0 + Before + Behind);
	}
	Passage.Direction = Basis * Local;
	bool bBelow = dot(Passage.Direction, Hit.GeometricNormal) < 0.0;
	if (bBelow != Passage.bThrough || (Local.z < 0.0) != Passage.bThrough) { Passage.Weight = vec3(0.0); }
	return Passage;
}

#endif
