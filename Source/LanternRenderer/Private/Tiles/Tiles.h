// Tiles of 8 × 8 pixels: what is in them, and which rays they ask for.
#pragma once

#include "Tiles/SettledTiles.h"

namespace Lantern
{

FShaderSource MakeTilesSource(const FSunRates& Rates);

/// Of the pass that shares out a queue which may overflow.
FShaderSource MakeShareSource();

/// Adds the pass that sorts the screen into tiles. It answers what needs no ray, and queues the rays of the rest. If the queue may
/// overflow, a second pass sees to it that the same rays have room in each run. Reads Depth and Normals
/// of the G-buffer. Returns FTile[] (TileTypes.h), row by row. Invalid: shaders are being compiled.
FGraphBuffer AddTilesPass(
    FFrameContext& Context, const FGBuffer& GBuffer, const FRayQueue& Queue, const FSunRays& Sun, const FSettledTiles& Settled);
/// Returns whether the queue, in which sun rays come first, may lack room for them.
bool MayLackSunRays(const FFrameContext& Context, const FRayQueue& Queue);

/// Adds the pass that shares out a queue which overflowed. bRest: it holds the rays of FTile::SunRest.
void AddShareQueuePass(FFrameContext& Context, const FRayQueue& Queue, FGraphBuffer Tiles, bool bRest);

} // namespace Lantern
