#pragma once

#include "LanternScene/Scene/Scene.h"

namespace Lantern
{

/// Whether the composite has ambient light of the sky (r.RT.SkyAmbient), which ambient occlusion darkens.
bool HasSkyAmbient(const FSceneFacts& Facts);

} // namespace Lantern
