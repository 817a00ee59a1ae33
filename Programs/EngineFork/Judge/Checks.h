// What the judge has the engine do: the scene as made, then changed as in a game.
#pragma once

#include <string>

#include "Example/ForkEngine.h"

namespace Fork
{

/// Runs frames of Scene, and if bChanges of changed versions of it, until each is complete, and judges each. Pictures: how the paths of the
/// masks' pictures begin; empty for none. WritePicture says what they show.
FError CheckScenes(FForkEngine& Engine, FForkScene Scene, const std::string& Pictures, bool bChanges);

} // namespace Fork
