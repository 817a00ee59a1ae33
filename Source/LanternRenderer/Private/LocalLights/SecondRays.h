// Fewer rays to local lights: which pixels ask in a frame, and what is asked where their neighbours cannot tell.
#pragma once

#include "Rays/RayQueue.h"

namespace Lantern
{

EPixelRate GetLightRate(); ///< r.RT.Lights.Rate

/// Returns whether a frame asks for second rays.
bool WantsSecondRays();
/// Defines: of all shaders that sample local lights.
FShaderSource MakeSecondRaysSource(FShaderDefines Defines);

/// Adds the passes that ask for second rays and trace them, behind those that trace Queue. Pipeline: of MakeSecondRaysSource. Reads Depth
/// and Normals of the G-buffer.
void AddSecondRays(FFrameContext& Context, const FGBuffer& GBuffer, const FRayDispatch& Dispatch, const FRayQueue& Queue,
    const FQueuedRays& Rays, IRTPipeline* Pipeline);

} // namespace Lantern
