// Random numbers that are the same everywhere, as the standard library's distributions are not.
#pragma once

#include <cstdint>

namespace Lantern::Builtin
{

/// PCG-XSH-RR (O'Neill 2014, "PCG: A Family of Simple Fast Space-Efficient Statistically Good Algorithms").
class FRandomStream
{
public:
	explicit FRandomStream(uint32_t Seed) : State(Seed * 2ull + 1) { Next(); }

	uint32_t Next()
	{
		const uint64_t Old = State;
		State = Old * 6364136223846793005ull + 1442695040888963407ull;
		const uint32_t Shifted = uint32_t(((Old >> 18) ^ Old) >> 27);
		const uint32_t Rotation = uint32_t(Old >> 59);
		return Shifted >> Rotation | Shifted << (-Rotation & 31);
	}
	float NextFloat() { return float(Next() >> 8) * 0x1p-24f; } ///< [0, 1)
	float Between(float A, float B) { return A + (B - A) * NextFloat(); }

private:
	uint64_t State;
};

/// A random number per lattice point.
inline uint32_t HashLattice(uint32_t X, uint32_t Y, uint32_t Seed)
{
	uint32_t H = X * 0x85ebca6bu ^ (Y * 0xc2b2ae35u + Seed * 0x27d4eb2fu + 0x165667b1u);
	H = (H ^ H >> 15) * 0x2c1b3c6du;
	H = (H ^ H >> 12) * 0x297a2d39u;
	return H ^ H >> 15;
}

inline float HashToFloat(uint32_t Hash) { return float(Hash >> 8) * 0x1p-24f; }

} // namespace Lantern::Builtin
