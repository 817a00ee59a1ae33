// ESignal::DiffuseGI: diffuse global illumination, by brute force so far.
#pragma once

#include "RayPath.h"

namespace Lantern
{

FPassRays ChooseDiffuseGIRays(const FPassQuery& Query);
FGraphTexture AddDiffuseGIPass(FFrameContext& Context, const FGBuffer& GBuffer);

} // namespace Lantern
