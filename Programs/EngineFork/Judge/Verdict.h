// The judge's verdict on one frame's pictures.
#pragma once

#include <string>

#include "Example/ForkEngine.h"

namespace Fork
{

/// Counts the pixels of a shadow mask by what they must show, and those that show something else.
struct FVerdict
{
	uint32_t Lit = 0, Shadowed = 0, Sky = 0, Unsure = 0, Wrong = 0;
};

/// Compares every pixel of Mask with the truth.
FVerdict JudgeShadow(const FForkScene& Scene, const uint16_t* Mask);

/// Fails unless ambient occlusion is in range, and some pixels but not most are occluded. The filter's result has no closed form here;
/// Lantern's own tests check it.
FError JudgeOcclusion(const uint16_t* Visibility);

/// Writes a mask as a PGM picture.
FError WritePicture(const std::string& Path, const uint16_t* Mask);

} // namespace Fork
