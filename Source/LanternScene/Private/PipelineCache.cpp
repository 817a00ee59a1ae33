#include "LanternScene/PipelineCache.h"

namespace Lantern
{

FRTStatus FPipelineCache::GetCompute(const FShaderSource& Source, IRTPipeline*& Out)
{
	std::string Key = Source.Path;
	for (const auto& [Name, Value] : Source.Defines) { Key += '|' + Name + '=' + Value; }
	auto [It, bNew] = Entries.try_emplace(Key);
	FEntry& Entry = It->second;
	if (bNew)
	{
		FShaderBinary Binary;
		Entry.Status = Compiler.Compile(Source, Binary);
		if (Entry.Status)
		{
			FRTComputePipelineDesc Desc;
			Desc.Shader = Binary.GetCode();
			Desc.Name = Source.Path.c_str();
			Entry.Status = Device.CreateComputePipeline(Desc, Entry.Pipeline.ReleaseAndGetAddress());
		}
	}
	Out = Entry.Pipeline.Get();
	return Entry.Status;
}

} // namespace Lantern
