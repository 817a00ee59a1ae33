// A pond of water that scatters light: see WaterScene.cpp.
#pragma once

#include "LanternHost/SceneDescription.h"

namespace Lantern::Builtin
{

/// bScattering: the water scatters light. Else it absorbs as much, but for that.
FSceneDescription BuildWaterScene(bool bScattering);

} // namespace Lantern::Builtin
