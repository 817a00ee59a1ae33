// Random numbers: hashes, independent streams, and Owen-scrambled Sobol points.
#ifndef LANTERN_RANDOM_GLSL
#define LANTERN_RANDOM_GLSL

// Hashes a word with PCG's output permutation (Jarzynski & Olano 2020, "Hash Functions for GPU Rendering").
uint HashPcg(uint V)
{
	uint State = V * 747796405u + 2891336453u;
	uint Word = ((State >> ((State >> 28u) + 4u)) ^ State) * 277803737u;
	return (Word >> 22u) ^ Word;
}

// A counter-based stream of independent uniform numbers. Each (pixel, sample, seed) has its own.
struct FRandom
{
	uvec4 State;
};

// Hashes four words at once (pcg4d, Jarzynski & Olano 2020).
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

// Returns four numbers in [0, 1).
vec4 NextRandom4(inout FRandom R)
{
	R.State.w++;
	return vec4(HashPcg4(R.State) >> 8u) * (1.0 / 16777216.0);
}

// Owen-scrambled Sobol points, two dimensions (Burley 2020, "Practical Hash-based Owen Scrambling", with the
// Laine–Karras style permutation of Vegdahl's constants). An Owen scramble permutes the bits in reversed order. The functions
// below take and return reversed bits, so that pairs of reversals cancel out.
uint PermuteReversed(uint X, uint Seed)
{
	X ^= X * 0x3d20adeau;
	X += Seed;
	X *= (Seed >> 16u) | 1u;
	X ^= X * 0x05526c56u;
	X ^= X * 0x53a22864u;
	return X;
}

// Returns the second Sobol dimension with its bits reversed. Its direction numbers are Pascal's triangle modulo 2, the fifth
// Kronecker power of a 2×2 triangle. This takes five steps instead of one for each bit of the index.
uint SobolDimension1Reversed(uint Index)
{
	Index ^= (Index >> 1u) & 0x55555555u;
	Index ^= (Index >> 2u) & 0x33333333u;
	Index ^= (Index >> 4u) & 0x0f0f0f0fu;
	Index ^= (Index >> 8u) & 0x00ff00ffu;
	return Index ^ (Index >> 16u);
}

// Returns point Index of the sequence that Seed scrambles, in [0, 1)².
vec2 SobolOwen2(uint Index, uint Seed)
{
	Index = bitfieldReverse(PermuteReversed(bitfieldReverse(Index), Seed));
	uint X = bitfieldReverse(PermuteReversed(Index, HashPcg(Seed)));
	uint Y = bitfieldReverse(PermuteReversed(SobolDimension1Reversed(Index), HashPcg(Seed + 1u)));
	return vec2(uvec2(X, Y) >> 8u) * (1.0 / 16777216.0);
}

// Tiles of 8×8 pixels share one Sobol sequence in Z order, so that the points of neighbouring pixels stratify together
// (Ahmed & Wonka 2020, "Screen-Space Blue-Noise Diffusion of Monte Carlo Sampling Error via
// Hierarchical Ordering of Pixels"). The index is pixel XOR frame. XOR keeps aligned blocks of the sequence together, over
// the pixels of one frame and over the frames of one pixel.
struct FTileSequence
{
	uint Index; // of this pixel in this frame; multiply by the samples per pixel to get the first point
	uint Seed;
};

// SeedHash: HashPcg of the view's seed.
FTileSequence MakeTileSequence(uvec2 Pixel, uint FrameIndex, uint SeedHash)
{
	uvec2 P = Pixel & 7u;
	P = (P | (P << 2u)) & 0x13u; // interleave: bits 0 and 1 stay, bit 2 moves to 4
	P = (P | (P << 1u)) & 0x15u;
	uvec2 Tile = Pixel >> 3u;
	return FTileSequence(FrameIndex ^ (P.x | (P.y << 1u)), HashPcg(Tile.x + HashPcg(Tile.y + SeedHash)));
}

#endif
