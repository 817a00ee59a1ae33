// The shadow map that an engine hands over for a frame, checked before anything is done with it.
#pragma once

#include "LanternModule/Module.h"

namespace Lantern
{

/// Ok, or InvalidArgument, which names the member that is wrong. Frame.HostShadow may be null. bOwnShader: the engine has a shader of its
/// own for its map.
FRTStatus CheckHostShadow(const FRTModuleFrame& Frame, const IRTDevice& Device, bool bOwnShader);

} // namespace Lantern
