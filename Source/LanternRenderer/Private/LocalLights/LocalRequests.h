// Which lights reach a tile, and the requests for rays to them.
#pragma once

#include "Rays/ShadowRays.h"

namespace Lantern
{

/// Lists the shaders of AddLocalRequests. Exact: as in FLocalRays.
void ListLocalRequestShaders(const FSceneFacts& Facts, uint32_t Exact, std::vector<FShaderSource>& Out);

/// Defines of all shaders that sample local lights. Exact: as in FLocalRays.
FShaderDefines MakeLocalDefines(FSceneFacts Facts, uint32_t Exact);
/// And of those that read what pixels chose.
FShaderDefines MakeChoiceDefines(const FSceneFacts& Facts, uint32_t Exact);

/// Returns whether any light casts a shadow, or surfaces emit. Lights without shadow are shaded all the same.
bool HasLocalRays(const FSceneFacts& Facts);
/// Returns the most rays of a pixel.
uint32_t GetLocalRaysPerPixel(const FSceneFacts& Facts, uint32_t Exact);

/// Returns whether tiles can have more lights than get rays each, or surfaces that emit, of which each pixel chooses.
bool MayChooseLights(const FSceneFacts& Facts, uint32_t Exact);

/// Returns whether pixels of tiles with many lights choose from tables, and tiles remember what was seen (FQueuedRays::Guide).
bool IsGuided(const FSceneFacts& Facts, uint32_t Exact);

/// Whether AddLocalRequests can add its passes. False: shaders are being compiled, or an error, which the context then has.
bool AreLocalRequestsReady(FFrameContext& Context, uint32_t Exact);

/// Adds the passes that list the lights of tiles and ask for rays. Reads Depth, Normals and, if pixels
/// choose, BaseColor and Material of the G-buffer. After AreLocalRequestsReady. InOut: gets the buffers that the rays and the shading read. Without tiles of the sun, the queue starts here.
void AddLocalRequests(FFrameContext& Context, const FGBuffer& GBuffer, FShadowRays& InOut, const FLocalRays& Rays);

/// Adds the passes of rays that are asked for where those of AddLocalRequests, which have been traced by then, leave a doubt: second rays
/// below the full rate, and more rays where no history helps. Dispatch: of the queue's shader. InOut: gets answers and LocalHistory.
void AddFurtherLocalRays(
    FFrameContext& Context, const FGBuffer& GBuffer, const FRayDispatch& Dispatch, FShadowRays& InOut, const FLocalRays& Rays);

} // namespace Lantern
