// The glTF 2.0 material model (Khronos, glTF 2.0 specification, appendix B): a Lambert base under a dielectric
// GGX layer, mixed with a metal by metalness. Masking is height-correlated Smith (Heitz 2014), with α = roughness².
// Naming: V points to the viewer, L to the light, H is their half vector. All are in the local frame whose +z is
// the shading normal. U holds uniform random numbers in [0, 1). "Pdf" is a probability density over solid angle.
#ifndef LANTERN_BRDF_GLSL
#define LANTERN_BRDF_GLSL

#include "Math.glsl"

// Places in a volume, or in the air, scatter light.
#ifdef HAS_SCATTERING
#define HAS_PHASE
#endif
#ifdef HAS_PHASE
#include "Phase.glsl"
#endif

// Hits or pixels may show light from behind.
#if defined(HAS_DIFFUSE_TRANSMISSION) || defined(BACK_PIXELS)
#define HAS_BACK_LOBE
#endif

struct FBrdf
{
	vec3 BaseColor;
	float Metallic;
	float Alpha;    // roughness²
	float F0;       // reflectance of the dielectric at normal incidence
	float Specular; // weight of the dielectric layer
	float Diffuse;  // weight of the Lambert base: 1, less what leaves on the other side, or 0 for the specular lobe alone
#ifdef HAS_BACK_LOBE
	vec3 BackAlbedo; // of the base, for light that arrives on the other side and leaves on V's: a Lambert lobe about −z
#endif
#ifdef HAS_PHASE
	bool bPhase; // a place within a volume, where light is scattered evenly or by Anisotropy, and no surface
	float Anisotropy;
#endif
};

bool IsPhase(FBrdf Brdf)
{
#ifdef HAS_PHASE
	return Brdf.bPhase;
#else
	return false;
#endif
}

// HAS_DIFFUSE_TRANSMISSION: some surfaces that rays meet scatter light through to their other side. NO_BACK_LOBE: planted fault
// (r.RT.Debug.DiffuseTransmission): what leaves there is lost.
vec3 GetBackAlbedo(FBrdf Brdf)
{
#if defined(HAS_BACK_LOBE) && !defined(NO_BACK_LOBE)
	return Brdf.BackAlbedo;
#else
	return vec3(0.0);
#endif
}
bool HasBack(FBrdf Brdf) { return GetBackAlbedo(Brdf) != vec3(0.0); }

// A lobe with a smaller Alpha is treated as a delta (a perfect mirror), since fp32 cannot resolve it.
const float MinAlpha = 1.0e-3;

bool IsMirror(FBrdf Brdf) { return Brdf.Alpha < MinAlpha; }

float SchlickWeight(float CosTheta)
{
	float Base = clamp(1.0 - CosTheta, 0.0, 1.0);
	return (Base * Base) * (Base * Base) * Base;
}

float DielectricFresnel(FBrdf Brdf, float VdotH) { return Brdf.Specular * mix(Brdf.F0, 1.0, SchlickWeight(VdotH)); }

// Returns what a thin sheet reflects, with all that goes to and fro within it. R: of each of its interfaces.
float SheetReflectance(float R)
{
#ifdef ONE_INTERFACE // r.RT.Debug.Transmission.Sheet
	return R;
#else
	return 2.0 * R / (1.0 + R);
#endif
}

// Returns the Fresnel reflectance of the whole specular lobe, metal and dielectric.
vec3 SpecularFresnel(FBrdf Brdf, float VdotH)
{
	vec3 Metal = mix(Brdf.BaseColor, vec3(1.0), SchlickWeight(VdotH));
	return mix(vec3(DielectricFresnel(Brdf, VdotH)), Metal, Brdf.Metallic);
}

vec3 DiffuseAlbedo(FBrdf Brdf) { return Brdf.BaseColor * ((1.0 - Brdf.Metallic) * Brdf.Diffuse); }

FBrdf MakeLambert(vec3 Albedo)
{
	FBrdf Brdf;
	Brdf.BaseColor = Albedo;
	Brdf.Metallic = Brdf.F0 = Brdf.Specular = 0.0;
	Brdf.Alpha = Brdf.Diffuse = 1.0;
#ifdef HAS_BACK_LOBE
	Brdf.BackAlbedo = vec3(0.0);
#endif
#ifdef HAS_PHASE
	Brdf.bPhase = false;
#endif
	return Brdf;
}

#ifdef HAS_PHASE
FBrdf MakePhase(float Anisotropy)
{
	FBrdf Brdf = MakeLambert(vec3(0.0));
	Brdf.bPhase = true;
	Brdf.Anisotropy = Anisotropy;
	return Brdf;
}
#endif

// Makes a white Lambert surface, which reflects irradiance / π.
FBrdf MakeWhiteLambert() { return MakeLambert(vec3(1.0)); }

// What leaves on the side of its arrival alone.
FBrdf MakeFrontLobes(FBrdf Brdf)
{
#ifdef HAS_BACK_LOBE
	Brdf.BackAlbedo = vec3(0.0);
#endif
	return Brdf;
}

// Removes the diffuse lobe.
FBrdf MakeSpecularLobe(FBrdf Brdf)
{
	Brdf.Diffuse = 0.0;
	return MakeFrontLobes(Brdf);
}

// Bends a shading normal that faces away from the viewer back to grazing.
vec3 BendNormal(vec3 N, vec3 V)
{
	float NdotV = dot(N, V);
	return NdotV < 1.0e-3 ? normalize(N + V * (1.0e-3 - NdotV)) : N;
}

float GgxDistribution(float NdotH, float Alpha)
{
	float AlphaSquared = Alpha * Alpha;
	// The form 1 − n·h² would cancel near the peak of a narrow lobe.
	float D = (NdotH * AlphaSquared - NdotH) * NdotH + 1.0;
	return AlphaSquared / (Pi * D * D);
}

// Returns G2 / (4 n·l n·v), height-correlated.
float SmithVisibility(float NdotL, float NdotV, float Alpha)
{
	float AlphaSquared = Alpha * Alpha;
	float L = NdotV * sqrt(NdotL * NdotL * (1.0 - AlphaSquared) + AlphaSquared);
	float V = NdotL * sqrt(NdotV * NdotV * (1.0 - AlphaSquared) + AlphaSquared);
	return 0.5 / max(L + V, 1.0e-20);
}

// The share of light that the dielectric layer lets in and out again towards the viewer, if it arrives evenly from all directions. That is the
// mean of 1 − F(V·H) over a cosine-weighted hemisphere of L. The mean of (1 − V·H)⁵ depends on n·v alone and is fitted by a cubic (largest error
// 7e-5).
float LayerTransmittance(FBrdf Brdf, float NdotV)
{
	float Weight = ((-0.025707 * NdotV + 0.075238) * NdotV - 0.077609) * NdotV + 0.02809;
	return 1.0 - Brdf.Specular * mix(Brdf.F0, 1.0, Weight);
}

// Returns the diffuse and the specular part of the BRDF. The result omits the specular lobe of a mirror, which is a delta. What shines through
// from behind is diffuse, and no half vector says how much of it the layer reflects: it takes the mean.
void EvaluateLobes(FBrdf Brdf, vec3 V, vec3 L, out vec3 Diffuse, out vec3 Specular)
{
	Diffuse = Specular = vec3(0.0);
	if (L.z < 0.0 && V.z > 0.0 && HasBack(Brdf)) { Diffuse = GetBackAlbedo(Brdf) * (LayerTransmittance(Brdf, V.z) / Pi); }
	if (L.z <= 0.0 || V.z <= 0.0) { return; }
	vec3 H = V + L;
	float LengthSquared = dot(H, H);
	H = LengthSquared > 1.0e-16 ? H * inversesqrt(LengthSquared) : vec3(0.0, 0.0, 1.0);
	float VdotH = clamp(dot(V, H), 0.0, 1.0);
	Diffuse = DiffuseAlbedo(Brdf) * ((1.0 - DielectricFresnel(Brdf, VdotH)) / Pi);
	if (IsMirror(Brdf)) { return; }
	Specular = SpecularFresnel(Brdf, VdotH) * (GgxDistribution(H.z, Brdf.Alpha) * SmithVisibility(L.z, V.z, Brdf.Alpha));
}

// Returns the BRDF times |n·l|, without the specular lobe of a mirror.
vec3 EvaluateBrdfCos(FBrdf Brdf, vec3 V, vec3 L)
{
#ifdef HAS_PHASE
	if (Brdf.bPhase) { return vec3(PhaseFunction(-dot(V, L), Brdf.Anisotropy)); }
#endif
	vec3 Diffuse, Specular;
	EvaluateLobes(Brdf, V, L, Diffuse, Specular);
	return (Diffuse + Specular) * abs(L.z);
}

// Samples GGX visible normals with spherical caps (Dupuy & Benyoub 2023). The cap is bounded to normals that reflect upwards
// (Eto & Tokuyoshi 2023, "Bounded VNDF Sampling for Smith–GGX Reflections"); this is that paper's factor k.
float BoundedVndfK(vec3 V, float Alpha)
{
	float S = 1.0 + length(V.xy);
	float AlphaSquared = Alpha * Alpha, S2 = S * S;
	return (1.0 - AlphaSquared) * S2 / (S2 + AlphaSquared * V.z * V.z);
}

vec3 SampleGgxHalfVector(vec3 V, float Alpha, vec2 U)
{
	vec3 Stretched = normalize(vec3(V.xy * Alpha, V.z));
	float Phi = 2.0 * Pi * U.x;
	float CapBottom = BoundedVndfK(V, Alpha) * Stretched.z;
	float Z = fma(1.0 - U.y, 1.0 + CapBottom, -CapBottom);
	float Sin = sqrt(clamp(1.0 - Z * Z, 0.0, 1.0));
	vec3 H = vec3(Sin * cos(Phi), Sin * sin(Phi), Z) + Stretched;
	return normalize(vec3(H.xy * Alpha, max(H.z, 1.0e-9)));
}

// Returns the pdf of the direction that V is reflected to about a sampled half vector H.
float GgxPdf(vec3 V, vec3 H, float Alpha)
{
	vec2 StretchedXY = Alpha * V.xy;
	float LengthSquared = dot(StretchedXY, StretchedXY);
	float T = sqrt(LengthSquared + V.z * V.z);
	return GgxDistribution(H.z, Alpha) / (2.0 * (BoundedVndfK(V, Alpha) * V.z + T));
}

// Returns the probability of sampling the specular lobe, from the luminance that each lobe reflects at this angle.
float SpecularProbability(FBrdf Brdf, vec3 V)
{
	float Specular = Luminance(SpecularFresnel(Brdf, V.z));
	float Diffuse = Luminance(DiffuseAlbedo(Brdf) + GetBackAlbedo(Brdf)) * (1.0 - DielectricFresnel(Brdf, V.z));
	if (Specular <= 0.0) { return 0.0; }
	if (Diffuse <= 0.0) { return 1.0; }
	return clamp(Specular / (Specular + Diffuse), 0.1, 0.9);
}

// Returns the chance that what is not specular is light from behind.
float BackProbability(FBrdf Brdf)
{
	float Front = Luminance(DiffuseAlbedo(Brdf)), Back = Luminance(GetBackAlbedo(Brdf));
	return Back > 0.0 ? Back / (Front + Back) : 0.0;
}

// Returns the pdf with which SampleBrdf samples L. It omits the delta of a mirror.
float BrdfPdf(FBrdf Brdf, vec3 V, vec3 L)
{
#ifdef HAS_PHASE
	if (Brdf.bPhase) { return PhaseFunction(-dot(V, L), Brdf.Anisotropy); }
#endif
	if (L.z == 0.0 || V.z <= 0.0 || (L.z < 0.0 && !HasBack(Brdf))) { return 0.0; }
	float SpecularChance = SpecularProbability(Brdf, V), BackChance = BackProbability(Brdf);
	float Pdf = (1.0 - SpecularChance) * (L.z < 0.0 ? BackChance : 1.0 - BackChance) * abs(L.z) / Pi;
	if (L.z < 0.0) { return Pdf; }
	if (SpecularChance > 0.0 && !IsMirror(Brdf)) { Pdf += SpecularChance * GgxPdf(V, normalize(V + L), Brdf.Alpha); }
	return Pdf;
}

// Returns the directional albedo of the base layer: the share of irradiance / π that it sends towards the viewer if the incident light is
// uniform, of both sides.
vec3 DiffuseReflectance(FBrdf Brdf, float NdotV) { return (DiffuseAlbedo(Brdf) + GetBackAlbedo(Brdf)) * LayerTransmittance(Brdf, NdotV); }

// Returns the share that a side's light has in what the surface sends, over DiffuseReflectance.
vec3 ShareOfSide(FBrdf Brdf, bool bBack)
{
	vec3 Front = DiffuseAlbedo(Brdf), Back = GetBackAlbedo(Brdf), Whole = Front + Back;
	vec3 Share = Back / max(Whole, vec3(1.0e-6));
	return bBack ? Share : vec3(1.0) - Share;
}

// Returns the directional albedo of the specular lobe. x is the albedo with F = 1 everywhere. y uses
// Schlick's (1 − V·H)⁵ in place of F, which is the part that F90 weighs.
//
// These are rational functions of N·V and roughness, fitted to sums over visible normals (Heitz 2018) at 2,000 points. The
// fit is linear least squares with the denominator of the previous iteration (Sanathanan and Koerner 1963). It is followed
// by Levenberg-Marquardt with weights that follow the error, which lowers the largest error.
// For F0 from 0.04 to 1, N·V and roughness from 0.05 to 1, the reflectance is off by at most 1.7 %. The error is at most 2.3 %
// for mirrors, and 12 % nearer to grazing.
vec2 SpecularAlbedo(float NdotV, float Roughness)
{
	float X = NdotV, S = sqrt(NdotV), Y = Roughness;
	float LossNumerator = 0.324209 + Y * (0.314086 * Y - 0.341756) + X * (3.7826 + 19.138 * Y - 5.01642 * X);
	float LossDenominator = 1.0 + Y * (-10.4645 + Y * (37.0926 - 19.1813 * Y)) +
	                   X * (-2.60585 + Y * (-24.5752 + Y * (105.267 - 53.7577 * Y)) + X * (108.714 + Y * (125.498 * Y - 240.747)));
	float GrazingNumerator = 1.10756 + Y * (-0.288161 - 0.0524491 * Y) + S * (-1.8583 + 0.480398 * Y + 0.680239 * S);
	float GrazingDenominator = 1.0 + Y * (1.99652 + Y * (12.3659 - 0.898989 * Y)) +
	                   S * (-1.12204 + Y * (-15.3701 + Y * (26.4931 * Y - 8.94885)) + S * (1.6254 + Y * (20.9912 - 31.6698 * Y)));
	float Albedo = 1.0 - Y * Y * LossNumerator / LossDenominator;
	return vec2(Albedo, min((1.0 - X) * (1.0 - X) * GrazingNumerator / GrazingDenominator, Albedo));
}

// Returns the directional albedo of the specular lobe with its Fresnel term. F90 is the specular weight for dielectrics and
// 1 for metals.
vec3 SpecularReflectance(FBrdf Brdf, float NdotV, float Roughness)
{
	vec2 Albedo = SpecularAlbedo(clamp(NdotV, 0.0, 1.0), Roughness);
	float Dielectric = Brdf.Specular * mix(Albedo.y, Albedo.x, Brdf.F0);
	vec3 Metal = mix(vec3(Albedo.y), vec3(Albedo.x), Brdf.BaseColor);
	return mix(vec3(Dielectric), Metal, Brdf.Metallic);
}

#endif
