// The shader compiler: resolves includes, asks the disk cache, compiles what it lacks.
#include "LanternCore/Shaders/ShaderCompiler.h"

#include <algorithm>
#include <atomic>
#include <cctype>
#include <chrono>

#include "LanternCore/Tasks/TaskTrace.h"
#include "LanternCore/Text/Log.h"
#include "LanternCore/Text/Quote.h"
#include "Shaders/GlslangCompile.h"
#include "Shaders/ShaderDiskCache.h"
#include "Shaders/ShaderIncludes.h"

namespace Lantern
{

namespace
{

bool IsIdentifier(const std::string& Name)
{
	const auto IsWord = [](unsigned char C) { return std::isalnum(C) || C == '_'; };
	return !Name.empty() && !std::isdigit(static_cast<unsigned char>(Name[0])) && std::all_of(Name.begin(), Name.end(), IsWord);
}

/// A name of several lines could forge a line of the compiler's log.
bool IsOneLine(std::string_view Text) { return Text.find_first_of("\n\r") == std::string_view::npos; }

/// Returns what is wrong with the names and defines, or an empty string.
std::string CheckSource(const FShaderSource& Source)
{
	const auto HasOneLine = [](const FShaderHeader& Header) { return IsOneLine(Header.Name); };
	if (!IsOneLine(Source.Path) || !std::all_of(Source.Headers.begin(), Source.Headers.end(), HasOneLine))
	{
		return fmt::format("{}:0: the names of a shader and its headers are one line each", EscapePath(Source.Path));
	}
	for (const auto& [Name, Value] : Source.Defines)
	{
		if (!IsIdentifier(Name) || !IsOneLine(Value))
		{
			return fmt::format("{}:0: define \"{}\" = \"{}\" is not a name and one line of text", EscapePath(Source.Path),
			    EscapeText(Name, MaxQuotedBytes), EscapeText(Value, MaxQuotedBytes));
		}
	}
	return {};
}

std::string MakePreamble(const FShaderSource& Source)
{
	std::string Text = "#extension GL_GOOGLE_include_directive : require\n";
	for (const auto& [Name, Value] : Source.Defines) { Text += fmt::format("#define {} {}\n", Name, Value); }
	return Text;
}

void Append(std::string& Bytes, const void* Data, size_t Size) { Bytes.append(static_cast<const char*>(Data), Size); }

void AppendText(std::string& Bytes, std::string_view Text)
{
	const uint64_t Size = Text.size();
	Append(Bytes, &Size, sizeof(Size));
	Bytes += Text;
}

} // namespace

struct FShaderCompiler::FImpl
{
	explicit FImpl(FShaderCompilerDesc InDesc)
	    : Desc(std::move(InDesc)),
	      Resolver(Desc.SearchFolders, Desc.Headers, Files),
	      Disk(Desc.CacheFolder),
	      Version(GetGlslangVersion())
	{}

	FHash128 MakeKey(const FIncludeTree& Tree, const FShaderSource& Source, const std::string& Preamble) const;
	FRTStatus Fail(const FShaderSource& Source, const std::string& Log);

	const FShaderCompilerDesc Desc;
	FShaderFileCache Files;
	FIncludeResolver Resolver;
	FShaderDiskCache Disk;
	const std::string Version;
	std::atomic<uint64_t> Compiled{0}, CacheHits{0}, Failed{0}, CompileNs{0};
};

FHash128 FShaderCompiler::FImpl::MakeKey(const FIncludeTree& Tree, const FShaderSource& Source, const std::string& Preamble) const
{
	std::string Bytes;
	AppendText(Bytes, Version);
	AppendText(Bytes, Preamble);
	const uint8_t Options[3] = {static_cast<uint8_t>(Source.Stage), Desc.bDebugInfo, Desc.bOptimize};
	Append(Bytes, Options, sizeof(Options));
	// Names reach the binary only with debug information. They are otherwise left out, so that generated shaders of equal text
	// share an entry. Targets say which include line stands for which content.
	for (const FIncludeTree::FNode& Node : Tree.Nodes)
	{
		AppendText(Bytes, Desc.bDebugInfo ? Node.Name : std::string());
		Append(Bytes, &Node.File->Hash, sizeof(FHash128));
		const uint64_t Count = Node.Targets.size();
		Append(Bytes, &Count, sizeof(Count));
		Append(Bytes, Node.Targets.data(), Node.Targets.size() * sizeof(int));
	}
	return HashBytes(Bytes);
}

FRTStatus FShaderCompiler::FImpl::Fail(const FShaderSource& Source, const std::string& Log)
{
	++Failed;
	LogDebug("Shader {} does not compile:\n{}", EscapePath(Source.Path), Log);
	return FRTStatus::Error(ERTResult::CompileFailed, "%s", Log.c_str());
}

FShaderCompiler::FShaderCompiler(FShaderCompilerDesc Desc) : Impl(std::make_unique<FImpl>(std::move(Desc))) {}
FShaderCompiler::~FShaderCompiler() = default;

void FShaderCompiler::FreeSharedMemory() { FinalizeGlslang(); }

FRTStatus FShaderCompiler::Compile(const FShaderSource& Source, FShaderBinary& Out)
{
	FTraceScope Trace("SPIR-V", Source.Path);
	Out = {};
	Out.Name = Source.Name.empty() ? Source.Path : Source.Name;
	Out.Stage = Source.Stage;
	const std::string Wrong = CheckSource(Source);
	if (!Wrong.empty()) { return Impl->Fail(Source, Wrong); }
	const FIncludeTree Tree = Impl->Resolver.Resolve(Source);
	if (!Tree.Error.empty()) { return Impl->Fail(Source, Tree.Error); }
	const std::string Preamble = MakePreamble(Source);
	const FHash128 Key = Impl->MakeKey(Tree, Source, Preamble);
	if (Impl->Disk.Load(Key, Out.Words))
	{
		++Impl->CacheHits;
		Out.bFromCache = true;
		return FRTStatus::Success();
	}

	const auto Start = std::chrono::steady_clock::now();
	FGlslangJob Job{&Tree, Source.Stage, Preamble, Impl->Resolver.GetFoldersText(), Impl->Desc.bDebugInfo, Impl->Desc.bOptimize};
	std::string Log;
	const bool bOk = CompileWithGlslang(Job, Out.Words, Log);
	const auto Time = std::chrono::steady_clock::now() - Start;
	Impl->CompileNs += static_cast<uint64_t>(std::chrono::duration_cast<std::chrono::nanoseconds>(Time).count());
	if (!bOk)
	{
		Out.Words.clear();
		return Impl->Fail(Source, Log);
	}
	if (!Log.empty()) { LogWarning("Shader {}: {}", EscapePath(Source.Path), Log); }
	++Impl->Compiled;
	Impl->Disk.Store(Key, Out.Words);
	return FRTStatus::Success();
}

std::string FShaderCompiler::GetKey(const FShaderSource& Source)
{
	const FIncludeTree Tree = Impl->Resolver.Resolve(Source);
	if (!Tree.Error.empty() || Tree.bMissing) { return {}; }
	return FShaderDiskCache::ToHex(Impl->MakeKey(Tree, Source, MakePreamble(Source)));
}

size_t FShaderCompiler::GetTextBytes(const FShaderSource& Source)
{
	const FIncludeTree Tree = Impl->Resolver.Resolve(Source);
	if (!Tree.Error.empty() || Tree.bMissing) { return 0; }
	size_t Bytes = 0;
	for (const FIncludeTree::FNode& Node : Tree.Nodes) { Bytes += Node.File->Text.size(); }
	return Bytes;
}

FShaderCompilerStats FShaderCompiler::GetStats() const
{
	FShaderCompilerStats Stats;
	Stats.Compiled = Impl->Compiled;
	Stats.CacheHits = Impl->CacheHits;
	Stats.Failed = Impl->Failed;
	Stats.CompileMs = static_cast<double>(Impl->CompileNs) * 1e-6;
	return Stats;
}

} // namespace Lantern
