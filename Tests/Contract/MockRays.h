// Rays on the mock. They are followed through the geometry in its memory to the record that a GPU would run. The record's
// shaders, known by name, say what they would have answered.
#pragma once

#include "ContractShaders.h"

#include "LanternRHIMock/MockDevice.h"

namespace Lantern
{

/// Returns what Trace.rgen or Call.rgen writes for each of Width pixels in a row. Records that would be wrong on a GPU are test
/// failures.
std::vector<uint32_t> TraceOnMock(
    const FRTMock& Mock, IRTShaderTable* Table, IRTScene* Scene, const FContractPush& Push, uint32_t Width, uint32_t RayGen);

} // namespace Lantern
