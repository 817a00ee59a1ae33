#pragma once

#include "LanternRenderer/Renderer.h"

namespace Lantern
{

/// Of the sun shadow shaders, as the console variables stand: one sample per pixel is a shader without a loop.
std::vector<std::pair<std::string, std::string>> MakeSunShadowDefines();

/// Whether the frame's sun shadows, if there are any, are filtered over frames.
bool AreSunShadowsFiltered(const FFrameContext& Context);

} // namespace Lantern
