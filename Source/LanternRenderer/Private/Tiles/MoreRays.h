// More sun rays where one cannot tell and no history helps (Tiles/MoreRays.comp).
#pragma once

#include "LanternCore/FrameGraph/History.h"
#include "Rays/RayQueue.h"
#include "Tiles/MovedCasters.h"

namespace Lantern
{

/// Returns r.RT.Shadow.MoreRays: further samples of a pixel that needs them; 0: none has any.
uint32_t GetMoreRays();
void ListMoreRaysShaders(std::vector<FShaderSource>& Out);

/// Adds the passes that ask for further rays and trace them, behind those that trace Queue and what its tiles have left out. Does
/// nothing in a frame that shows the last one's view of a scene in which nothing moved. Changes: of the sun's shadows. FilterName: their FDenoiseInputs::Name. OutHistory: theirs, if
/// it was asked for. Lit: see FSunQueue::Tiles.
void AddMoreRays(FFrameContext& Context, const FGBuffer& GBuffer, const FRayDispatch& Dispatch, const FRayQueue& Queue,
    const FQueuedRays& Rays, FGraphBuffer Tiles, FGraphBuffer Lit, const FShadowChanges& Changes, const char* FilterName,
    FHistoryTexture& OutHistory);

} // namespace Lantern
