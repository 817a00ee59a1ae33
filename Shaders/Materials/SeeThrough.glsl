// What a surface that light shines through leaves of a ray to a light, which goes straight on. The any-hit shader of such rays and ray
// queries share it. Transmission is that of standard parameters, and coverage that of the program.
#ifndef LANTERN_SEE_THROUGH_GLSL
#define LANTERN_SEE_THROUGH_GLSL

#include "AlphaTest.glsl"
#include "../Library/Brdf.glsl"

const float SolidDepth = 1.0e30; // of what blended surfaces cover wholly, which blocks as any surface does

float CoverageOf(FMaterialData Material, FMaterialInputs Inputs)
{
#ifdef MATERIAL_STANDARD_OPACITY
	return EvaluateOpacity(Material, Inputs);
#else
	return EvaluateMaterial(Material, Inputs, 0u).Opacity;
#endif
}

// Rays add up depths in the order in which they meet surfaces, which differs from run to run. Sums of such steps are exact below 1024.
float RoundDepth(float Depth)
{
	const float Steps = 16384.0; // to 1
	return round(Depth * Steps) * (1.0 / Steps);
}

// Returns −ln of the share, by luminance, in whole steps, or SolidDepth. Direction: of the ray, object space, of any length.
float SeeThroughDepth(FMaterialRef Materials, FSectionData Section, uint Primitive, vec2 Barycentrics, vec3 Direction)
{
	const float Least = 1.0e-4;
	FMaterialData Material = Materials.Data[Section.Material];
	vec3 P0, P1, P2;
	FetchPositions(Section, Primitive, P0, P1, P2);
	vec3 Normal = cross(P1 - P0, P2 - P0);
	FMaterialInputs Inputs = FetchMaterialInputs(Section, Primitive, Barycentrics);
	if ((Material.Flags & MATERIAL_BLENDED) != 0u)
	{
		float Coverage = CoverageOf(Material, Inputs);
		return Coverage < LeastSolidOpacity ? RoundDepth(-log(1.0 - max(Coverage, 0.0))) : SolidDepth;
	}
	float Side = dot(Normal, Direction);
	float Cosine = abs(Side) * inversesqrt(max(dot(Normal, Normal) * dot(Direction, Direction), 1.0e-30));
	float Ratio = (Material.Ior - 1.0) / (Material.Ior + 1.0), R = Material.Specular * mix(Ratio * Ratio, 1.0, SchlickWeight(Cosine));
	if ((Material.Flags & MATERIAL_SOLID) == 0u) { R = SheetReflectance(R); }
	float Share = EvaluateTransmission(Material, Inputs) * (1.0 - Material.Metallic) * (1.0 - R);
	float Depth = -log(max(Share * Luminance(EvaluateBaseColor(Material, Inputs).rgb), Least));
	if ((Material.Flags & MATERIAL_SOLID) != 0u)
	{
		// See StraightTransmittance. At most that of water: where no filter follows, what leaves less than half blocks all.
		const float Most = 1.333;
		float Widened = 2.0 * log(clamp(Material.Ior, 1.0, Most));
		Depth += Side > 0.0 ? Widened : -Widened;
	}
	return RoundDepth(Depth);
}

#endif
