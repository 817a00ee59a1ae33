// What an engine hands over for a frame, checked before anything is done with it.
#pragma once

#include "LanternModule/Module.h"

namespace Lantern
{

/// Ok, or InvalidArgument, which names the argument that is wrong.
FRTStatus CheckFrame(const FRTModuleFrame& Frame);
/// What Precache reads, as far as it is there.
FRTStatus CheckPrecache(const FRTModuleFrame& Frame);

} // namespace Lantern
