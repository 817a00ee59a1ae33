// r.RT.Debug.View=sun_tiles and sun_rays: what the tiles of the sun's shadows decided.
#pragma once

#include "PassTools.h"

namespace Lantern
{

/// Names of the pictures, with a null behind the last one.
inline constexpr const char* TilePictures[] = {"sun_tiles", "sun_rays", nullptr};

/// Adds what the views need to a list of compute shaders.
void ListTileViewShaders(std::vector<FShaderSource>& Out);
/// Draws FFrameContext::DebugPicture if one of TilePictures is asked for. Tiles: FTile[], after all rays are queued.
void AddTileView(FFrameContext& Context, FGraphBuffer Tiles);

} // namespace Lantern
