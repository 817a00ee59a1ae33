// A bower against the sun: see LeavesScene.cpp.
#pragma once

#include "LanternHost/SceneDescription.h"

namespace Lantern::Builtin
{

/// Builds a bower against the sun, with leaves, a paper screen and a paper lantern. bScattering: light scatters through them.
FSceneDescription BuildLeavesScene(bool bScattering);

} // namespace Lantern::Builtin
