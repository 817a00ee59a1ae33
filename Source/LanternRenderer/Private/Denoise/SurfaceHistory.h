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

/// Lists the compute shaders of RequireSurface, but for that of the camera's motion.
void ListSurfaceShaders(std::vector<FShaderSource>& Out);

/// Context.Surface, made where nobody has asked for it in this frame. False: nothing is there, because shaders are being compiled, or
/// an error, which the context then has.
bool RequireSurface(FFrameContext& Context, const FSurfaceInputs& Inputs);

} // namespace Lantern
