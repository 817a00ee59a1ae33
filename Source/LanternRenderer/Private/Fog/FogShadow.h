// Light in fog: shadows of the sun and light of local lights, by froxels, in an atlas that a host's fog reads. One ray of each kind in every
// other slice; the rest is history. AddFogShadowPass and AddFogDepthPass (Frame.h) add the passes.
#pragma once

#include "RayPath.h"

namespace Lantern
{

/// Returns what the pass traces; its path is that of other shadow rays (r.RT.Shadow.Path). Path None: nobody reads it, it is off, or
/// there is no light.
FPassRays ChooseFogRays(const FPassQuery& Query);

/// Path of the shaders that trace, without suffix.
inline constexpr const char* FogShaders = "Fog/FogShadow";

} // namespace Lantern
