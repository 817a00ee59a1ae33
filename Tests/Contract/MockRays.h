// Rays on the mock: followed through the geometry in its memory to the record of the table that a GPU would run, and
// what that record's shaders (known by name) would have answered.
#pragma once

#include "ContractShaders.h"

#include "LanternRHIMock/MockDevice.h"

namespace Lantern
{

/// What Trace.rgen (or Call.rgen) writes for each of Width pixels in a row. Records that a GPU would stumble over are
/// test failures.
std::vector<uint32_t> TraceOnMock(
    const FRTMock& Mock, IRTShaderTable* Table, IRTScene* Scene, const FContractPush& Push, uint32_t Width, uint32_t RayGen);

} // namespace Lantern
