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

/// Adds the pass that sorts the screen into tiles. It answers what needs no ray, by the host's shadow map if there is one, and marks the pixels of
/// the rest. The passes of AddSunQueuePass follow. Reads Depth and Normals of the G-buffer. Returns FTile[] (TileTypes.h), row by row. Invalid:
/// shaders are being compiled.
FGraphBuffer AddTilesPass(FFrameContext& Context, const FGBuffer& GBuffer, const FRayQueue& Queue, const FSunRays& Sun,
    const FSettledTiles& Settled, const FHostShadowMap& Map);
/// Returns whether the queue, in which sun rays come first, may lack room for them.
bool MayLackSunRays(const FFrameContext& Context, const FRayQueue& Queue);

/// A queue that starts with the rays of marked pixels.
struct FSunQueue
{
	FRayQueue Queue;
	FGraphBuffer Marks;        ///< of CreateSunMarks
	FGraphBuffer Tiles;        ///< FTile[], if pixels may be lit by the host's shadow map; invalid: none are
	uint32_t Samples = 1;      ///< threads of each ray
	bool bMayLackRoom = false; ///< see MayLackSunRays. Else what has no room is left out
};

/// Returns a buffer for the marks of pixels that ask for a sun ray (FSunQueueConstants::Marks), which the caller's pass writes for each tile.
FGraphBuffer CreateSunMarks(FFrameContext& Context, const FRayQueue& Queue);
/// Adds the pass that starts a queue with the rays that are marked, in the order of tiles. If it may lack room, two passes follow, which leave an
/// equal share of each tile's. Behind AddTilesPass, which has the shaders.
void AddSunQueuePass(FFrameContext& Context, const FSunQueue& Inputs);

} // namespace Lantern
