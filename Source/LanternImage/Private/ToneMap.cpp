// The sRGB transfer functions and the ACES curve.
#include "LanternImage/ToneMap.h"

#include <algorithm>
#include <cmath>

namespace Lantern
{

namespace
{

template <class T>
FImage MapColor(const FImage& Image, EImageSpace Space, T&& Function)
{
	FImage Result = Image;
	Result.Space = Space;
	const uint32_t ColorChannels = Image.GetColorChannels();
	for (size_t Pixel = 0; Pixel < Image.GetPixelCount(); ++Pixel)
	{
		for (uint32_t Channel = 0; Channel < ColorChannels; ++Channel)
		{
			float& Value = Result.Pixels[Pixel * Image.Channels + Channel];
			Value = Function(Value);
		}
	}
	return Result;
}

} // namespace

float LinearToSrgb(float Linear)
{
	// Written so that NaN falls through to 0.
	if (!(Linear > 0.0f)) { return 0.0f; }
	return Linear <= 0.0031308f ? 12.92f * Linear : 1.055f * std::pow(Linear, 1.0f / 2.4f) - 0.055f;
}

float SrgbToLinear(float Encoded)
{
	if (!(Encoded > 0.0f)) { return 0.0f; }
	return Encoded <= 0.04045f ? Encoded / 12.92f : std::pow((Encoded + 0.055f) / 1.055f, 2.4f);
}

float ToneMapAces(float Linear)
{
	if (!(Linear > 0.0f)) { return 0.0f; }
	// The curve has reached 1 long before; the bound keeps infinity / infinity out.
	const float X = std::min(Linear, 65504.0f);
	return std::min(X * (2.51f * X + 0.03f) / (X * (2.43f * X + 0.59f) + 0.14f), 1.0f);
}

FImage ToneMapImage(const FImage& Image, float ExposureEv)
{
	if (Image.Space == EImageSpace::Display) { return Image; }
	const float Exposure = std::exp2(ExposureEv);
	return MapColor(Image, EImageSpace::Display, [=](float Value) { return LinearToSrgb(ToneMapAces(Value * Exposure)); });
}

FImage ConvertImage(const FImage& Image, EImageSpace Space)
{
	if (Image.Space == Space) { return Image; }
	if (Space == EImageSpace::Display)
	{
		return MapColor(Image, Space, [](float Value) { return LinearToSrgb(std::min(Value, 1.0f)); });
	}
	return MapColor(Image, Space, SrgbToLinear);
}

} // namespace Lantern
