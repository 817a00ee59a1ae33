// The shader of AddCameraMotionPass, for those that compile ahead.
#pragma once

#include "PassTools.h"

namespace Lantern
{

inline FShaderSource MakeCameraMotionSource() { return MakeComputeSource("Motion/CameraMotion.comp"); }

} // namespace Lantern
