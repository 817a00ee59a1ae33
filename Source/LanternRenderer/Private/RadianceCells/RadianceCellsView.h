// r.RT.Debug.View=radiance_cells and radiance_light: the cells that pixels lie in, and the light that these know.
#pragma once

#include "RadianceCells/RadianceCells.h"

namespace Lantern
{

/// Names of the pictures, with a null behind the last one.
inline constexpr const char* RadianceCellPictures[] = {"radiance_cells", "radiance_light", nullptr};

/// Adds what the views need to a list of compute shaders.
void ListRadianceCellsViewShaders(std::vector<FShaderSource>& Out);
/// Draws FFrameContext::DebugPicture if one of RadianceCellPictures is asked for, and the frame has cells.
void AddRadianceCellsView(FFrameContext& Context, const FGBuffer& GBuffer);

} // namespace Lantern
