// Which pixels ask for rays in a frame (r.RT.Lights.Rate, r.RT.GI.Rate). The others take what neighbours on their plane saw.
// CHECKERBOARD: every other pixel, in turn. QUARTER: one of each 2×2, in turn. Neither: all.
#ifndef LANTERN_RATE_GLSL
#define LANTERN_RATE_GLSL

#if defined(CHECKERBOARD) || defined(QUARTER)
#define SPARSE
#endif

#if defined(CHECKERBOARD)
const uint TurnFrames = 2u; // in which each pixel asks once
#elif defined(QUARTER)
const uint TurnFrames = 4u;
#else
const uint TurnFrames = 1u;
#endif

// Returns the pixels of a tile that ask, in Z order. Either word of 32 is the same.
uint TurnMask(uint FrameIndex)
{
#if defined(CHECKERBOARD)
	return (FrameIndex & 1u) == 0u ? 0x99999999u : 0x66666666u;
#elif defined(QUARTER)
	return 0x11111111u << ((0x9cu >> (2u * (FrameIndex & 3u))) & 3u); // opposite corners of the 2×2 follow each other
#else
	return 0xffffffffu;
#endif
}
// Returns a number that pixels have in common if their turns come in the same frames.
uint TurnOf(uint Place)
{
#if defined(CHECKERBOARD)
	return (Place ^ (Place >> 1u)) & 1u;
#else
	return Place % TurnFrames;
#endif
}
// Returns the pixel of this frame that a launch of fewer threads gives to one. It may lie one pixel beyond the picture.
uvec2 TurnPixel(uvec2 Thread, uint FrameIndex)
{
#if defined(CHECKERBOARD)
	return uvec2(Thread.x * 2u + ((Thread.y + FrameIndex) & 1u), Thread.y);
#elif defined(QUARTER)
	uint Place = findLSB(TurnMask(FrameIndex));
	return Thread * 2u + uvec2(Place & 1u, Place >> 1u);
#else
	return Thread;
#endif
}
// Returns how many threads a launch over all pixels of a frame's turn has.
uvec2 TurnThreads(uvec2 Size)
{
#if defined(CHECKERBOARD)
	return uvec2((Size.x + 1u) >> 1u, Size.y);
#elif defined(QUARTER)
	return (Size + 1u) >> 1u;
#else
	return Size;
#endif
}
bool HasTurn(uint FrameIndex, uint Place) { return (TurnMask(FrameIndex) & (1u << (Place & 31u))) != 0u; }

#endif
