// Ambient light of a sky that is a texture.
#pragma once

#include "PassTools.h"

namespace Lantern
{

inline FShaderSource MakeSkyLightSource() { return MakeComputeSource("Sky/SkyLight.comp"); }

/// Adds a pass that makes SKY_LIGHT_TERMS × 1 texels of the sky's map as it is in this frame: Shaders/Library/SkyLight.glsl reads
/// them. Invalid: the sky is no texture, the shader is being compiled, or an error, which the context then has.
FGraphTexture AddSkyLightPass(FFrameContext& Context);

} // namespace Lantern
