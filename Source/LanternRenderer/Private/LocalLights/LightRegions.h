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

/// Returns the shader of the same for clusters of emissive triangles.
FShaderSource MakeEmitterRegionsSource(const FSceneFacts& Facts);
/// Returns the size of FLightRegion[], bytes.
uint64_t GetLightRegionBytes(const FFrameContext& Context);
/// Adds the pass that lists clusters. Clusters: the buffer of AddEmitterClusters, which has room for the lists.
void AddEmitterRegions(FFrameContext& Context, const FGBuffer& GBuffer, IRTPipeline* Pipeline, FGraphBuffer Clusters);

} // namespace Lantern
