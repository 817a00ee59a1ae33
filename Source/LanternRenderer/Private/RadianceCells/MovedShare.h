// Tells the filter of global illumination where objects that move have changed the light (Shaders/DiffuseGI/MovedShare.comp).
#pragma once

#include "LanternRenderer/Frame.h"
#include "PassTools.h"

namespace Lantern
{

void ListMovedShareShaders(std::vector<FShaderSource>& Out);
/// Returns FDenoiseInputs::ChangedShare. Invalid: nothing has moved, so much has that no place is more touched than others, shaders are
/// being compiled, or an error, which the context has.
FGraphTexture AddMovedShare(FFrameContext& Context, const FGBuffer& GBuffer);

} // namespace Lantern
