// Ambient light of a sky that is a texture.
#pragma once

#include "PassTools.h"

namespace Lantern
{

/// Whether the sky is not uniform.
inline bool NeedsSkyLight(const FSceneFacts& Facts) { return Facts.bSkyMap || Facts.bSkyProgram; }
FShaderSource MakeSkyLightSource(const FSceneFacts& Facts);

/// Adds a pass that makes SKY_LIGHT_TERMS × 1 texels of the sky's map as it is in this frame: Shaders/Library/SkyLight.glsl reads
/// them. Invalid: the sky is uniform, the shader is being compiled, or an error, which the context then has.
FGraphTexture AddSkyLightPass(FFrameContext& Context);

} // namespace Lantern
