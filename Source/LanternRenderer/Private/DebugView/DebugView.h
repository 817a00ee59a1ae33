// r.RT.Debug.View: one signal instead of the picture.
#pragma once

#include <string_view>

#include "PassTools.h"

namespace Lantern
{

/// Returns the signal that is shown, or the one whose pass draws what is shown; Frame: the picture. Render thread. Logs once if the
/// variable names nothing.
ESignal GetDebugView();

/// Returns whether the variable names this picture: one of FSignalPass::Pictures or of a filter, whose pass then draws
/// FFrameContext::DebugPicture, or LightCellsPicture.
bool IsDebugPicture(std::string_view Name);

inline FShaderSource MakeDebugViewSource() { return MakeComputeSource("DebugView/DebugView.comp"); }

/// Returns what to show: Outputs.Display, FFrameContext::DebugPicture, the signal of GetDebugView, or light cells. A visibility is grey,
/// a radiance tone-mapped.
FGraphTexture AddDebugView(FFrameContext& Context, const FGBuffer& GBuffer, const FFrameOutputs& Outputs);

} // namespace Lantern
