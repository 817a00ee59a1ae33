// The colour map of error images.
#pragma once

#include "LanternImage/Image.h"

namespace Lantern
{

/// Display colour of an error in 0 (black) to 1 (pale yellow), clamped; NaN is drawn green, which the map lacks.
/// Magma, by N. J. Smith and S. van der Walt (CC0), every fifteenth entry of its 256 and a cubic between them.
void GetMagmaColor(float Value, float OutRgb[3]);

/// A one-channel image through the map.
FImage MakeHeatMap(const FImage& Errors);

} // namespace Lantern
