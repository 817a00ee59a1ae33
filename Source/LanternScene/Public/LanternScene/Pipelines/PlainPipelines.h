// Plain pipelines: compute and raster ones, which have one or two shaders each. Threads of their own compile them beside the frames,
// first by glslang and then by the driver. A frame uses what is ready (Find), or waits for a complete picture (Get).
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "LanternCore/Shaders/ShaderCompiler.h"
#include "LanternRHI/RTInterfaces.h"

namespace Lantern
{

/// What a raster pipeline is made from. It tests and writes reversed depth.
struct FRasterSource
{
	std::string Key;       ///< says which pipeline it is, among all raster pipelines of an FPlainPipelines
	uint32_t Revision = 0; ///< of the pipeline. It changes with anything below
	std::string Name;      ///< for messages
	FShaderSource Vertex, Fragment;
	std::vector<ERTFormat> ColorFormats;
	ERTFormat DepthFormat = ERTFormat::Unknown;
	ERTCull Cull = ERTCull::Back;
};

/// A compute pipeline's name is the path of its shader, followed by its defines. A shader that does not compile fails again without
/// another compile. A shortage of memory is tried again: by each Get and Finish, and some frames later by Find. A raster pipeline
/// of another revision is compiled anew. The one before serves meanwhile, or for good if the new one does not compile.
/// Threads: the render thread, one call at a time.
class FPlainPipelines
{
public:
	/// The references must outlive it.
	FPlainPipelines(IRTDevice& Device, FShaderCompiler& Compiler);
	/// Waits for compiles that a driver is in the middle of, and forgets those that have not been started.
	~FPlainPipelines();
	FPlainPipelines(const FPlainPipelines&) = delete;
	FPlainPipelines& operator=(const FPlainPipelines&) = delete;

	/// Starts a frame. Drops pipelines that nobody has asked for in r.RT.Pipeline.KeepFrames frames. Never waits.
	void BeginFrame();
	/// Starts the compiles of those that are missing, in this order. Never waits.
	void Want(const std::vector<FShaderSource>& Sources);
	/// Returns what there is, and starts the compile if there is nothing. Never waits. Out: the pipeline, valid until the next
	/// BeginFrame; null while it is being compiled, which is no error, and on an error. A raster pipeline's is that of the revision
	/// before in such cases, if there is one.
	FRTStatus Find(const FShaderSource& Source, IRTPipeline*& Out);
	FRTStatus Find(const FRasterSource& Source, IRTPipeline*& Out);
	/// Waits for the compile. Out: as Find.
	FRTStatus Get(const FShaderSource& Source, IRTPipeline*& Out);
	FRTStatus Get(const FRasterSource& Source, IRTPipeline*& Out);
	/// Waits until all are compiled or have failed; the result is the first error. Progress (0 to 1) may be empty.
	FRTStatus Finish(const std::vector<FShaderSource>& Sources, const std::function<void(float)>& Progress);

	/// Whether something was last found missing since BeginFrame, and is being compiled or waits for memory.
	bool IsAnyToCome() const;
	size_t GetCount() const;
	/// The sources of all compute pipelines that are kept, ordered by name.
	std::vector<FShaderSource> GetComputeSources() const;
	/// The sources of all raster pipelines that are kept, ordered by key.
	std::vector<FRasterSource> GetRasterSources() const;

private:
	struct FImpl;
	std::unique_ptr<FImpl> Impl;
};

} // namespace Lantern
