// The right shadow of the example scene, in closed form.
#pragma once

#include "Example/ForkScene.h"

namespace Fork
{

enum class EExpectation : uint8_t
{
	Unsure, ///< an edge of a box or of a shadow is near
	Sky,
	Lit,
	Shadowed,
};

/// What the pixel must show. It intersects boxes with rays in double precision.
EExpectation ExpectPixel(const FForkScene& Scene, uint32_t X, uint32_t Y, uint32_t Width, uint32_t Height);

} // namespace Fork
