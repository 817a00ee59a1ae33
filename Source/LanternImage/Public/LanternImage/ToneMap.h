// From radiance to a picture: exposure, curve and sRGB, per channel. The composite shader computes equal values.
#pragma once

#include "LanternImage/Image.h"

namespace Lantern
{

/// sRGB transfer functions (IEC 61966-2-1). Negative values give 0; values above 1 follow the curve.
float LinearToSrgb(float Linear);
float SrgbToLinear(float Encoded);

/// Filmic curve fitted to the ACES reference rendering: Narkowicz 2015, "ACES Filmic Tone Mapping Curve". It maps linear values to linear
/// values in 0 to 1. NaN and negative values give 0, infinity gives 1.
float ToneMapAces(float Linear);

/// Maps radiance · 2^ExposureEv through the curve and encodes it as sRGB. Alpha is kept. A display image is returned as it is.
FImage ToneMapImage(const FImage& Image, float ExposureEv = 0.0f);

/// Encodes or decodes the colour channels, unless the image is in Space already. Encoding clamps to 0 to 1; NaN gives 0.
FImage ConvertImage(const FImage& Image, EImageSpace Space);

} // namespace Lantern
