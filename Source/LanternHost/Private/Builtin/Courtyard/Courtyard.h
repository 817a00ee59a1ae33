// The courtyard: what the program shows when it is given nothing.
#pragma once

#include "LanternHost/SceneDescription.h"

namespace Lantern::Builtin
{

FSceneDescription BuildCourtyard();

} // namespace Lantern::Builtin
