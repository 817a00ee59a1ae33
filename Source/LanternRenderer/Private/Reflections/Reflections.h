// ESignal::Reflections: what specular lobes reflect, by brute force so far.
#pragma once

#include "RayPath.h"

namespace Lantern
{

FPassRays ChooseReflectionsRays(const FPassQuery& Query);
/// Returns the roughness up to which surfaces have reflections traced. Negative: none have.
float GetReflectedRoughness(const FPassQuery& Query);
/// The same for references, which know no requests.
float GetReflectedRoughnessInReference();
FGraphTexture AddReflectionsPass(FFrameContext& Context, const FGBuffer& GBuffer);

} // namespace Lantern
