// Compiles GLSL to SPIR-V at run time, with glslang as a library and a disk cache. The cache key covers the content of all
// included files, defines, stage, target and compiler version. Thread-safe: many compiles may run at once.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "LanternRHI/RTTypes.h"

namespace Lantern
{

/// A header in memory. It replaces the file of that name, if there is one.
struct FShaderHeader
{
	std::string Include; ///< relative to the search folders; #include lines that resolve to it get Text
	std::string Text;
	std::string Name; ///< for messages, one line; its own quoted includes are searched relative to this path first
	friend bool operator==(const FShaderHeader&, const FShaderHeader&) = default;
};

struct FShaderSource
{
	std::string Path; ///< one line, relative to one of the search folders, e.g. "Rays/ShadowQueue.rgen"
	ERTShaderStage Stage = ERTShaderStage::Compute;
	/// Names and values; part of the key.
	std::vector<std::pair<std::string, std::string>> Defines;
	/// If not empty, this is compiled instead of a file (generated shaders); Path is then for messages only.
	std::string Text;
	std::vector<FShaderHeader> Headers = {}; ///< their texts are part of the key
	std::string Name = {};                   ///< of the binary; empty: Path
	friend bool operator==(const FShaderSource&, const FShaderSource&) = default;
};

struct FShaderBinary
{
	std::vector<uint32_t> Words;
	std::string Name;
	ERTShaderStage Stage = ERTShaderStage::Compute;
	bool bFromCache = false;
	/// Returns a view for the RHI, valid while this object lives and is not moved.
	FRTShaderCode GetCode() const { return {Words.data(), Words.size(), Stage, Name.c_str()}; }
};

struct FShaderCompilerDesc
{
	std::vector<std::string> SearchFolders;  ///< "Shaders" of the plugin first, then the engine's
	std::string CacheFolder;                 ///< empty: no disk cache
	std::vector<FShaderHeader> Headers = {}; ///< for all shaders, behind those of FShaderSource
	bool bDebugInfo = false;
	bool bOptimize = true;
};

struct FShaderCompilerStats
{
	uint64_t Compiled = 0, CacheHits = 0, Failed = 0;
	double CompileMs = 0.0; ///< summed over threads
};

class FShaderCompiler
{
public:
	explicit FShaderCompiler(FShaderCompilerDesc Desc);
	~FShaderCompiler();
	/// Fails with CompileFailed; the message holds glslang's errors as "Path:line: text", where Path may be an included file.
	FRTStatus Compile(const FShaderSource& Source, FShaderBinary& Out);
	/// Returns the cache key (hex), for example to notice an edited file. Empty if a file is missing.
	std::string GetKey(const FShaderSource& Source);
	/// Returns the bytes of the shader's text and of all files that it includes, each counted once. 0 if one is missing.
	size_t GetTextBytes(const FShaderSource& Source);
	FShaderCompilerStats GetStats() const;
	/// Frees what all compilers share (glslang's tables of built-in symbols, 13 MB) before the library is unloaded. No compiler
	/// may exist.
	static void FreeSharedMemory();

private:
	struct FImpl;
	std::unique_ptr<FImpl> Impl;
};

} // namespace Lantern
