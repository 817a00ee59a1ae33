// The composite's fog, for hosts that have none: it reads the atlas of fog shadows as a host's own fog would.
#pragma once

#include "LanternRenderer/Frame.h"

namespace Lantern
{

/// Returns whether the composite has fog (r.Fog.Density).
bool HasHeightFog();
/// r.Fog.Phase, as FSignalRequests::FogPhase.
float GetHeightFogPhase();
/// Makes the source of the fog's shader.
FShaderSource MakeHeightFogSource(const FSceneFacts& Facts);

/// Returns Lighting behind fog, RGBA32_FLOAT. Lighting itself: there is no fog, or its shader is being compiled.
FGraphTexture AddHeightFogPass(
    FFrameContext& Context, const FGBuffer& GBuffer, FGraphTexture Lighting, const FFogAtlas& Fog, const FIndirectVolume& Volume);

} // namespace Lantern
