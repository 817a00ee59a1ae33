#ifndef LANTERN_BRDF_SAMPLE_GLSL
#define LANTERN_BRDF_SAMPLE_GLSL

#include "Brdf.glsl"
#include "Sampling.glsl"

FBrdfSample SampleBrdf(FBrdf B, vec3 V, vec3 U)
{
	FBrdfSample S;
	S.Direction = vec3(0.0, 0.0, -1.0);
	S.Weight = vec3(0.0);
	S.Density = 0.0;
	float P = SpecularProbability(B, V);
	if (U.z < P)
	{
		if (IsMirror(B))
		{
			S.Direction = vec3(-V.xy, V.z);
			S.Weight = SpecularFresnel(B, V.z) / P;
			S.Density = uintBitsToFloat(0x7f800000u);
			return S;
		}
		S.Direction = reflect(-V, SampleGgxHalf(V, B.Alpha, U.xy));
	}
	else
	{
		S.Direction = SampleCosineHemisphere(U.xy);
	}
	if (S.Direction.z <= 0.0) { return S; }
	S.Density = BrdfDensity(B, V, S.Direction);
	if (S.Density > 0.0) { S.Weight = EvaluateBrdfCos(B, V, S.Direction) / S.Density; }
	return S;
}

#endif
