// What an engine hands over for a frame, checked before anything is done with it.
#pragma once

#include "LanternModule/Module.h"

namespace Lantern
{

/// Ok, or InvalidArgument, which names the argument that is wrong. Device: the one that the frame's things must be of.
FRTStatus CheckFrame(const FRTModuleFrame& Frame, const IRTDevice& Device);
/// What Precache reads, as far as it is there.
FRTStatus CheckPrecache(const FRTModuleFrame& Frame);

} // namespace Lantern
