// r.RT.Debug.View: one signal instead of the picture.
#pragma once

#include "PassTools.h"

namespace Lantern
{

/// Returns the signal that is shown; Frame: the picture. Render thread. Logs once if the variable names no signal.
ESignal GetDebugView();

/// Returns whether the lights of light cells are shown instead.
bool IsLightCellsView();

inline FShaderSource MakeDebugViewSource() { return MakeComputeSource("DebugView/DebugView.comp"); }

/// Returns what to show: Outputs.Display, the signal of GetDebugView, or light cells. A visibility is grey, a radiance tone-mapped.
FGraphTexture AddDebugView(FFrameContext& Context, const FGBuffer& GBuffer, const FFrameOutputs& Outputs);

} // namespace Lantern
