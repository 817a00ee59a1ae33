// A buffer that a pass keeps for its next frame: this frame's half, and that of the frame before.
#pragma once

#include "PassTools.h"

namespace Lantern
{

struct FTwoFrames
{
	FGraphBuffer Buffer;
	uint64_t Offset = 0, PreviousOffset = 0; ///< of the halves, bytes
	bool bPrevious = false;                  ///< the last frame of this view wrote the other half, and there was no cut
};

/// Bytes: of a half. False: there is no memory, which the context then has as an error.
bool RequireTwoFrames(FFrameContext& Context, const char* Name, uint64_t Bytes, FTwoFrames& Out);

} // namespace Lantern
