// ESignal::Reflections: what specular lobes reflect, by paths that end in radiance cells or by brute force.
#pragma once

#include "RayPath.h"

namespace Lantern
{

/// For r.RT.Debug.View: where what mirrors show was in the frame before. Needs the filter.
inline constexpr const char* ReflectionPictures[] = {"reflection_motion", nullptr};

FPassRays ChooseReflectionsRays(const FPassQuery& Query);
/// Returns the roughness up to which reflections hold their share of emission. Negative: none do.
float GetReflectedRoughness(const FPassQuery& Query);
/// The same for references, which know no requests.
float GetReflectedRoughnessInReference();
bool AreReflectionsFiltered(const FRTScene&);
void ListReflectionFilters(const FRTScene&, const FPassQuery& Query, std::vector<FShaderSource>& Out);
/// Returns the surfaces that reflect: the G-buffer, but for objects with a style (AddReflectingToon).
FGBuffer AddReflectingSurface(FFrameContext& Context, const FGBuffer& GBuffer);
/// Later calls of a frame return what the first one did.
FGraphTexture AddReflectionsPass(FFrameContext& Context, const FGBuffer& GBuffer);

} // namespace Lantern
