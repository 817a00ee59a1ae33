// A building full of lamps.
#pragma once

#include "LanternHost/SceneDescription.h"

namespace Lantern::Builtin
{

/// The building is always the same; only the Count lamps nearest to the room in the picture are there. Count: at most 10,000.
FSceneDescription BuildLamps(uint32_t Count);

} // namespace Lantern::Builtin
