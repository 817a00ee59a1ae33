// One RTPSO for benchmarks that need no frames.
#pragma once

#include "LanternScene/Pipelines/RTPSO.h"

namespace Lantern
{

/// Makes an RTPSO at once and without pipeline libraries, so that the driver compiles it as a whole. Every shader of Desc must
/// compile. OutDriverMs, if not null: what the driver took. Call it on the render thread.
FRTStatus MakeWholeRTPSO(IRTDevice& Device, FShaderCompiler& Compiler, const FMaterialPrograms& Programs, const FRTPSODesc& Desc,
    FRTPSO& Out, double* OutDriverMs = nullptr);

} // namespace Lantern
