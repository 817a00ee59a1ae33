// The surfaces that reflect, where objects have a toon style (FToonStyle).
#pragma once

#include "PassTools.h"

namespace Lantern
{

/// Returns the G-buffer as reflections take it: other BaseColor and Material on objects with a style. FullRoughness: the greatest that does
/// not fade out. GBuffer itself: no object has a style, nobody knows what pixels show, or shaders are being compiled.
FGBuffer AddReflectingToon(FFrameContext& Context, const FGBuffer& GBuffer, float FullRoughness);
void ListReflectingToonShaders(const FSceneFacts& Facts, std::vector<FShaderSource>& Out);

} // namespace Lantern
