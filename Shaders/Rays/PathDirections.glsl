// The first directions of paths that light a white Lambert lobe. They are drawn from a mixture of densities: the cosine, a guide
// (PathGuide.glsl) and a second lobe of the same surface. Each path counts by the density of the whole mixture (the balance heuristic of
// Veach & Guibas 1995, "Optimally Combining Sampling Techniques for Monte Carlo Rendering").
// GUIDED_PATHS, SECOND_LOBE: defined if there is a guide, a second lobe.
// NO_MIXTURE_PDF: planted fault (r.RT.Debug.GI.MixturePdf).
#ifndef LANTERN_PATH_DIRECTIONS_GLSL
#define LANTERN_PATH_DIRECTIONS_GLSL

#include "../Library/BrdfSample.glsl"
#ifdef GUIDED_PATHS
#include "PathGuide.glsl"
#endif

// The thread sets these before it samples.
#ifdef GUIDED_PATHS
FPathGuide PathGuide;
#endif
#ifdef SECOND_LOBE
FBrdf SecondLobe;
float SecondShare; // of paths that the second lobe draws, 0 to below 1
#endif

const float GuideShare = 0.5; // of paths that the second lobe does not draw, at most

// V: local frame, as what is returned. Pdf is that of the cosine: weights between this and light sampling need only to sum to one, and light
// sampling knows that pdf alone.
// CosineShare: gets the share of paths that the cosine draws; 1 / CosineShare is the greatest weight.
FBrdfSample SampleDirection(mat3 Basis, vec3 V, vec2 U, out float CosineShare)
{
	float FromGuide = 0.0, FromLobe = 0.0;
#ifdef SECOND_LOBE
	FromLobe = SecondShare;
#endif
#ifdef GUIDED_PATHS
	FromGuide = GuideShare * PathGuide.Trust * (1.0 - FromLobe);
#endif
	float FromCosine = CosineShare = 1.0 - FromGuide - FromLobe;
	FBrdfSample Sample;
	if (U.x < FromCosine) { Sample.Direction = SampleCosineHemisphere(vec2(U.x / FromCosine, U.y)); }
#ifdef GUIDED_PATHS
	else if (U.x < FromCosine + FromGuide) { Sample.Direction = DrawGuided(PathGuide, vec2((U.x - FromCosine) / FromGuide, U.y)) * Basis; }
#endif
#ifdef SECOND_LOBE
	else { Sample.Direction = SampleBrdf(SecondLobe, V, vec3((U.x - FromCosine - FromGuide) / FromLobe, U.y, 0.0)).Direction; }
#else
	else { Sample.Direction = vec3(0.0, 0.0, -1.0); } // rounding
#endif
	Sample.Pdf = max(Sample.Direction.z, 0.0) / Pi;
	float Pdf = FromCosine * Sample.Pdf;
#ifdef GUIDED_PATHS
	if (FromGuide > 0.0) { Pdf += FromGuide * GuidePdf(PathGuide, Basis * Sample.Direction); }
#endif
#ifdef SECOND_LOBE
	if (FromLobe > 0.0 && Sample.Direction.z > 0.0) { Pdf += FromLobe * BrdfPdf(SecondLobe, V, Sample.Direction); }
#endif
#ifdef NO_MIXTURE_PDF
	Pdf = Sample.Pdf;
#endif
	Sample.Weight = vec3(Pdf > 0.0 ? Sample.Pdf / Pdf : 0.0);
	return Sample;
}

#endif
