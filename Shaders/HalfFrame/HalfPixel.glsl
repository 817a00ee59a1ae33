// Which pixel of the whole frame stands for its 2×2 in the half frame.
#ifndef LANTERN_HALF_PIXEL_GLSL
#define LANTERN_HALF_PIXEL_GLSL

#include "../Library/GBuffer.glsl"

uvec2 HalfSizeOf(uvec2 Size) { return (Size + 1u) >> 1u; }
uvec2 HalfSizeOf(FViewConstants View) { return HalfSizeOf(uvec2(View.Width, View.Height)); }

// Returns the first pixel, so that motion between frames is that of the pixels. If that one shows the sky, it is the first of the others that
// does not: a wire before the sky is not lost. OutDepth: of it; 0: the sky.
ivec2 FindHalfSource(FViewConstants View, uint Depths, ivec2 HalfPixel, out float OutDepth)
{
	ivec2 First = HalfPixel * 2;
	for (int I = 0; I < 4; ++I)
	{
		ivec2 Pixel = First + ivec2(I & 1, I >> 1);
		if (IsOutsideView(View, uvec2(Pixel))) { continue; }
		OutDepth = LoadDepth(Depths, Pixel);
		if (OutDepth > 0.0) { return Pixel; }
	}
	OutDepth = 0.0;
	return First;
}

#endif
