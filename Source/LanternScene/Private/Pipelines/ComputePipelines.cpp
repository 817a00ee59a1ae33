// Compute pipelines, compiled when they are first asked for.
#include "LanternScene/Pipelines/ComputePipelines.h"

namespace Lantern
{

FRTStatus FComputePipelines::GetCompute(const FShaderSource& Source, IRTPipeline*& Out)
{
	std::string Key = Source.Path;
	for (const auto& [Name, Value] : Source.Defines) { Key += ' ' + Name + (Value == "1" ? "" : '=' + Value); }
	FEntry& Entry = Entries[Key];
	// A compile error stays; a shortage of memory passes.
	if (!Entry.Pipeline && Entry.Status.Code != ERTResult::CompileFailed)
	{
		Entry.Source = Source;
		FShaderBinary Binary;
		Entry.Status = Compiler.Compile(Source, Binary);
		if (Entry.Status)
		{
			FRTComputePipelineDesc Desc;
			Desc.Shader = Binary.GetCode();
			Desc.Name = Key.c_str();
			Entry.Status = Device.CreateComputePipeline(Desc, Entry.Pipeline.ReleaseAndGetAddress());
		}
	}
	Out = Entry.Pipeline.Get();
	return Entry.Status;
}

std::vector<FShaderSource> FComputePipelines::GetSources() const
{
	std::vector<FShaderSource> Sources;
	for (const auto& [Key, Entry] : Entries) { Sources.push_back(Entry.Source); }
	return Sources;
}

} // namespace Lantern
