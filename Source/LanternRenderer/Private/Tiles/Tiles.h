// Tiles of 8 × 8 pixels: what is in them, and which rays they ask for.
#pragma once

#include "Tiles/HostShadow.h"
#include "Tiles/SettledTiles.h"

namespace Lantern
{

/// Adds the shaders of AddTilesPass to a list, other than MakeShareSource.
void ListTilesShaders(const FSceneFacts& Facts, const FSunRates& Rates, std::vector<FShaderSource>& Out);

/// Of the pass that shares out a queue which may overflow.
FShaderSource MakeShareSource();

/// Adds the pass that sorts the screen into tiles. It answers what needs no ray, by the host's shadow map if there is one, and queues the
/// rays of the rest. If the queue may
/// overflow, a second pass sees to it that the same rays have room in each run. Reads Depth and Normals
/// of the G-buffer. Returns FTile[] (TileTypes.h), row by row. Invalid: shaders are being compiled.
FGraphBuffer AddTilesPass(FFrameContext& Context, const FGBuffer& GBuffer, const FRayQueue& Queue, const FSunRays& Sun,
    const FSettledTiles& Settled, const FHostShadowMap& Map);

/// Returns a buffer for the marks of pixels that ask for a sun ray (FSunQueueConstants::Marks), which the caller's pass writes for each tile.
FGraphBuffer CreateSunMarks(FFrameContext& Context, const FRayQueue& Queue);
/// Adds the pass that starts a queue with the rays that are marked, in the order of tiles. Samples: threads of each ray; Tiles: FTile[], if pixels
/// may be lit by the host's shadow map. Behind AddTilesPass, which has its shader.
void AddSunQueuePass(FFrameContext& Context, const FRayQueue& Queue, FGraphBuffer Marks, uint32_t Samples, FGraphBuffer Tiles = {});

/// Returns whether the queue, in which sun rays come first, may lack room for them.
bool MayLackSunRays(const FFrameContext& Context, const FRayQueue& Queue);

/// Adds the pass that shares out a queue which overflowed. bRest: it holds the rays of FTile::SunRest.
void AddShareQueuePass(FFrameContext& Context, const FRayQueue& Queue, FGraphBuffer Tiles, bool bRest);

} // namespace Lantern
