// The engine's shadow map: checked, and placed in Lantern's world.
#pragma once

#include "LanternRenderer/HostShadow.h"
#include "ModuleWorld.h"

namespace Lantern
{

/// Ok, or InvalidArgument, which names the member. Frame.HostShadow may be null.
FRTStatus CheckHostShadow(const FRTModuleFrame& Frame, const IRTDevice& Device, bool bOwnShader);

/// Imports the textures. Shadow: checked.
FHostShadow ImportHostShadow(FFrameGraph& Graph, const FRTModuleHostShadow& Shadow, const FModuleWorld& World);

} // namespace Lantern
