// The glTF 2.0 material model (Khronos, glTF 2.0 specification, appendix B): a Lambert base under a dielectric
// GGX layer, mixed with a metal by metalness. Height-correlated Smith masking (Heitz 2014), α = roughness².
#ifndef LANTERN_BRDF_GLSL
#define LANTERN_BRDF_GLSL

#include "Math.glsl"

struct FBrdf
{
	vec3 BaseColor;
	float Metallic;
	float Alpha;    // roughness²
	float F0;       // of the dielectric
	float Specular; // weight of the dielectric's layer
	float Diffuse;  // weight of the base below it: 1; 0: the specular lobe alone
};

// Below this a lobe is a delta: fp32 cannot resolve it, and a mirror is not a very smooth rough surface.
const float MinAlpha = 1.0e-3;

bool IsMirror(FBrdf B) { return B.Alpha < MinAlpha; }

float SchlickWeight(float CosTheta)
{
	float M = clamp(1.0 - CosTheta, 0.0, 1.0);
	return (M * M) * (M * M) * M;
}

float DielectricFresnel(FBrdf B, float VdotH) { return B.Specular * mix(B.F0, 1.0, SchlickWeight(VdotH)); }

// Fresnel of the whole specular lobe, metal and dielectric.
vec3 SpecularFresnel(FBrdf B, float VdotH)
{
	vec3 Metal = mix(B.BaseColor, vec3(1.0), SchlickWeight(VdotH));
	return mix(vec3(DielectricFresnel(B, VdotH)), Metal, B.Metallic);
}

vec3 DiffuseAlbedo(FBrdf B) { return B.BaseColor * ((1.0 - B.Metallic) * B.Diffuse); }

// A white Lambert: what it reflects is irradiance / π.
FBrdf MakeWhiteLambert() { return FBrdf(vec3(1.0), 0.0, 1.0, 0.0, 0.0, 1.0); }
FBrdf MakeSpecularLobe(FBrdf B)
{
	B.Diffuse = 0.0;
	return B;
}

// A shading normal that faces away from the viewer is bent back to grazing.
vec3 BendNormal(vec3 N, vec3 V)
{
	float NdotV = dot(N, V);
	return NdotV < 1.0e-3 ? normalize(N + V * (1.0e-3 - NdotV)) : N;
}

float GgxDistribution(float NdotH, float Alpha)
{
	float A2 = Alpha * Alpha;
	// 1 − n·h² would cancel near the peak of a narrow lobe.
	float D = (NdotH * A2 - NdotH) * NdotH + 1.0;
	return A2 / (Pi * D * D);
}

// G2 / (4 n·l n·v), height-correlated.
float SmithVisibility(float NdotL, float NdotV, float Alpha)
{
	float A2 = Alpha * Alpha;
	float L = NdotV * sqrt(NdotL * NdotL * (1.0 - A2) + A2);
	float V = NdotL * sqrt(NdotV * NdotV * (1.0 - A2) + A2);
	return 0.5 / max(L + V, 1.0e-20);
}

// f · n·l in the frame where the normal is +z. The specular part of a mirror is a delta and not in it.
vec3 EvaluateBrdfCos(FBrdf B, vec3 V, vec3 L)
{
	if (L.z <= 0.0 || V.z <= 0.0) { return vec3(0.0); }
	vec3 H = V + L;
	float Length2 = dot(H, H);
	H = Length2 > 1.0e-16 ? H * inversesqrt(Length2) : vec3(0.0, 0.0, 1.0);
	float VdotH = clamp(dot(V, H), 0.0, 1.0);
	vec3 Diffuse = DiffuseAlbedo(B) * ((1.0 - DielectricFresnel(B, VdotH)) / Pi);
	vec3 Specular = vec3(0.0);
	if (!IsMirror(B))
	{
		Specular = SpecularFresnel(B, VdotH) * (GgxDistribution(H.z, B.Alpha) * SmithVisibility(L.z, V.z, B.Alpha));
	}
	return (Diffuse + Specular) * L.z;
}

// Visible normals, spherical caps (Dupuy & Benyoub 2023), with the cap bounded by what reflects upwards
// (Eto & Tokuyoshi 2023, "Bounded VNDF Sampling for Smith–GGX Reflections").
float BoundedVndfK(vec3 V, float Alpha)
{
	float S = 1.0 + length(V.xy);
	float A2 = Alpha * Alpha, S2 = S * S;
	return (1.0 - A2) * S2 / (S2 + A2 * V.z * V.z);
}

vec3 SampleGgxHalf(vec3 V, float Alpha, vec2 U)
{
	vec3 Stretched = normalize(vec3(V.xy * Alpha, V.z));
	float Phi = 2.0 * Pi * U.x;
	float Lower = BoundedVndfK(V, Alpha) * Stretched.z;
	float Z = fma(1.0 - U.y, 1.0 + Lower, -Lower);
	float Sin = sqrt(clamp(1.0 - Z * Z, 0.0, 1.0));
	vec3 H = vec3(Sin * cos(Phi), Sin * sin(Phi), Z) + Stretched;
	return normalize(vec3(H.xy * Alpha, max(H.z, 1.0e-9)));
}

// Density of the reflected direction under SampleGgxHalf.
float GgxDensity(vec3 V, vec3 H, float Alpha)
{
	vec2 Av = Alpha * V.xy;
	float Length2 = dot(Av, Av);
	float T = sqrt(Length2 + V.z * V.z);
	return GgxDistribution(H.z, Alpha) / (2.0 * (BoundedVndfK(V, Alpha) * V.z + T));
}

// How often the specular lobe is chosen: by what each lobe reflects at this angle.
float SpecularProbability(FBrdf B, vec3 V)
{
	float Specular = Luminance(SpecularFresnel(B, V.z));
	float Diffuse = Luminance(DiffuseAlbedo(B)) * (1.0 - DielectricFresnel(B, V.z));
	if (Specular <= 0.0) { return 0.0; }
	if (Diffuse <= 0.0) { return 1.0; }
	return clamp(Specular / (Specular + Diffuse), 0.1, 0.9);
}

// Density over solid angle of SampleBrdf for L; without a mirror's delta.
float BrdfDensity(FBrdf B, vec3 V, vec3 L)
{
	if (L.z <= 0.0 || V.z <= 0.0) { return 0.0; }
	float P = SpecularProbability(B, V);
	float Density = (1.0 - P) * L.z / Pi;
	if (P > 0.0 && !IsMirror(B)) { Density += P * GgxDensity(V, normalize(V + L), B.Alpha); }
	return Density;
}

// Means over what arrives at a surface from everywhere alike; for what is known of light as one number.
//
// Of the base layer: what it reflects of irradiance / π. Its part is the mean of 1 − F(V·H) over a cosine-weighted
// hemisphere of L; the mean of (1 − V·H)⁵ is a function of n·v alone, fitted by a cubic (largest error 7e-5).
vec3 DiffuseReflectance(FBrdf B, float NdotV)
{
	float Weight = ((-0.025707 * NdotV + 0.075238) * NdotV - 0.077609) * NdotV + 0.02809;
	return DiffuseAlbedo(B) * (1.0 - B.Specular * mix(B.F0, 1.0, Weight));
}

// Of the specular lobe. x: with F = 1 everywhere; y: with Schlick's (1 − V·H)⁵ instead, the part that F90 weighs.
//
// Quotients of polynomials in N·V and roughness, fitted to sums over visible normals (Heitz 2018) at 2,000 places: linear
// least squares with the denominator of the round before (Sanathanan and Koerner 1963), then Levenberg-Marquardt with weights
// that follow the error, so that the largest one is what falls. What F0 from 0.04 to 1 makes of them is off by at most 1.7 %
// for N·V and roughness from 0.05 to 1, by 2.3 % for mirrors, and by 12 % nearer to grazing.
vec2 SpecularAlbedo(float NdotV, float Roughness)
{
	float X = NdotV, S = sqrt(NdotV), Y = Roughness;
	float LostTop = 0.324209 + Y * (0.314086 * Y - 0.341756) + X * (3.7826 + 19.138 * Y - 5.01642 * X);
	float LostBottom = 1.0 + Y * (-10.4645 + Y * (37.0926 - 19.1813 * Y)) +
	                   X * (-2.60585 + Y * (-24.5752 + Y * (105.267 - 53.7577 * Y)) + X * (108.714 + Y * (125.498 * Y - 240.747)));
	float EdgeTop = 1.10756 + Y * (-0.288161 - 0.0524491 * Y) + S * (-1.8583 + 0.480398 * Y + 0.680239 * S);
	float EdgeBottom = 1.0 + Y * (1.99652 + Y * (12.3659 - 0.898989 * Y)) +
	                   S * (-1.12204 + Y * (-15.3701 + Y * (26.4931 * Y - 8.94885)) + S * (1.6254 + Y * (20.9912 - 31.6698 * Y)));
	float All = 1.0 - Y * Y * LostTop / LostBottom;
	return vec2(All, min((1.0 - X) * (1.0 - X) * EdgeTop / EdgeBottom, All));
}

// F90 is the specular weight for dielectrics and 1 for metals.
vec3 SpecularReflectance(FBrdf B, float NdotV, float Roughness)
{
	vec2 Albedo = SpecularAlbedo(clamp(NdotV, 0.0, 1.0), Roughness);
	float Dielectric = B.Specular * mix(Albedo.y, Albedo.x, B.F0);
	vec3 Metal = mix(vec3(Albedo.y), vec3(Albedo.x), B.BaseColor);
	return mix(vec3(Dielectric), Metal, B.Metallic);
}

struct FBrdfSample
{
	vec3 Direction; // z ≤ 0: absorbed
	vec3 Weight;    // f · cos / density
	float Density;  // infinite for a delta
};

#endif
