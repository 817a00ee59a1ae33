// From a plan to a pipeline.
#pragma once

#include <memory>

#include "Pipelines/RTPSOPlan.h"

namespace Lantern
{

/// Links the builds of a complete plan. Blocks for as long as the driver takes. Any thread.
FRTStatus LinkRTPSO(IRTDevice& Device, const FLinkPlan& Plan, std::shared_ptr<const FRTPSO>& Out);

} // namespace Lantern
