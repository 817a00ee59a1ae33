// More rays to lamps with an extent, where one ray cannot tell and no history helps (LocalLights/MoreLocalRays.comp).
#pragma once

#include "Rays/ShadowRays.h"

namespace Lantern
{

/// Returns whether a frame of these lights asks for more rays, if its light is filtered: r.RT.Lights.MoreRays.
bool WantsMoreLocalRays(const FSceneFacts& Facts);

/// Lists the compute shaders of AddMoreLocalRays. Defines: of all shaders that sample local lights.
void ListMoreLocalRaysShaders(FShaderDefines Defines, std::vector<FShaderSource>& Out);

/// Adds the passes that ask for more rays and trace them, behind all others to local lights. InOut: gets MoreAnswers and LocalHistory. Reads
/// Depth, Normals and Motion of the G-buffer. Nothing is added while shaders are being compiled.
void AddMoreLocalRays(FFrameContext& Context, const FGBuffer& GBuffer, const FRayDispatch& Dispatch, FShadowRays& InOut,
    FShaderDefines Defines, const FMoreRaysFilter& Filter);

} // namespace Lantern
