// What the scene knows of lamps that change: by how much each pixel's light has changed since the last frame.
#pragma once

#include "Rays/RayQueue.h"

namespace Lantern
{

/// Lists the compute shaders of AddLampChange. Defines: of all shaders that sample local lights.
void ListLampChangeShaders(const FShaderDefines& Defines, std::vector<FShaderSource>& Out);

/// Adds the passes, and returns FDenoiseInputs::Change of a lobe. Lamps are compared once for either lobe. Invalid: no lamp has changed,
/// there is no last frame, or shaders are being compiled, or an error, which the context then has. Rays: with Guide; in tiles without one nothing is known. Reads Depth,
/// Normals, BaseColor and Material of the G-buffer.
FGraphTexture AddLampChange(
    FFrameContext& Context, const FGBuffer& GBuffer, const FQueuedRays& Rays, const FShaderDefines& Defines, ESignal Lobe);

} // namespace Lantern
