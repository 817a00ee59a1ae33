// The scenes of `lantern bench growth`: in each line, one quantity grows and the others stay.
#pragma once

#include <vector>

#include "LanternHost/SceneDescription.h"
#include "LanternRenderer/View.h"

namespace Lantern
{

struct FGrowthScene
{
	FSceneDescription Scene;
	FView View;
	std::vector<uint32_t> Movers; ///< instances that move in each frame
};

enum class EGrowthLine
{
	Objects,
	Triangles,
	Materials,
	Programs,
	Pixels,
	Count
};

struct FGrowthLineInfo
{
	const char* Name;
	const char* Held; ///< what stays
};
const FGrowthLineInfo& GetGrowthLine(EGrowthLine Line);

/// The numbers at which a line is measured. Pixels: of pictures of 16:9.
std::vector<uint64_t> ListGrowthPoints(EGrowthLine Line, bool bIsCpu, bool bQuick);

FGrowthScene MakeGrowthScene(EGrowthLine Line, uint64_t Value, bool bIsCpu);

} // namespace Lantern
