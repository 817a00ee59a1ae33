// r.RT.Debug.View: one signal instead of the picture.
#pragma once

#include "PassTools.h"

namespace Lantern
{

/// Returns the signal that is shown; Frame: the picture. Render thread. Logs once if the variable names no signal.
ESignal GetDebugView();

inline FShaderSource MakeDebugViewSource() { return MakeComputeSource("DebugView/DebugView.comp"); }

/// Returns what to show: Outputs.Display, or the signal of GetDebugView. A visibility is grey, a radiance tone-mapped.
FGraphTexture AddDebugView(FFrameContext& Context, const FFrameOutputs& Outputs);

} // namespace Lantern
