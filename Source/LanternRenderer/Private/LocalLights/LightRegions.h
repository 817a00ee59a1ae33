// Lists of the lights that may reach regions of the screen, for scenes with more lights than a tile can look at.
#pragma once

#include "LanternRenderer/Frame.h"

namespace Lantern
{

/// Returns whether a scene has more lights than a tile looks at without a region's list.
bool NeedsLightRegions(const FSceneFacts& Facts);

/// Returns the pass's shader.
FShaderSource MakeLightRegionsSource(const FSceneFacts& Facts);

/// Adds the pass, and returns FLightRegion[], row by row. After RequireCompute has given its pipeline.
FGraphBuffer AddLightRegions(FFrameContext& Context, const FGBuffer& GBuffer, IRTPipeline* Pipeline);

} // namespace Lantern
