// ESignal::DiffuseGI and ESignal::RoughSpecular: what diffuse and specular lobes reflect of one set of paths.
#pragma once

#include "RayPath.h"

namespace Lantern
{

FPassRays ChooseDiffuseGIRays(const FPassQuery& Query);
bool IsDiffuseGIFiltered(const FRTScene&);
void ListDiffuseGIFilters(const FRTScene&, const FPassQuery& Query, std::vector<FShaderSource>& Out);
FGraphTexture AddDiffuseGIPass(FFrameContext& Context, const FGBuffer& GBuffer);
/// Returns the path by which such a frame keeps radiance cells, if diffuse GI's rays are asked for. None: it keeps none.
ERayPath ChooseCachedLightPath(const FPassQuery& Query);
/// Path None: diffuse GI traces nothing, or reflections of all surfaces are traced. Its rays are those of diffuse GI.
FPassRays ChooseRoughSpecularRays(const FPassQuery& Query);
FGraphTexture AddRoughSpecularPass(FFrameContext& Context, const FGBuffer& GBuffer);

} // namespace Lantern
