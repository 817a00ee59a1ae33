// Importance sampling of the BRDF: chooses a lobe, then a direction from it.
#ifndef LANTERN_BRDF_SAMPLE_GLSL
#define LANTERN_BRDF_SAMPLE_GLSL

#include "Brdf.glsl"
#include "Sampling.glsl"

struct FBrdfSample
{
	vec3 Direction; // local frame; z ≤ 0: absorbed
	vec3 Weight;    // BRDF · n·l / Pdf
	float Pdf;      // over solid angle; infinite for a delta
};

// V: local frame, towards the viewer. U: xy choose the direction, z the lobe.
FBrdfSample SampleBrdf(FBrdf Brdf, vec3 V, vec3 U)
{
	FBrdfSample Sample;
	Sample.Direction = vec3(0.0, 0.0, -1.0);
	Sample.Weight = vec3(0.0);
	Sample.Pdf = 0.0;
	float SpecularChance = SpecularProbability(Brdf, V);
	if (U.z < SpecularChance)
	{
		if (IsMirror(Brdf))
		{
			Sample.Direction = vec3(-V.xy, V.z);
			Sample.Weight = SpecularFresnel(Brdf, V.z) / SpecularChance;
			Sample.Pdf = uintBitsToFloat(0x7f800000u);
			return Sample;
		}
		Sample.Direction = reflect(-V, SampleGgxHalfVector(V, Brdf.Alpha, U.xy));
	}
	else
	{
		Sample.Direction = SampleCosineHemisphere(U.xy);
	}
	if (Sample.Direction.z <= 0.0) { return Sample; }
	Sample.Pdf = BrdfPdf(Brdf, V, Sample.Direction);
	if (Sample.Pdf > 0.0) { Sample.Weight = EvaluateBrdfCos(Brdf, V, Sample.Direction) / Sample.Pdf; }
	return Sample;
}

#endif
