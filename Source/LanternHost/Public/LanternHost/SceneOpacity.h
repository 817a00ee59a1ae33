// Classifies and cuts the alpha-tested triangles of a loaded scene, while its texels are still on the CPU.
#pragma once

#include <vector>

#include "LanternHost/SceneDescription.h"
#include "LanternScene/Opacity/OpacityPieces.h"

namespace Lantern
{

struct FMeshOpacity
{
	/// Sections of the mesh, with everything that classification adds except the key.
	std::vector<FRTSectionInfo> Sections;
	FOpacityPieceList Pieces;
};

struct FSceneOpacity
{
	std::vector<FMeshOpacity> Meshes;
	FOpacityCounts Counts; ///< over all meshes
	uint64_t Pieces = 0;
};

/// Classifies and cuts; reorders the indices of alpha-tested sections. Pose tells how large and how many the objects are.
FSceneOpacity ClassifySceneOpacity(FSceneDescription& Description, const FScenePose& Pose);

} // namespace Lantern
