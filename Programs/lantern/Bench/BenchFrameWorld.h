// The world of `lantern bench frame`: trees, bushes, rocks, props and houses scattered over some kilometres, and people
// who walk in it. Always the same for the same numbers.
#pragma once

#include <vector>

#include "LanternHost/SceneDescription.h"

namespace Lantern
{

struct FBenchWorldOptions
{
	uint32_t Objects = 100'000; ///< in all, ≥ Characters + 2
	uint32_t Characters = 500;  ///< deform each frame
	uint32_t Movers = 1'000;    ///< rigid; move each frame
	uint32_t Repainted = 200;   ///< get other materials each frame, as objects do that are streamed, wet or broken
	double Extent = 6'000.0;    ///< edge of the square, metres
	uint32_t Seed = 1;
};

/// Indices are those of nodes, which are those of FHostScene's instances too.
struct FBenchWorld
{
	FSceneDescription Scene;
	std::vector<uint32_t> Movers, Characters;
	static constexpr uint32_t JointCount = 24;
};

FBenchWorld MakeBenchWorld(const FBenchWorldOptions& Options);

/// Where mover or character Index is in Frame, from where it began.
glm::dmat4 MoveObject(const FHostNode& Node, uint32_t Index, uint32_t Frame);
/// Other materials of the same kinds, for an object that has Materials.
std::vector<uint32_t> Repaint(const std::vector<int32_t>& Materials, uint32_t Frame);
/// How a character bends in Frame.
std::vector<glm::mat4> BendCharacter(uint32_t Index, uint32_t Frame);

} // namespace Lantern
