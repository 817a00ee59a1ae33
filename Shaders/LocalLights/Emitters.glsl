// Emissive triangles as local lights: a point of one, as a surface sees it.
// EMITTER_SHAPES: only where the point lies matters, and materials are not read.
#ifndef LANTERN_EMITTERS_GLSL
#define LANTERN_EMITTERS_GLSL

#include "../Shared/LocalLightTypes.h"
#include "../Library/LightShapes.glsl"
#include "../Library/Lights.glsl"
#ifndef EMITTER_SHAPES
#include "../Materials/Standard.glsl"
#include "../Rays/MaterialPayload.glsl"
#endif

bool IsTriangle(uint Light) { return (Light & LIGHT_TRIANGLE) != 0u; }

// Solid angles below this are sampled by area.
const float LeastSphericalTriangle = 0.05; // sr

// Returns the angle between unit vectors. It is as exact near 0 and π as elsewhere.
float AngleBetween(vec3 A, vec3 B)
{
	bool bAcute = dot(A, B) > 0.0;
	float Angle = Pi - 2.0 * AccurateAcos(min(0.5 * length(bAcute ? B - A : B + A), 1.0));
	return bAcute ? Angle : Pi - Angle;
}

// Returns X without its part along the unit vector Axis, unit length.
vec3 Orthonormal(vec3 X, vec3 Axis) { return NormalizeOr(X - Axis * dot(X, Axis), MakeBasis(Axis)[0]); }

// Uniform in the solid angle of a triangle, whose corners are unit vectors (Arvo 1995, "Stratified Sampling of Spherical Triangles").
// Returns the solid angle.
float SampleSphericalTriangle(vec3 A, vec3 B, vec3 C, vec2 U, out vec3 Direction)
{
	vec3 AB = NormalizeOr(cross(A, B), MakeBasis(A)[0]), BC = NormalizeOr(cross(B, C), MakeBasis(B)[0]), CA = NormalizeOr(cross(C, A), MakeBasis(C)[0]);
	float Alpha = AngleBetween(AB, -CA), Sum = Alpha + AngleBetween(BC, -AB) + AngleBetween(CA, -BC);
	float Part = mix(Pi, Sum, U.x), CosAlpha = cos(Alpha), SinAlpha = sin(Alpha);
	float SinPhi = sin(Part) * CosAlpha - cos(Part) * SinAlpha, CosPhi = cos(Part) * CosAlpha + sin(Part) * SinAlpha;
	float K1 = CosPhi + CosAlpha, K2 = SinPhi - SinAlpha * dot(A, B);
	float Below = (K2 * SinPhi + K1 * CosPhi) * SinAlpha;
	float Cosine = clamp((K2 + (K2 * CosPhi - K1 * SinPhi) * CosAlpha) / (abs(Below) > 1.0e-12 ? Below : 1.0e-12), -1.0, 1.0);
	vec3 Last = Cosine * A + sqrt(1.0 - Cosine * Cosine) * Orthonormal(C, A);
	float CosTheta = 1.0 - U.y * (1.0 - dot(Last, B));
	Direction = CosTheta * B + sqrt(max(1.0 - CosTheta * CosTheta, 0.0)) * Orthonormal(Last, B);
	return max(Sum - Pi, 0.0);
}

// Returns whether a triangle, whose corners are unit vectors, covers LeastSphericalTriangle (Van Oosterom and Strackee 1983).
bool IsLargeTriangle(vec3 A, vec3 B, vec3 C)
{
	float Below = 1.0 + dot(A, B) + dot(B, C) + dot(C, A);
	return abs(dot(A, cross(B, C))) > max(Below, 0.0) * (0.5 * LeastSphericalTriangle);
}

// A triangle from the place of a surface.
struct FSeenTriangle
{
	vec3 A, AB, AC; // corner and edges, metres
	vec3 Cross;     // of the edges
};

// Samples a point of the triangle: solid angle of the sample, before facing is looked at. Barycentrics: of the second and third corner.
float SampleSeenTriangle(FSeenTriangle T, vec2 U, out vec3 Direction, out float Distance, out vec2 Barycentrics)
{
	float Doubled = length(T.Cross);
	vec3 A = normalize(T.A), B = normalize(T.A + T.AB), C = normalize(T.A + T.AC);
	if (IsLargeTriangle(A, B, C))
	{
		float SolidAngle = SampleSphericalTriangle(A, B, C, U, Direction);
		float Facing = dot(T.Cross, Direction);
		Distance = dot(T.Cross, T.A) / (abs(Facing) > 1.0e-20 ? Facing : 1.0e-20);
		vec3 In = Direction * Distance - T.A;
		Barycentrics = vec2(dot(cross(In, T.AC), T.Cross), dot(cross(T.AB, In), T.Cross)) / max(Doubled * Doubled, 1.0e-30);
		Barycentrics = clamp(Barycentrics, vec2(0.0), vec2(1.0));
		return Distance > 0.0 ? SolidAngle : 0.0;
	}
	Barycentrics = SampleTriangle(U);
	vec3 To = T.A + T.AB * Barycentrics.x + T.AC * Barycentrics.y;
	float DistanceSquared = dot(To, To);
	Distance = sqrt(DistanceSquared);
	if (DistanceSquared < 1.0e-12) { return 0.0; }
	Direction = To / Distance;
	return 0.5 * abs(dot(T.Cross, Direction)) / DistanceSquared;
}

// Samples a point of an emissive triangle as seen from P. Index: in FEmissiveTriangle[].
FLightSample SampleEmitter(FSceneConstants Scene, uint Index, vec3 P, vec2 U)
{
	FLightSample Sample = FLightSample(vec3(0.0, 0.0, 1.0), 0.0, vec3(0.0), 1.0);
	if (Index >= Scene.EmissiveTriangleCount) { return Sample; } // memory of an earlier frame
	FEmissiveTriangle Triangle = FEmissiveRef(Scene.EmissiveTriangles).Data[Index];
	FSectionData Section = FSectionRef(Scene.Sections).Data[Triangle.Section];
	FSeenTriangle Seen;
	Seen.A = Triangle.P0 + CellOffset(Scene, FObjectRef(Scene.Objects).Data[Triangle.Object].Cell) - P;
	Seen.AB = Triangle.P1 - Triangle.P0;
	Seen.AC = Triangle.P2 - Triangle.P0;
	Seen.Cross = cross(Seen.AB, Seen.AC);
	vec2 Barycentrics;
	float SolidAngle = SampleSeenTriangle(Seen, U, Sample.Direction, Sample.Distance, Barycentrics);
	float Cosine = -dot(Seen.Cross, Sample.Direction) / max(length(Seen.Cross), 1.0e-30);
	if ((Triangle.Flags & OBJECT_MIRRORED) != 0u) { Cosine = -Cosine; }
	if ((Section.Flags & SECTION_DOUBLE_SIDED) != 0u) { Cosine = abs(Cosine); }
	if (Cosine <= 1.0e-6 || SolidAngle <= 0.0) { return Sample; }
	Sample.Cosine = max(Cosine, 0.1);
#ifdef EMITTER_SHAPES
	Sample.Irradiance = vec3(1.0);
#else
	FMaterialData Material = FMaterialRef(Scene.Materials).Data[Section.Material];
	FMaterialInputs Inputs = FetchTextureInputs(Section, Triangle.Primitive, Barycentrics);
#ifdef HAS_MASKED
	if (IsCutAway(Material, Inputs)) { return Sample; }
#endif
	Sample.Irradiance = min(EvaluateLightEmission(Material, Inputs), vec3(MaxEmission)) * SolidAngle; // the limit that paths have
#ifdef HALF_LIGHT_AREA // r.RT.Debug.Lights.Area
	Sample.Irradiance *= 0.5;
#endif
#endif
	return Sample;
}

#endif
