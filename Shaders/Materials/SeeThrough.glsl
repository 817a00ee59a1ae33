// What a surface that light shines through leaves of a ray to a light, which goes straight on. The any-hit shader of such rays and ray
// queries share it. Materials of other programs count by their standard parameters.
#ifndef LANTERN_SEE_THROUGH_GLSL
#define LANTERN_SEE_THROUGH_GLSL

#include "Standard.glsl"
#include "../Library/Brdf.glsl"

// Returns −ln of the share, by luminance. Direction: of the ray, object space, of any length.
float SeeThroughDepth(FMaterialRef Materials, FSectionData Section, uint Primitive, vec2 Barycentrics, vec3 Direction)
{
	const float Least = 1.0e-4;
	FMaterialData Material = Materials.Data[Section.Material];
	vec3 P0, P1, P2;
	FetchPositions(Section, Primitive, P0, P1, P2);
	vec3 Normal = cross(P1 - P0, P2 - P0);
	FMaterialInputs Inputs = FetchMaterialInputs(Section, Primitive, Barycentrics);
	if ((Material.Flags & MATERIAL_BLENDED) != 0u) { return -log(max(1.0 - EvaluateOpacity(Material, Inputs), Least)); }
	float Cosine = abs(dot(Normal, Direction)) * inversesqrt(max(dot(Normal, Normal) * dot(Direction, Direction), 1.0e-30));
	float Ratio = (Material.Ior - 1.0) / (Material.Ior + 1.0), R = Material.Specular * mix(Ratio * Ratio, 1.0, SchlickWeight(Cosine));
	if ((Material.Flags & MATERIAL_SOLID) == 0u) { R = SheetReflectance(R); }
	float Share = EvaluateTransmission(Material, Inputs) * (1.0 - Material.Metallic) * (1.0 - R);
	return -log(max(Share * Luminance(EvaluateBaseColor(Material, Inputs).rgb), Least));
}

#endif
