// Construction of images, and limits of their size.
#include "LanternImage/Image.h"

#include <cassert>

namespace Lantern
{

FImage::FImage(uint32_t InWidth, uint32_t InHeight, uint32_t InChannels, EImageSpace InSpace)
    : Width(InWidth),
      Height(InHeight),
      Channels(InChannels),
      Space(InSpace),
      Pixels(static_cast<size_t>(InWidth) * InHeight * InChannels, 0.0f)
{
	assert(InChannels >= 1 && InChannels <= 4);
}

bool IsImageSizeValid(uint64_t Width, uint64_t Height)
{
	return Width > 0 && Height > 0 && Width <= MaxImageDimension && Height <= MaxImageDimension && Width * Height <= MaxImagePixels;
}

FImage MakeColorImage(const FImage& Image)
{
	FImage Color(Image.Width, Image.Height, 3, Image.Space);
	const bool bGrey = Image.GetColorChannels() == 1;
	for (size_t Pixel = 0; Pixel < Image.GetPixelCount(); ++Pixel)
	{
		const float* Source = &Image.Pixels[Pixel * Image.Channels];
		for (size_t Channel = 0; Channel < 3; ++Channel) { Color.Pixels[Pixel * 3 + Channel] = Source[bGrey ? 0 : Channel]; }
	}
	return Color;
}

} // namespace Lantern
