// Encoding of texels, so that clears and mips on the mock give what a device gives.
#pragma once

#include "LanternRHI/RTTypes.h"

namespace Lantern
{

struct FTexelPlane
{
	uint8_t* Texels = nullptr; ///< rows tightly packed
	uint32_t Width = 0, Height = 0;
};

/// sRGB formats decode to linear; missing channels are 0, alpha 1. Integers are converted.
void DecodeTexel(ERTFormat Format, const uint8_t* Texel, float OutValue[4]);
void EncodeTexel(ERTFormat Format, const float Value[4], uint8_t* OutTexel);
/// Mean of the texels of Source that each of Dest covers, weighted by area.
void FilterBox(ERTFormat Format, const FTexelPlane& Source, const FTexelPlane& Dest);

} // namespace Lantern
