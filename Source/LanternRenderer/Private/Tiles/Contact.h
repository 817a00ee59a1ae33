// Contact shadows of what casts no rays (Shaders/Tiles/Contact.glsl).
#pragma once

#include "ContactTypes.h"
#include "PassTools.h"

namespace Lantern
{

/// Returns the define of shaders with contact shadows; empty: nothing that is drawn lacks rays.
FShaderDefines MakeContactDefines();
/// Declares what MakeContactConstants needs.
void DeclareContact(FPassBuilder& Builder, const FGBuffer& GBuffer);
/// Fills the constants for the frame's view and scene.
FContactConstants MakeContactConstants(FPassContext& Pass, const FFrameContext& Context, const FGBuffer& GBuffer);

} // namespace Lantern
