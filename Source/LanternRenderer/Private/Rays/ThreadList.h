// Lists of threads that a later launch runs (Shaders/Rays/ThreadList.glsl), so that neighbours in the launch do the same.
#pragma once

#include <cstddef>
#include <string>

#include "RayPath.h"
#include "RayQueueTypes.h"
#include "ThreadListTypes.h"

namespace Lantern
{

/// A list, and the size of the launch whose threads passes mark for it.
struct FThreadMarks
{
	FGraphBuffer List;
	std::string Name;
	uint32_t Width = 0, Height = 0; ///< 1 or more, if there is a list
	bool IsValid() const { return List.IsValid(); }
};

/// The shader of AddThreadOrder. Passes with a list ask for it before they add one.
FShaderSource MakeThreadOrderSource();

/// Adds a pass of Name that makes a list without marks.
FThreadMarks AddThreadMarks(FFrameContext& Context, uint32_t Width, uint32_t Height, std::string Name);

/// Adds the pass that lists what has been marked. From: bits stand for its entries; invalid: for threads. GroupSize: entries that a work group
/// of the later launch takes.
void AddThreadOrder(FFrameContext& Context, const FThreadMarks& Marks, FGraphBuffer From = {}, uint32_t GroupSize = RAY_QUEUE_GROUP_SIZE);

/// Declares that a pass marks threads.
inline void MarkThreads(FPassBuilder& Builder, FGraphBuffer List)
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
