// Alpha-tested triangles of a loaded scene, told apart and cut while its texels are still on the CPU.
#pragma once

#include <vector>

#include "LanternHost/SceneDescription.h"
#include "LanternScene/Opacity/OpacityPieces.h"

namespace Lantern
{

struct FMeshOpacity
{
	/// As the mesh's, with all but the key of what classification adds.
	std::vector<FRTSectionInfo> Sections;
	FOpacityPieceList Pieces;
};

struct FSceneOpacity
{
	std::vector<FMeshOpacity> Meshes;
	FOpacityCounts Counts; ///< over all meshes
	uint64_t Pieces = 0;
};

/// Reorders the indices of alpha-tested sections. The pose says how large and how many objects are.
FSceneOpacity ClassifySceneOpacity(FSceneDescription& Description, const FScenePose& Pose);

} // namespace Lantern
