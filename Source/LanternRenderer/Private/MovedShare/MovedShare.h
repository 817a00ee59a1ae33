// Tells the filters of indirect light where objects that move have changed it (Shaders/MovedShare/MovedShare.comp).
#pragma once

#include "LanternRenderer/Frame.h"
#include "PassTools.h"

namespace Lantern
{

void ListMovedShareShaders(std::vector<FShaderSource>& Out);
/// What the light comes from: all around, or within the specular lobe of each pixel's surface.
enum class ELightFrom : uint8_t
{
	Around,
	SpecularLobe
};

/// Returns FDenoiseInputs::ChangedShare. Invalid: nothing has moved, so much has that no place is more touched than others, shaders are
/// being compiled, or an error, which the context has.
/// Shown: with SpecularLobe, FDenoiseInputs::Surface that has what mirrors show in place of their own surface.
/// Changes: FPathChange of the tiles of the light's paths; invalid: nobody knows.
FGraphTexture AddMovedShare(
    FFrameContext& Context, const FGBuffer& GBuffer, ELightFrom From, FGraphTexture Shown = {}, FGraphBuffer Changes = {});

} // namespace Lantern
