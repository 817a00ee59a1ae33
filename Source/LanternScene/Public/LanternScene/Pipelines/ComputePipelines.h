// Compute pipelines by shader and defines, compiled on first use and kept.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "LanternCore/Shaders/ShaderCompiler.h"
#include "LanternRHI/RTInterfaces.h"

namespace Lantern
{

/// One thread at a time.
class FComputePipelines
{
public:
	FComputePipelines(IRTDevice& InDevice, FShaderCompiler& InCompiler) : Device(InDevice), Compiler(InCompiler) {}
	/// Out lives as long as the cache; its name is the shader's path and the names of its defines. A shader that failed
	/// to compile fails again without being compiled again.
	FRTStatus GetCompute(const FShaderSource& Source, IRTPipeline*& Out);
	size_t GetCount() const { return Entries.size(); }
	/// Of all that was asked for, in the order of their names.
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
