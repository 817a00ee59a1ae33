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
// Laine–Karras style permutation of Vegdahl's constants). A scramble permutes reversed bits; what is reversed twice
// on the way is not reversed at all here.
uint PermuteReversed(uint X, uint Seed)
{
	X ^= X * 0x3d20adeau;
	X += Seed;
	X *= (Seed >> 16u) | 1u;
	X ^= X * 0x05526c56u;
	X ^= X * 0x53a22864u;
	return X;
}

// Bits of the second Sobol dimension, reversed. Its direction numbers are Pascal's triangle modulo 2, which is the
// fifth Kronecker power of a 2×2 triangle: five steps instead of one for each bit of the index.
uint SobolDimension1Reversed(uint Index)
{
	Index ^= (Index >> 1u) & 0x55555555u;
	Index ^= (Index >> 2u) & 0x33333333u;
	Index ^= (Index >> 4u) & 0x0f0f0f0fu;
	Index ^= (Index >> 8u) & 0x00ff00ffu;
	return Index ^ (Index >> 16u);
}

vec2 SobolOwen2(uint Index, uint Seed)
{
	Index = bitfieldReverse(PermuteReversed(bitfieldReverse(Index), Seed));
	uint X = bitfieldReverse(PermuteReversed(Index, HashPcg(Seed)));
	uint Y = bitfieldReverse(PermuteReversed(SobolDimension1Reversed(Index), HashPcg(Seed + 1u)));
	return vec2(uvec2(X, Y) >> 8u) * (1.0 / 16777216.0);
}

// One sequence for 8×8 pixels, which they share in Z order, so that what a filter gathers from neighbours completes itself as
// the points of one pixel do (Ahmed & Wonka 2020, "Screen-Space Blue-Noise Diffusion of Monte Carlo Sampling Error via
// Hierarchical Ordering of Pixels"). Exclusive or keeps aligned blocks together: those of pixels in one frame, and those of
// frames in one pixel.
struct FTileSequence
{
	uint Index; // of this pixel's points in this frame, in units of the points that it takes
	uint Seed;
};

FTileSequence MakeTileSequence(uvec2 Pixel, uint FrameIndex, uint SeedHash)
{
	uvec2 P = Pixel & 7u;
	P = (P | (P << 2u)) & 0x13u; // bits 0 and 1, and 2 at 4
	P = (P | (P << 1u)) & 0x15u;
	uvec2 Tile = Pixel >> 3u;
	return FTileSequence(FrameIndex ^ (P.x | (P.y << 1u)), HashPcg(Tile.x + HashPcg(Tile.y + SeedHash)));
}

#endif
