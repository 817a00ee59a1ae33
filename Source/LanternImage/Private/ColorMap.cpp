// The Magma colour map and heat maps.
#include "LanternImage/ColorMap.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace Lantern
{

namespace
{

constexpr float MagmaAnchors[][3] = {
    {0.001462f, 0.000466f, 0.013866f},
    {0.035520f, 0.028397f, 0.125209f},
    {0.102815f, 0.063010f, 0.257854f},
    {0.191460f, 0.064818f, 0.396152f},
    {0.291366f, 0.064553f, 0.475462f},
    {0.384299f, 0.097855f, 0.501002f},
    {0.475780f, 0.134577f, 0.507921f},
    {0.569172f, 0.167454f, 0.504105f},
    {0.664915f, 0.198075f, 0.488836f},
    {0.761077f, 0.231214f, 0.460162f},
    {0.852126f, 0.276106f, 0.418573f},
    {0.925937f, 0.346844f, 0.374959f},
    {0.969680f, 0.446936f, 0.360311f},
    {0.989363f, 0.557873f, 0.391671f},
    {0.996580f, 0.668256f, 0.456192f},
    {0.996727f, 0.776795f, 0.541039f},
    {0.992440f, 0.884330f, 0.640099f},
    {0.987053f, 0.991438f, 0.749504f},
};
constexpr int LastAnchor = static_cast<int>(std::size(MagmaAnchors)) - 1;

/// Catmull-Rom through the anchors: within a hundredth of the full table.
float Interpolate(float Previous, float From, float To, float Next, float T)
{
	const float Tangent0 = 0.5f * (To - Previous);
	const float Tangent1 = 0.5f * (Next - From);
	const float Cubic = 2.0f * (From - To) + Tangent0 + Tangent1;
	const float Square = 3.0f * (To - From) - 2.0f * Tangent0 - Tangent1;
	return ((Cubic * T + Square) * T + Tangent0) * T + From;
}

} // namespace

void GetMagmaColor(float Value, float OutRgb[3])
{
	if (std::isnan(Value))
	{
		OutRgb[0] = OutRgb[2] = 0.0f;
		OutRgb[1] = 1.0f;
		return;
	}
	const float Position = std::clamp(Value, 0.0f, 1.0f) * LastAnchor;
	const int Index = std::min(static_cast<int>(Position), LastAnchor - 1);
	for (int Channel = 0; Channel < 3; ++Channel)
	{
		const float Color = Interpolate(MagmaAnchors[std::max(Index - 1, 0)][Channel], MagmaAnchors[Index][Channel],
		    MagmaAnchors[Index + 1][Channel], MagmaAnchors[std::min(Index + 2, LastAnchor)][Channel], Position - static_cast<float>(Index));
		OutRgb[Channel] = std::clamp(Color, 0.0f, 1.0f);
	}
}

FImage MakeHeatMap(const FImage& Errors)
{
	FImage Map(Errors.Width, Errors.Height, 3, EImageSpace::Display);
	for (size_t Pixel = 0; Pixel < Errors.GetPixelCount(); ++Pixel)
	{
		GetMagmaColor(Errors.Pixels[Pixel * Errors.Channels], &Map.Pixels[Pixel * 3]);
	}
	return Map;
}

} // namespace Lantern
