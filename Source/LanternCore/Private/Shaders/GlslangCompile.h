// The one file that knows glslang.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "LanternRHI/RTTypes.h"
#include "Shaders/ShaderIncludes.h"

namespace Lantern
{

struct FGlslangJob
{
	const FIncludeTree* Tree = nullptr;
	ERTShaderStage Stage = ERTShaderStage::Compute;
	std::string Preamble; ///< stands before the text without counting as lines
	std::string SearchedFolders;
	bool bDebugInfo = false;
	bool bOptimize = true;
};

/// False: OutLog holds the errors, one "Path:line: text" per line. True: OutLog holds warnings, if any.
/// Any number may run at once.
bool CompileWithGlslang(const FGlslangJob& Job, std::vector<uint32_t>& OutWords, std::string& OutLog);

/// Frees what glslang keeps between compilations. None may be running; the next one starts it anew.
void FinalizeGlslang();

/// Version of compiler and target: part of every cache key.
std::string GetGlslangVersion();

} // namespace Lantern
