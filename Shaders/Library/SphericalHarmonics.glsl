// Real spherical harmonics of three bands.
#ifndef LANTERN_SPHERICAL_HARMONICS_GLSL
#define LANTERN_SPHERICAL_HARMONICS_GLSL

// Y_lm, in the order of l and m. D: of unit length.
float[9] EvaluateHarmonics(vec3 D)
{
	return float[9](0.28209479, 0.48860251 * D.y, 0.48860251 * D.z, 0.48860251 * D.x, 1.09254843 * D.x * D.y, 1.09254843 * D.y * D.z,
	                0.31539157 * (3.0 * D.z * D.z - 1.0), 1.09254843 * D.x * D.z, 0.54627422 * (D.x * D.x - D.y * D.y));
}

#endif
