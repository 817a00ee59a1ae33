// The built-in scene of a stylised look.
#pragma once

#include "LanternHost/SceneDescription.h"

namespace Lantern::Builtin
{

/// bStyled: if false, the objects have no toon styles.
FSceneDescription BuildToonScene(bool bStyled);

} // namespace Lantern::Builtin
