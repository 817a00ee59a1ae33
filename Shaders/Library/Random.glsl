#ifndef LANTERN_RANDOM_GLSL
#define LANTERN_RANDOM_GLSL

// PCG output permutation as a hash (Jarzynski & Olano 2020, "Hash Functions for GPU Rendering").
uint HashPcg(uint V)
{
	uint State = V * 747796405u + 2891336453u;
	uint Word = ((State >> ((State >> 28u) + 4u)) ^ State) * 277803737u;
	return (Word >> 22u) ^ Word;
}

// Independent uniform numbers; the state is a counter-based stream of its own per (pixel, sample, seed).
struct FRandom
{
	uvec4 State;
};

// Four words at once, pcg4d of the same paper.
uvec4 HashPcg4(uvec4 V)
{
	V = V * 1664525u + 1013904223u;
	V.x += V.y * V.w;
	V.y += V.z * V.x;
	V.z += V.x * V.y;
	V.w += V.y * V.z;
	V ^= V >> 16u;
	V.x += V.y * V.w;
	V.y += V.z * V.x;
	V.z += V.x * V.y;
	V.w += V.y * V.z;
	return V;
}

FRandom MakeRandom(uvec2 Pixel, uint Sample, uint Seed)
{
	FRandom R;
	R.State = uvec4(Pixel.x | (Pixel.y << 16u), Sample, Seed, 0u);
	return R;
}

// In [0, 1).
vec4 NextRandom4(inout FRandom R)
{
	R.State.w++;
	return vec4(HashPcg4(R.State) >> 8u) * (1.0 / 16777216.0);
}

// Owen-scrambled Sobol points, two dimensions (Burley 2020, "Practical Hash-based Owen Scrambling", with the
// Laine–Karras style permutation of Vegdahl's constants).
uint OwenScramble(uint X, uint Seed)
{
	X = bitfieldReverse(X);
	X ^= X * 0x3d20adeau;
	X += Seed;
	X *= (Seed >> 16u) | 1u;
	X ^= X * 0x05526c56u;
	X ^= X * 0x53a22864u;
	return bitfieldReverse(X);
}

uint SobolDimension1(uint Index)
{
	// Direction numbers of the second Sobol dimension are Pascal's triangle modulo 2.
	uint V = 0x80000000u, X = 0u;
	for (; Index != 0u; Index >>= 1u, V ^= V >> 1u)
	{
		if ((Index & 1u) != 0u) { X ^= V; }
	}
	return X;
}

vec2 SobolOwen2(uint Index, uint Seed)
{
	Index = OwenScramble(Index, Seed);
	uint X = OwenScramble(bitfieldReverse(Index), HashPcg(Seed));
	uint Y = OwenScramble(SobolDimension1(Index), HashPcg(Seed + 1u));
	return vec2(uvec2(X, Y) >> 8u) * (1.0 / 16777216.0);
}

#endif
