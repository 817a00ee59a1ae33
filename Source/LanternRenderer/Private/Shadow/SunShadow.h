#pragma once

#include "LanternCore/ShaderCompiler.h"

namespace Lantern
{

/// Of the sun shadow shaders, as the console variables stand: one sample per pixel is a shader without a loop.
std::vector<std::pair<std::string, std::string>> MakeSunShadowDefines();

} // namespace Lantern
