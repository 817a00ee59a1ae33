// Tiles of 8 × 8 pixels: what is in them, and which rays they ask for.
#pragma once

#include "Rays/RayQueue.h"

namespace Lantern
{

FShaderSource MakeTilesSource();

/// Adds the pass that sorts the screen into tiles. It answers what needs no ray, and queues the rays of the rest. Reads Depth and Normals
/// of the G-buffer. Returns FTile[] (TileTypes.h), row by row. Invalid: its shader is being compiled.
FGraphBuffer AddTilesPass(FFrameContext& Context, const FGBuffer& GBuffer, const FRayQueue& Queue, const FSunRays& Sun);

} // namespace Lantern
