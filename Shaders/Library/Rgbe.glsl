// Colours in 32 bits: three mantissas of 8 bits and an exponent that they share, after "Real Pixels" (Ward 1991).
#ifndef LANTERN_RGBE_GLSL
#define LANTERN_RGBE_GLSL

// Rounds at random, so that the mean of what is kept stays the mean of what was given: a small step of a running mean would round to
// nothing. C: not negative, below 1e30. U: three random numbers in [0, 1).
uint PackRgbe(vec3 C, vec3 U)
{
	float Greatest = max(C.x, max(C.y, C.z));
	if (!(Greatest > 1.0e-30)) { return 0u; }
	int Exponent;
	frexp(Greatest, Exponent);
	// 255, so that the greatest mantissa has room to be rounded up.
	uvec3 M = uvec3(min(ldexp(C, ivec3(-Exponent)) * 255.0 + U, vec3(255.0)));
	return M.x | (M.y << 8u) | (M.z << 16u) | (uint(Exponent + 128) << 24u);
}

vec3 UnpackRgbe(uint P)
{
	if (P == 0u) { return vec3(0.0); }
	vec3 M = vec3(P & 255u, (P >> 8u) & 255u, (P >> 16u) & 255u) / 255.0;
	return ldexp(M, ivec3(int(P >> 24u) - 128));
}

#endif
