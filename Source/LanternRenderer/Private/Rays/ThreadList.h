// Lists of threads that a later launch runs (Shaders/Rays/ThreadList.glsl), so that neighbours in the launch do the same.
#pragma once

#include <cstddef>

#include "RayPath.h"
#include "RayQueueTypes.h"
#include "ThreadListTypes.h"

namespace Lantern
{

/// Adds a pass of Name that makes an empty list. Most: threads that it has room for, 1 or more.
FGraphBuffer AddThreadList(FFrameContext& Context, uint64_t Most, const char* Name);

/// Declares that a pass adds to a list.
inline void AppendToThreadList(FPassBuilder& Builder, FGraphBuffer List)
{
	Builder.Read(List, ERTAccess::StorageRead);
	Builder.Write(List, ERTAccess::StorageWrite);
}

/// Declares that a pass launches a list.
inline void LaunchFromThreadList(FPassBuilder& Builder, FGraphBuffer List)
{
	Builder.Read(List, ERTAccess::ShaderRead);
	Builder.Read(List, ERTAccess::IndirectRead);
}

/// Runs a compute shader for each thread of a list.
template <class T>
void DispatchThreadList(FPassContext& Pass, IRTPipeline* Pipeline, FGraphBuffer List, const T& Constants)
{
	Pass.Commands().SetPipeline(Pipeline);
	Pass.Commands().PushConstants(&Constants, sizeof(Constants));
	Pass.Commands().DispatchIndirect(Pass.GetBuffer(List), offsetof(FThreadList, Groups));
}

/// Does so on either path. A device without indirect traces launches Width × Height threads: enough for the whole list.
template <class T>
void TraceThreadList(FPassContext& Pass, const FFrameContext& Frame, const FRayDispatch& Dispatch, FGraphBuffer List, const T& Constants,
    uint32_t Width, uint32_t Height)
{
	if (Dispatch.Compute) { return DispatchThreadList(Pass, Dispatch.Compute, List, Constants); }
	if (!Frame.Device.GetCapabilities().bIndirectTrace) { return TraceFrameRays(Pass, Frame, Dispatch.RayGen, Constants, Width, Height); }
	Pass.Commands().SetPipeline(Frame.RayPipeline->GetPipeline());
	Pass.Commands().PushConstants(&Constants, sizeof(Constants));
	Pass.Commands().TraceRaysIndirect(Frame.RayTable->GetTable(), Dispatch.RayGen, Pass.GetBuffer(List), offsetof(FThreadList, Launch));
}

} // namespace Lantern
