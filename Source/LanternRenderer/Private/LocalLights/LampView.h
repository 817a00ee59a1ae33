// r.RT.Debug.View=lamp_tiles and lamp_rays: how many local lights each tile has, and the rays of each pixel to them.
#pragma once

#include "Rays/ShadowRays.h"

namespace Lantern
{

/// Names of the pictures, with a null behind the last one.
inline constexpr const char* LampPictures[] = {"lamp_tiles", "lamp_rays", nullptr};

/// Adds what the views need to a list of compute shaders.
void ListLampViewShaders(std::vector<FShaderSource>& Out);
/// Draws FFrameContext::DebugPicture if one of LampPictures is asked for. Rays: of the frame, with tiles of local lights.
void AddLampView(FFrameContext& Context, const FShadowRays& Rays);

} // namespace Lantern
