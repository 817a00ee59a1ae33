// The colour map of error images.
#pragma once

#include "LanternImage/Image.h"

namespace Lantern
{

/// Display colour of an error from 0 (black) to 1 (pale yellow). Other values are clamped; NaN is green, which the map lacks. The map is
/// Magma by N. J. Smith and S. van der Walt (CC0): every fifteenth of its 256 entries, with a cubic between them.
void GetMagmaColor(float Value, float OutRgb[3]);

/// Draws a one-channel image through the map.
FImage MakeHeatMap(const FImage& Errors);

} // namespace Lantern
