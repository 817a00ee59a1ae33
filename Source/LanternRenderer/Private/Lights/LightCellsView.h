// r.RT.Debug.View light_cells: how many lights the light cells of pixels list.
#pragma once

#include "PassTools.h"

namespace Lantern
{

inline constexpr const char* LightCellsPicture = "light_cells"; ///< see IsDebugPicture

inline FShaderSource MakeLightCellsViewSource() { return MakeComputeSource("Lights/LightCellsView.comp"); }

/// Returns a picture of them, or Otherwise, and logs once, if the frame has no light cells. Black: no light; blue, green, yellow, red:
/// up to LIGHT_CELL_MOST; white: the cell's list has no room.
FGraphTexture AddLightCellsView(FFrameContext& Context, const FGBuffer& GBuffer, FGraphTexture Otherwise);

} // namespace Lantern
