// From a unit to what a link takes: SPIR-V by glslang, and where there are pipeline libraries, one by the driver.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include "Pipelines/RTPSOUnits.h"

namespace Lantern
{

using FShaderBinaryRef = std::shared_ptr<const FShaderBinary>;

/// A compiled version of a unit. Immutable once FUnitCompiler has returned it.
struct FPipelineBuild
{
	uint64_t Id = 0; ///< never used twice
	ERTGroupKind Kind = ERTGroupKind::General;
	std::vector<ERTShaderStage> Stages;
	TRTRef<IRTPipeline> Library;         ///< null: the link compiles Codes itself
	std::vector<FShaderBinaryRef> Codes; ///< empty where there is a library
	bool bEmptyGroup = false;            ///< the library's second group is a hit group without shaders
};
using FPipelineBuildRef = std::shared_ptr<const FPipelineBuild>;

/// SPIR-V of shaders that several units have in common. Each shader is compiled once.
/// Threads: any number at once.
class FSharedShaders
{
public:
	/// Compiles Source, or waits for the thread that is compiling it. Version: FPipelineUnit::Version, or a number that
	/// changes at least as often.
	FRTStatus Get(FShaderCompiler& Compiler, const FShaderSource& Source, uint64_t Version, FShaderBinaryRef& Out);

private:
	struct FEntry
	{
		std::mutex Mutex;
		bool bDone = false;
		FRTStatus Status;
		FShaderBinaryRef Binary;
	};
	std::mutex Mutex; ///< guards Entries, never held during a compile
	std::unordered_map<std::string, std::shared_ptr<FEntry>> Entries;
};

/// All that the compile of one version of a unit needs.
struct FUnitJob
{
	FPipelineUnit Unit;
	uint64_t Version = 0;
	uint64_t BuildId = 0;
	bool bLibrary = false;    ///< the driver makes a library of it
	bool bEmptyGroup = false; ///< which gets a second group, without shaders
	uint32_t PayloadBytes = 0;
	std::shared_ptr<FSharedShaders> Shared;
};

struct FUnitResult
{
	FRTStatus Status;
	FPipelineBuildRef Build; ///< null on an error
	std::string ContentKey;  ///< FUnitCompiler::GetContentKey at the start of the compile
};

/// Threads: any number at once. Blocks for as long as glslang and the driver take.
class FUnitCompiler
{
public:
	/// The device and the shader compiler must outlive it.
	FUnitCompiler(IRTDevice& InDevice, FShaderCompiler& InCompiler) : Device(InDevice), Compiler(InCompiler) {}
	FUnitResult Compile(const FUnitJob& Job) const;
	/// Changes when a shader file of the unit, or a file that it includes, is edited.
	std::string GetContentKey(const FPipelineUnit& Unit) const;

private:
	FRTStatus CompileShaders(const FUnitJob& Job, FPipelineBuild& Build) const;
	FRTStatus CompileLibrary(const FUnitJob& Job, FPipelineBuild& Build) const;

	IRTDevice& Device;
	FShaderCompiler& Compiler;
};

} // namespace Lantern
