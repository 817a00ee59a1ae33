// Encoding of texels. Clears and mips on the mock give what a device gives.
#pragma once

#include "LanternRHI/RTTypes.h"

namespace Lantern
{

struct FTexelPlane
{
	uint8_t* Texels = nullptr; ///< rows tightly packed
	uint32_t Width = 0, Height = 0;
};

/// Decodes sRGB formats to linear. Missing channels are 0, alpha is 1. Integers are converted.
void DecodeTexel(ERTFormat Format, const uint8_t* Texel, float OutValue[4]);
void EncodeTexel(ERTFormat Format, const float Value[4], uint8_t* OutTexel);
/// Writes to each texel of Dest the mean of the texels of Source that it covers, weighted by area.
void FilterBox(ERTFormat Format, const FTexelPlane& Source, const FTexelPlane& Dest);

} // namespace Lantern
