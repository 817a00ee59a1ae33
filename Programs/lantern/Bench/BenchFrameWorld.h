// The world of `lantern bench frame`: trees, bushes, rocks, props and houses scattered over some kilometres, and people who walk in it.
// Equal options give equal worlds.
#pragma once

#include <vector>

#include "LanternHost/SceneDescription.h"

namespace Lantern
{

struct FBenchWorldOptions
{
	uint32_t Objects = 100'000; ///< number of all objects, ≥ Characters + 2
	uint32_t Characters = 500;  ///< number of objects that deform each frame
	uint32_t Movers = 1'000;    ///< number of rigid objects that move each frame
	uint32_t Repainted = 200;   ///< number of objects that get other materials each frame, as if streamed, wet or broken
	double Extent = 6'000.0;    ///< edge of the square, metres
	uint32_t Seed = 1;
};

/// Indices are those of nodes, and also those of FHostScene's instances.
struct FBenchWorld
{
	FSceneDescription Scene;
	std::vector<uint32_t> Movers, Characters;
	static constexpr uint32_t JointCount = 24;
};

FBenchWorld MakeBenchWorld(const FBenchWorldOptions& Options);

/// Transform of a mover in Frame. Node is where it began.
glm::dmat4 MoveObject(const FHostNode& Node, uint32_t Index, uint32_t Frame);
/// Other materials of the kinds that Materials has.
std::vector<uint32_t> Repaint(const std::vector<int32_t>& Materials, uint32_t Frame);
/// Joint matrices of a character in Frame.
std::vector<glm::mat4> BendCharacter(uint32_t Index, uint32_t Frame);

} // namespace Lantern
