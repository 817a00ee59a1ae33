// The sample engine's sky, for hosts that have none: r.Sky.Program.
#pragma once

#include "LanternScene/Scene/Scene.h"

namespace Lantern
{

/// Gives the scene the sky that the variables r.Sky.… say, or takes it away. Time: seconds, by which clouds drift. The scene's uniform sky
/// says how bright it is. Threads: the render thread.
void ApplySampleSky(FRTScene& Scene, double Time);

} // namespace Lantern
