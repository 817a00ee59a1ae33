// Colours that 8 bits hold.
#pragma once

#include <cmath>

namespace Lantern
{

/// A linear value that an sRGB texel of 8 bits holds exactly.
inline float MakeSrgb(int Step) { return std::pow((static_cast<float>(Step) / 255.0f + 0.055f) / 1.055f, 2.4f); }

} // namespace Lantern
