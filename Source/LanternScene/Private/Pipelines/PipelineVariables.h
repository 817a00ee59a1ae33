// Console variables that all makers of pipelines share. Render thread.
#pragma once

#include <cstdint>

namespace Lantern
{

/// The number of threads that may compile, at least 1 (r.RT.Pipeline.Threads).
uint32_t GetPipelineThreadCount();
/// The number of frames for which something compiled is kept after its last use (r.RT.Pipeline.KeepFrames).
uint64_t GetPipelineKeepFrames();

} // namespace Lantern
