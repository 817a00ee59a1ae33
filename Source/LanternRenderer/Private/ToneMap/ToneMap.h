// The shader of AddToneMapPass, for those that compile ahead.
#pragma once

#include "PassTools.h"

namespace Lantern
{

inline FShaderSource MakeToneMapSource() { return MakeComputeSource("ToneMap/ToneMap.comp"); }

} // namespace Lantern
