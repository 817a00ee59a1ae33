// Importance sampling of the BRDF: chooses a lobe, then a direction from it.
#ifndef LANTERN_BRDF_SAMPLE_GLSL
#define LANTERN_BRDF_SAMPLE_GLSL

#include "Brdf.glsl"
#include "Sampling.glsl"

// A side of a surface whose diffuse light is gathered through a white Lambert lobe.
struct FGatherSide
{
	bool bBack;
	vec3 Weight; // of what is gathered there, of the light over DiffuseReflectance
};

// Returns the chance that a side is the back. The front's paths may light a specular lobe as well, however little its diffuse lobe shows.
float BackChance(FBrdf Brdf)
{
	const float Most = 0.75;
	return min(BackProbability(Brdf), Most);
}

// U: in [0, 1).
FGatherSide ChooseSide(FBrdf Brdf, float U)
{
	float Chance = BackChance(Brdf);
	bool bBack = U < Chance;
	return FGatherSide(bBack, ShareOfSide(Brdf, bBack) / (bBack ? Chance : 1.0 - Chance));
}

struct FBrdfSample
{
	vec3 Direction; // local frame
	vec3 Weight;    // BRDF · |n·l| / Pdf; 0: absorbed
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
		if (Sample.Direction.z <= 0.0) { return Sample; }
	}
	else
	{
		Sample.Direction = SampleCosineHemisphere(U.xy);
		if (HasBack(Brdf) && U.z - SpecularChance < (1.0 - SpecularChance) * BackProbability(Brdf)) { Sample.Direction.z = -Sample.Direction.z; }
	}
	Sample.Pdf = BrdfPdf(Brdf, V, Sample.Direction);
	if (Sample.Pdf > 0.0) { Sample.Weight = EvaluateBrdfCos(Brdf, V, Sample.Direction) / Sample.Pdf; }
	return Sample;
}

#endif
