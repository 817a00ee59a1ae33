// ESignal::DiffuseGI and ESignal::RoughSpecular: what diffuse and specular lobes reflect of one set of paths.
#pragma once

#include "RayPath.h"

namespace Lantern
{

FPassRays ChooseDiffuseGIRays(const FPassQuery& Query);
bool IsDiffuseGIFiltered(const FRTScene&);
void ListDiffuseGIFilters(const FRTScene&, const FPassQuery& Query, std::vector<FShaderSource>& Out);
FGraphTexture AddDiffuseGIPass(FFrameContext& Context, const FGBuffer& GBuffer);
/// Path None: diffuse GI traces nothing, or reflections of all surfaces are traced. Its rays are those of diffuse GI.
FPassRays ChooseRoughSpecularRays(const FPassQuery& Query);
FGraphTexture AddRoughSpecularPass(FFrameContext& Context, const FGBuffer& GBuffer);

} // namespace Lantern
