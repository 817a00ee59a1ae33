// The judge's verdict on one frame's pictures.
#pragma once

#include <string>
#include <vector>

#include "Example/ForkEngine.h"
#include "Judge/ShadowTruth.h"

namespace Fork
{

/// Counts the pixels of a shadow mask by what they must show, and those that show something else.
struct FVerdict
{
	uint32_t Lit = 0, Shadowed = 0, Sky = 0, Unsure = 0, Wrong = 0;
};

/// What each pixel must show: PixelCount, rows from the top.
using FShadowPicture = std::vector<FExpectedPixel>;

/// The truth of a view.
FShadowPicture ExpectShadow(const FForkScene& Scene, const FCamera& Camera, ELightSource Source = ELightSource::Sun);
/// Compares every pixel of Mask with the truth.
FVerdict JudgeShadow(const FShadowPicture& Expectations, const uint16_t* Mask);

/// Fails unless the engine's light is what its G-buffer and the plugin's outputs make of it: without an output, as if there were no
/// such pass. Lamp: what the lamp brings, if the engine lights by it.
FError JudgeLight(const FShadowPicture& Expectations, const FFrameMasks& Masks, const FShadowPicture* Lamp = nullptr);

/// Returns the values of a mask.
std::vector<float> ReadMask(const uint16_t* Mask);
/// Returns the mean difference of two masks.
double Compare(const std::vector<float>& A, const std::vector<float>& B);

/// Returns the mean of the engine's light over a view's surfaces.
double GetMeanLight(const FFrameMasks& Masks);

/// Fails unless ambient occlusion is in range, and some pixels but not most are occluded. The filter's result has no closed form here;
/// Lantern's own tests check it.
FError JudgeOcclusion(const uint16_t* Visibility);

/// Writes a mask as a PPM picture. Pixels are red if they are dark and must be lit, green if they are lit and must be dark, and bluish
/// where the truth is unsure.
FError WritePicture(const std::string& Path, const FShadowPicture& Expectations, const uint16_t* Mask);

} // namespace Fork
