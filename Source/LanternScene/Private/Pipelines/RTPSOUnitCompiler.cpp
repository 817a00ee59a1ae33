// The compile of one unit, by glslang and by the driver.
#include "Pipelines/RTPSOUnitCompiler.h"

namespace Lantern
{

FRTStatus FSharedShaders::Get(FShaderCompiler& Compiler, const FShaderSource& Source, uint64_t Version, FShaderBinaryRef& Out)
{
	std::string Key = MakeSourceKey(Source) + '|' + Source.Name + '|' + std::to_string(Version);
	for (const FShaderHeader& Header : Source.Headers) { Key += '|' + Header.Text; }
	std::shared_ptr<FEntry> Entry;
	{
		const std::lock_guard Lock(Mutex);
		std::shared_ptr<FEntry>& Found = Entries[Key];
		if (!Found) { Found = std::make_shared<FEntry>(); }
		Entry = Found;
	}
	const std::lock_guard Lock(Entry->Mutex);
	if (!Entry->bDone)
	{
		auto Binary = std::make_shared<FShaderBinary>();
		Entry->Status = Compiler.Compile(Source, *Binary);
		Entry->Binary = std::move(Binary);
		Entry->bDone = true;
	}
	Out = Entry->Binary;
	return Entry->Status;
}

std::string FUnitCompiler::GetContentKey(const FPipelineUnit& Unit) const
{
	std::string Key;
	for (size_t I = 0; I < Unit.Shaders.size(); ++I) { Key += Compiler.GetKey(Unit.GetSource(I)) + ' '; }
	return Key;
}

FUnitResult FUnitCompiler::Compile(const FUnitJob& Job) const
{
	FUnitResult Result;
	Result.ContentKey = GetContentKey(Job.Unit);
	auto Build = std::make_shared<FPipelineBuild>();
	Build->Id = Job.BuildId;
	Result.Status = CompileShaders(Job, *Build);
	if (Result.Status && Job.bLibrary) { Result.Status = CompileLibrary(Job, *Build); }
	if (Result.Status) { Result.Build = std::move(Build); }
	return Result;
}

FRTStatus FUnitCompiler::CompileShaders(const FUnitJob& Job, FPipelineBuild& Build) const
{
	Build.Kind = Job.Unit.Kind;
	for (size_t I = 0; I < Job.Unit.Shaders.size(); ++I)
	{
		Build.Stages.push_back(Job.Unit.Shaders[I].Stage);
		FShaderBinaryRef& Code = Build.Codes.emplace_back();
		if (FRTStatus S = Job.Shared->Get(Compiler, Job.Unit.GetSource(I), Job.Version, Code); !S) { return S; }
	}
	return FRTStatus::Success();
}

FRTStatus FUnitCompiler::CompileLibrary(const FUnitJob& Job, FPipelineBuild& Build) const
{
	std::vector<FRTShaderCode> Codes;
	std::vector<uint32_t> Indices;
	for (const FShaderBinaryRef& Binary : Build.Codes)
	{
		Indices.push_back(static_cast<uint32_t>(Codes.size()));
		Codes.push_back(Binary->GetCode());
	}
	const FRTShaderGroup Groups[] = {MakeGroup(Build.Kind, Build.Stages, Indices), {ERTGroupKind::Triangles}};
	FRTRayTracingPipelineDesc Desc;
	Desc.Shaders = Codes.data();
	Desc.ShaderCount = static_cast<uint32_t>(Codes.size());
	Desc.Groups = Groups;
	Build.bEmptyGroup = Job.bEmptyGroup;
	Desc.GroupCount = Build.bEmptyGroup ? 2 : 1;
	Desc.bLibrary = true;
	Desc.MaxPayloadBytes = Job.PayloadBytes;
	Desc.Name = Job.Unit.Name.c_str();
	const FRTStatus Status = Device.CreateRayTracingPipeline(Desc, Build.Library.ReleaseAndGetAddress());
	Build.Codes.clear();
	return Status;
}

} // namespace Lantern
