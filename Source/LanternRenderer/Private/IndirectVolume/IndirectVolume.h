// Indirect light in the air by froxels, for fog, particles and translucent surfaces (Shaders/IndirectVolume/). AddIndirectVolumePass (Frame.h)
// adds the passes. Its paths end in radiance cells, so it is made where diffuse GI keeps these (r.RT.GI 2 and 3).
#pragma once

#include "RayPath.h"

namespace Lantern
{

/// Returns what the pass traces; its path is that of the pass that keeps radiance cells. Path None: nobody reads it, it is off, or there are no
/// cells or no light.
FPassRays ChooseIndirectVolumeRays(const FPassQuery& Query);

/// Path of the shaders that trace, without suffix.
inline constexpr const char* IndirectVolumeShaders = "IndirectVolume/IndirectVolume";

/// Returns how many of its look-ups may vote in the frame. 0: it is not made.
uint32_t CountIndirectVolumeVoters(const FFrameContext& Context);

} // namespace Lantern
