// What each pixel shows (distance, normal, object), packed into eight bytes and kept for the next frame. One for all passes
// that reproject.
#pragma once

#include "LanternRenderer/Frame.h"

namespace Lantern
{

struct FSurfaceInputs
{
	FGraphTexture Depth, Normals, Motion; ///< as in FGBuffer; Motion may be invalid: then that of a world that stands still
};

/// Context.Surface, made where nobody has asked for it in this frame. False: an error that the context has; nothing is there.
bool RequireSurface(FFrameContext& Context, const FSurfaceInputs& Inputs);

} // namespace Lantern
