// Which texels a triangle's alpha test can read, and whether all of them pass or fail.
#pragma once

#include "LanternScene/OpacityClassifier.h"

namespace Lantern
{

/// Texels of at least PassFrom surely pass the test, those of at most FailUpTo surely fail it.
struct FAlphaLimits
{
	int PassFrom = 256;
	int FailUpTo = -1;
};

/// UV: of the triangle's corners, transformed as the shader does it. Magnitude: greatest absolute value of what their
/// computation adds up, which says how far it may be rounded.
EOpacity ClassifyFootprint(const FAlphaTest& Test, const FAlphaLimits& Limits, const glm::dvec2 (&UV)[3],
                           glm::dvec2 Magnitude);

} // namespace Lantern
