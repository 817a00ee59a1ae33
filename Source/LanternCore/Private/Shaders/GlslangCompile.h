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

/// Compiles one shader; thread-safe. On failure OutLog holds the errors, one "Path:line: text" a line; on success it holds
/// warnings, if any.
bool CompileWithGlslang(const FGlslangJob& Job, std::vector<uint32_t>& OutWords, std::string& OutLog);

/// Frees what glslang keeps between compilations. No compilation may be running; the next one initialises glslang again.
void FinalizeGlslang();

/// Returns the version of compiler and target, a part of every cache key.
std::string GetGlslangVersion();

} // namespace Lantern
