// ESignal::DiffuseGI: diffuse global illumination, by brute force so far.
#pragma once

#include "RayPath.h"

namespace Lantern
{

FPassRays ChooseDiffuseGIRays(const FPassQuery& Query);
bool IsDiffuseGIFiltered(const FRTScene&);
void ListDiffuseGIFilters(const FRTScene&, std::vector<FShaderSource>& Out);
FGraphTexture AddDiffuseGIPass(FFrameContext& Context, const FGBuffer& GBuffer);

} // namespace Lantern
