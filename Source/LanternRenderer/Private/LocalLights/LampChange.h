// What the scene knows of lamps that change: by how much each pixel's light has changed since the last frame.
#pragma once

#include "Rays/RayQueue.h"

namespace Lantern
{

/// Lists the compute shaders of AddLampChange. bLamps: lamps are followed, and not emissive triangles alone. Defines: of all shaders that
/// sample local lights.
void ListLampChangeShaders(bool bLamps, const FSceneFacts& Facts, const FShaderDefines& Defines, std::vector<FShaderSource>& Out);

/// Adds the passes, and returns FDenoiseInputs::Change of either lobe. Up to LAMP_CHANGES lamps and EMITTER_CHANGES clusters of emissive
/// triangles are followed. Invalid: nothing has changed, there is no last frame, or shaders are being compiled, or an error, which the
/// context then has. Call it once for a frame. Rays: with Guide; in tiles without one nothing is known. Reads Depth, Normals, BaseColor
/// and Material of the G-buffer.
FLobes AddLampChange(FFrameContext& Context, const FGBuffer& GBuffer, bool bLamps, const FQueuedRays& Rays, const FShaderDefines& Defines);

} // namespace Lantern
