// Console variables of the RTPSO compiler and of plain pipelines.
#include "Pipelines/PipelineVariables.h"

#include <algorithm>
#include <thread>

#include "LanternCore/Config/ConsoleVariables.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<int32_t> CVarThreads("r.RT.Pipeline.Threads", 0,
    "Number of threads that compile pipelines. 0: one less than the machine has cores, at least one.", {0, 256});
TRTConsoleVariable<int32_t> CVarKeepFrames("r.RT.Pipeline.KeepFrames", 1000,
    "Number of frames for which compiled shaders, compute and raster pipelines are kept after their last use.", {1, 1e6});

const uint32_t Cores = std::max(1u, std::thread::hardware_concurrency()); // asked once: it reads a file
} // namespace

uint32_t GetPipelineThreadCount()
{
	const int32_t Asked = CVarThreads.GetOnRenderThread();
	return Asked > 0 ? static_cast<uint32_t>(Asked) : std::max(1u, Cores - 1);
}

uint64_t GetPipelineKeepFrames() { return static_cast<uint64_t>(CVarKeepFrames.GetOnRenderThread()); }

} // namespace Lantern
