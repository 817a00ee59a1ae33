// What the files of FGeometryStore share.
#pragma once

#include <cstdint>

#include "LanternCore/Config/ConsoleVariables.h"

namespace Lantern
{

/// Frames for which a geometry that does not fit is merely passed over: its turn may come when others go.
inline constexpr uint32_t PatienceFrames = 8;

/// r.RT.Build.Compaction, on the render thread.
bool IsCompactionOn();

} // namespace Lantern
