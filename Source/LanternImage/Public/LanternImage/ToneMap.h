// From radiance to a picture. The composite shader computes the same: exposure, curve, sRGB, per channel.
#pragma once

#include "LanternImage/Image.h"

namespace Lantern
{

/// sRGB transfer functions (IEC 61966-2-1); negative values give 0, values above 1 follow the curve.
float LinearToSrgb(float Linear);
float SrgbToLinear(float Encoded);

/// Filmic curve fitted to the ACES reference rendering: Narkowicz 2015, "ACES Filmic Tone Mapping Curve".
/// Linear in, linear in 0 to 1 out. NaN and negative values give 0, infinity 1.
float ToneMapAces(float Linear);

/// Radiance · 2^ExposureEv through the curve, sRGB-encoded. Alpha is kept. A display image is returned as it is.
FImage ToneMapImage(const FImage& Image, float ExposureEv = 0.0f);

/// Encodes or decodes the colour channels; nothing is done where the image is in that space already. Encoding
/// clamps to 0 to 1 (NaN gives 0).
FImage ConvertImage(const FImage& Image, EImageSpace Space);

} // namespace Lantern
