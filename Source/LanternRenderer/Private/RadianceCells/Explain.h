// r.RT.Debug.Explain: the pass that looks up what is known of the light of one pixel.
#pragma once

#include "RadianceCells/RadianceCells.h"

namespace Lantern
{

/// Adds what the explanation needs to a list of compute shaders.
void ListExplainShaders(std::vector<FShaderSource>& Out);
/// Fills FFrameContext::ExplainedPixel, if a pixel is asked for and the frame has cells. Behind all that looks these up.
void AddExplainPass(FFrameContext& Context, const FGBuffer& GBuffer);

} // namespace Lantern
