// ESignal::@NAME@: says in one line what the signal is.
#pragma once

#include "RayPath.h"

namespace Lantern
{

FPassRays Choose@NAME@Rays(const FPassQuery& Query);
FGraphTexture Add@NAME@Pass(FFrameContext& Context, const FGBuffer& GBuffer);

} // namespace Lantern
