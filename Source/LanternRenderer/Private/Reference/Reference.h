// The reference path tracer's shaders: of the whole frame, or of one signal.
#pragma once

#include "RayPath.h"

namespace Lantern
{

/// bFromGBuffer: at the surfaces that the raster saw.
FPassRays ChooseReferenceRays(const FRTCapabilities& Capabilities, const FSceneFacts& Facts, ESignal Signal, bool bFromGBuffer);
/// Names the ray generation shader: a signal's lies in its own folder, <Pass>/<Pass>Reference.rgen.
std::string GetReferencePath(ESignal Signal);

} // namespace Lantern
