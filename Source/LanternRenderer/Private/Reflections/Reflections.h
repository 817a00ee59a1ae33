// ESignal::Reflections: what specular lobes reflect, by brute force so far.
#pragma once

#include "RayPath.h"

namespace Lantern
{

FPassRays ChooseReflectionsRays(const FPassQuery& Query);
FGraphTexture AddReflectionsPass(FFrameContext& Context, const FGBuffer& GBuffer);

} // namespace Lantern
