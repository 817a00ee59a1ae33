// A room of glass: see GlassScene.cpp.
#pragma once

#include "LanternHost/SceneDescription.h"

namespace Lantern::Builtin
{

FSceneDescription BuildGlassScene();

} // namespace Lantern::Builtin
