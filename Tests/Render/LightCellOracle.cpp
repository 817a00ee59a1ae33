// The grid of light cells, from its description alone.
#include "LightCellOracle.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace Lantern
{

FSceneLight MakeRandomLight(FNumbers& Numbers, const glm::dvec3& Around)
{
	constexpr uint32_t Types[] = {
	    LIGHT_POINT, LIGHT_POINT, LIGHT_POINT, LIGHT_RECTANGLE, LIGHT_DISK, LIGHT_SPHERE, LIGHT_TUBE, LIGHT_DIRECTIONAL};
	FSceneLight Light;
	Light.Type = Types[Numbers.Below(8)];
	Light.Position = Around + Numbers.Point(12.0) * glm::dvec3(1, 0.3, 1);
	do {
		Light.Direction = glm::vec3(Numbers.Point(1.0));
		Light.Tangent = glm::vec3(Numbers.Point(1.0));
	}
	while (glm::length(glm::cross(Light.Direction, Light.Tangent)) < 0.01f);
	Light.Color = glm::vec3(0.05 + glm::abs(Numbers.Point(0.5)));
	Light.Range = Numbers.Below(8) == 0 ? 0.0f : static_cast<float>(std::exp2(Numbers.Between(-2.0, 3.0)));
	if (Numbers.Below(3) == 0)
	{
		Light.OuterCone = static_cast<float>(Numbers.Between(0.01, 3.1));
		Light.InnerCone = Light.OuterCone * static_cast<float>(Numbers.Between(0.0, 0.99));
	}
	Light.Size = glm::vec2(Numbers.Between(0.01, 0.5), Numbers.Between(0.01, 0.5));
	Light.bTwoSided = Numbers.Below(2) == 0;
	return Light;
}

std::vector<uint32_t> FGridData::GetList(const FLightCell& Cell) const
{
	const uint32_t Count = Cell.State & LIGHT_CELL_COUNT_MASK;
	if (Cell.First + Count > Pool.size())
	{
		ADD_FAILURE() << "a list lies outside of the pool";
		return {};
	}
	return {Pool.begin() + Cell.First, Pool.begin() + Cell.First + Count};
}

FWorldBox FindBox(const FLightGrid& Grid, uint32_t Index)
{
	const bool bBlock = Index >= LIGHT_CELLS;
	const uint32_t Local = bBlock ? Index - LIGHT_CELLS : Index, PerLevel = bBlock ? LIGHT_BLOCKS_PER_LEVEL : LIGHT_CELLS_PER_LEVEL;
	const uint32_t Level = Local / PerLevel, Group = bBlock ? 4 : 1;
	const int64_t Counts[] = {32 / Group, 16 / Group, 32 / Group};
	const int64_t Places[] = {
	    Local % PerLevel % Counts[0], Local % PerLevel / Counts[0] % Counts[1], Local % PerLevel / (Counts[0] * Counts[1])};
	const double Steps = std::exp2(double(Grid.Shift + Level)) * Group;
	FWorldBox Box;
	Box.Edge = Steps / double(LIGHT_POSITION_STEPS);
	const uint32_t KeyBits[] = {11, 10, 11}, KeyShifts[] = {0, 11, 21};
	for (int Axis = 0; Axis < 3; ++Axis)
	{
		// The one cell of the window that falls on this place.
		int64_t Cell = std::llround(double(Grid.First[Level][Axis]) / Steps);
		while ((Cell % Counts[Axis] + Counts[Axis]) % Counts[Axis] != Places[Axis]) { ++Cell; }
		Box.Min[Axis] = double(Cell) * Box.Edge - LIGHT_CELL_OFFSET / double(LIGHT_POSITION_STEPS);
		const int64_t Around = (Cell - Places[Axis]) / Counts[Axis];
		const int64_t Bits = int64_t(32) - Grid.Shift - Level - (Axis == 1 ? 4 : 5); // of a coordinate that wraps around
		Box.Key |= static_cast<uint32_t>(Around & ((int64_t(1) << std::min<int64_t>(Bits, KeyBits[Axis])) - 1)) << KeyShifts[Axis];
	}
	return Box;
}

double GetDistance(const FWorldBox& Box, const glm::dvec3& P)
{
	return glm::length(glm::max(glm::max(Box.Min - P, P - Box.Min - Box.Edge), glm::dvec3(0)));
}

bool Shines(const FSceneLight& Light, const glm::dvec3& P)
{
	constexpr double PositionError = 2e-4, AngleError = 2e-4;
	const glm::dvec3 From = P - Light.Position;
	const double Distance = glm::length(From);
	if (Distance > 0.9999 * double(Light.Range) - PositionError || Distance < 2.0 * PositionError) { return false; }
	const double Cosine = glm::dot(glm::normalize(glm::dvec3(Light.Direction)), From) / Distance;
	const bool bFlat = (Light.Type == LIGHT_RECTANGLE || Light.Type == LIGHT_DISK) && !Light.bTwoSided;
	if (bFlat && Cosine * Distance < PositionError + AngleError * Distance) { return false; }
	const double Angle = std::acos(std::clamp(Cosine, -1.0, 1.0)) + 2.0 * PositionError / Distance + AngleError;
	return Light.OuterCone <= 0.0f || Angle < 0.9999 * double(Light.OuterCone);
}

} // namespace Lantern
