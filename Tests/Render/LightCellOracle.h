// Light cells as the CPU finds them: where they lie, and which lights reach them.
#pragma once

#include <algorithm>
#include <vector>

#include "LanternScene/Lights/Light.h"

namespace Lantern
{

/// Numbers that are the same in each run.
class FNumbers
{
public:
	explicit FNumbers(uint32_t Seed) : State(Seed) {}
	double Between(double A, double B)
	{
		State = State * 6364136223846793005ull + 1442695040888963407ull;
		return A + (B - A) * double(State >> 40) * 0x1p-24;
	}
	uint32_t Below(uint32_t Count) { return std::min(static_cast<uint32_t>(Between(0, Count)), Count - 1); }
	glm::dvec3 Point(double Half) { return {Between(-Half, Half), Between(-Half, Half), Between(-Half, Half)}; }

private:
	uint64_t State;
};

/// Returns a light of any type, with a cone or without, up to 12 m from Around.
FSceneLight MakeRandomLight(FNumbers& Numbers, const glm::dvec3& Around);

/// What a frame left in its grid.
struct FGridData
{
	FLightGrid Grid;
	std::vector<FLightCell> Cells;
	std::vector<uint32_t> Pool;

	std::vector<uint32_t> GetList(const FLightCell& Cell) const;
};

/// A cell or block as the CPU finds it in the world.
struct FWorldBox
{
	glm::dvec3 Min{0};
	double Edge = 0.0; // metres
	uint32_t Key = 0;
};

/// Returns the cell or block in place Index of FLightCell[].
FWorldBox FindBox(const FLightGrid& Grid, uint32_t Index);

/// Returns how far P is from the box, metres.
double GetDistance(const FWorldBox& Box, const glm::dvec3& P);

/// Whether the light brings anything to P, by more than rounding. On the GPU, positions have steps of 0.12 mm, and directions of 0.03 mrad.
bool Shines(const FSceneLight& Light, const glm::dvec3& P);

} // namespace Lantern
