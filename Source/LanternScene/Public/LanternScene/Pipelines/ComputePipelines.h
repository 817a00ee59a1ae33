// Compute pipelines by shader and defines. Each is compiled when it is first asked for, and kept.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "LanternCore/Shaders/ShaderCompiler.h"
#include "LanternRHI/RTInterfaces.h"

namespace Lantern
{

/// Threads: one call at a time.
class FComputePipelines
{
public:
	FComputePipelines(IRTDevice& InDevice, FShaderCompiler& InCompiler) : Device(InDevice), Compiler(InCompiler) {}
	/// Out: the pipeline, which lives as long as this object; null on an error. Its name is the path of the shader, followed by
	/// its defines. A shader that does not compile fails again without another compile; a shortage of memory is tried again.
	FRTStatus GetCompute(const FShaderSource& Source, IRTPipeline*& Out);
	size_t GetCount() const { return Entries.size(); }
	/// The sources of all pipelines that were asked for, ordered by name.
	std::vector<FShaderSource> GetSources() const;

private:
	struct FEntry
	{
		FShaderSource Source;
		TRTRef<IRTPipeline> Pipeline;
		FRTStatus Status;
	};
	IRTDevice& Device;
	FShaderCompiler& Compiler;
	std::map<std::string, FEntry> Entries;
};

} // namespace Lantern
