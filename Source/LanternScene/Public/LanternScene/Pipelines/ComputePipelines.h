// Compute pipelines by shader and defines. Threads of their own compile them beside the frames, first by glslang and then by the
// driver. A frame uses what is ready (Find), or waits for a complete picture (GetCompute).
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "LanternCore/Shaders/ShaderCompiler.h"
#include "LanternRHI/RTInterfaces.h"

namespace Lantern
{

/// A pipeline's name is the path of its shader, followed by its defines. A shader that does not compile fails again without
/// another compile. A shortage of memory is tried again: by each GetCompute and Finish, and some frames later by Find.
/// Threads: the render thread, one call at a time.
class FComputePipelines
{
public:
	/// The references must outlive it.
	FComputePipelines(IRTDevice& Device, FShaderCompiler& Compiler);
	/// Waits for compiles that a driver is in the middle of, and forgets those that have not been started.
	~FComputePipelines();
	FComputePipelines(const FComputePipelines&) = delete;
	FComputePipelines& operator=(const FComputePipelines&) = delete;

	/// Starts a frame. Drops pipelines that nobody has asked for in r.RT.Pipeline.KeepFrames frames. Never waits.
	void BeginFrame();
	/// Starts the compiles of those that are missing, in this order. Never waits.
	void Want(const std::vector<FShaderSource>& Sources);
	/// Returns what there is, and starts the compile if there is nothing. Never waits. Out: the pipeline, valid until the next
	/// BeginFrame; null on an error, and with Ok while it is being compiled.
	FRTStatus Find(const FShaderSource& Source, IRTPipeline*& Out);
	/// Waits for the compile. Out: as Find; null on an error only.
	FRTStatus GetCompute(const FShaderSource& Source, IRTPipeline*& Out);
	/// Waits until all are compiled or have failed; the result is the first error. Progress (0 to 1) may be empty.
	FRTStatus Finish(const std::vector<FShaderSource>& Sources, const std::function<void(float)>& Progress);

	/// Whether something that was asked for since BeginFrame is being compiled, or waits for memory.
	bool IsAnyToCome() const;
	size_t GetCount() const;
	/// The sources of all pipelines that are kept, ordered by name.
	std::vector<FShaderSource> GetSources() const;

private:
	struct FImpl;
	std::unique_ptr<FImpl> Impl;
};

} // namespace Lantern
