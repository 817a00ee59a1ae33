// Carries on the history of what is known of the sun's visibility (Settled.glsl), after the rays of the frame.
#ifndef LANTERN_SETTLE_GLSL
#define LANTERN_SETTLE_GLSL

#include "../Shared/SettledTypes.h"
#include "../Rays/RayQueue.glsl"

uint LoadKnown(uint Image, ivec2 Pixel) { return uint(imageLoad(Images[Image], Pixel).x * 255.0 + 0.5); }

// Image: storage index; holds what was known before. Answer: of the pixel's rays; 0: there are none.
void Settle(uint Image, ivec2 Pixel, uint Answer)
{
	uint Before = LoadKnown(Image, Pixel);
	bool bSeen = SunSeen(Answer) > 0u, bUnseen = SunUnseen(Answer) > 0u, bLit = bSeen && !bUnseen;
	uint Frames = 0u;
	if (bSeen != bUnseen)
	{
		bool bAsBefore = bLit == ((Before & SETTLED_LIT) != 0u);
		Frames = bAsBefore ? min((Before & (SETTLED_LIT - 1u)) + 1u, SETTLED_FRAMES) : 1u;
	}
	imageStore(Images[Image], Pixel, vec4(float(Frames | (bLit ? SETTLED_LIT : 0u)) / 255.0));
}

#endif
