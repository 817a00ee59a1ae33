#include "LanternScene/RayTracingPipeline.h"

#include <algorithm>
#include <cassert>

#include "LanternCore/Tasks.h"
#include "LanternScene/SectionTable.h"

namespace Lantern
{

namespace
{
void AppendKey(std::string& Key, const FShaderSource& Source)
{
	Key += Source.Path;
	for (const auto& [Name, Value] : Source.Defines) { Key += '|' + Name + '=' + Value; }
	Key += '\n';
}

void AddRayTypeDefines(FShaderSource& Source, const FRTPSODesc& Desc)
{
	Source.Defines.emplace_back("RAY_TYPES", std::to_string(Desc.RayTypes.size()));
	for (size_t Type = 0; Type < Desc.RayTypes.size(); ++Type)
	{
		Source.Defines.emplace_back(Desc.RayTypes[Type].Name + "_RAY", std::to_string(Type));
		Source.Defines.emplace_back(Desc.RayTypes[Type].Name + "_MISS", std::to_string(Type));
	}
}

/// Shaders of a pipeline in the making; each distinct one once.
struct FShaderList
{
	std::vector<FShaderSource> Sources;
	uint32_t Add(FShaderSource Source, ERTShaderStage Stage)
	{
		Source.Stage = Stage;
		std::string Key;
		AppendKey(Key, Source);
		for (size_t I = 0; I < Sources.size(); ++I)
		{
			std::string Other;
			AppendKey(Other, Sources[I]);
			if (Other == Key) { return static_cast<uint32_t>(I); }
		}
		Sources.push_back(std::move(Source));
		return static_cast<uint32_t>(Sources.size() - 1);
	}
};

std::vector<FRTShaderGroup> MakeGroups(const FRTPSODesc& Desc, FShaderList& Shaders)
{
	std::vector<FRTShaderGroup> Groups;
	for (FShaderSource RayGen : Desc.RayGens)
	{
		AddRayTypeDefines(RayGen, Desc);
		Groups.push_back({ERTGroupKind::General, Shaders.Add(std::move(RayGen), ERTShaderStage::RayGen)});
	}
	for (const FRayType& Type : Desc.RayTypes) { Groups.push_back({ERTGroupKind::General, Shaders.Add(Type.Miss, ERTShaderStage::Miss)}); }
	for (int Masked = 0; Masked < (Desc.bMasked ? 2 : 1); ++Masked)
	{
		for (const FRayType& Type : Desc.RayTypes)
		{
			FRTShaderGroup Group{ERTGroupKind::Triangles};
			if (Type.ClosestHit) { Group.ClosestHit = Shaders.Add(*Type.ClosestHit, ERTShaderStage::ClosestHit); }
			if (Masked) { Group.AnyHit = Shaders.Add(Type.MaskedAnyHit, ERTShaderStage::AnyHit); }
			Groups.push_back(Group);
		}
	}
	return Groups;
}
} // namespace

std::string FRTPSO::MakeKey(const FRTPSODesc& Desc)
{
	std::string Key = Desc.bMasked ? "masked\n" : "opaque\n";
	for (const FShaderSource& RayGen : Desc.RayGens) { AppendKey(Key, RayGen); }
	for (const FRayType& Type : Desc.RayTypes) { Key += Type.Name + '\n'; }
	return Key;
}

FRTStatus FRTPSO::Create(IRTDevice& Device, FShaderCompiler& Compiler, const FRTPSODesc& Desc, FRTPSO& Out)
{
	FShaderList Shaders;
	const std::vector<FRTShaderGroup> Groups = MakeGroups(Desc, Shaders);
	const size_t Count = Shaders.Sources.size();
	std::vector<FShaderBinary> Binaries(Count);
	std::vector<FRTStatus> Results(Count);
	ParallelFor(Count, 1, [&](size_t Begin, size_t End) {
		for (size_t I = Begin; I < End; ++I) { Results[I] = Compiler.Compile(Shaders.Sources[I], Binaries[I]); }
	});
	for (const FRTStatus& Result : Results)
	{
		if (!Result) { return Result; }
	}
	std::vector<FRTShaderCode> Codes;
	for (const FShaderBinary& Binary : Binaries) { Codes.push_back(Binary.GetCode()); }

	FRTRayTracingPipelineDesc Pipeline;
	Pipeline.Shaders = Codes.data();
	Pipeline.ShaderCount = static_cast<uint32_t>(Codes.size());
	Pipeline.Groups = Groups.data();
	Pipeline.GroupCount = static_cast<uint32_t>(Groups.size());
	Pipeline.MaxPayloadBytes = 4;
	for (const FRayType& Type : Desc.RayTypes) { Pipeline.MaxPayloadBytes = std::max(Pipeline.MaxPayloadBytes, Type.PayloadBytes); }
	Pipeline.Name = "RTPSO";
	Out.RayTypeCount = static_cast<uint32_t>(Desc.RayTypes.size());
	Out.RayGenCount = static_cast<uint32_t>(Desc.RayGens.size());
	Out.bMasked = Desc.bMasked;
	return Device.CreateRayTracingPipeline(Pipeline, Out.Pipeline.ReleaseAndGetAddress());
}

void FShaderBindings::WriteSection(const FRTPSO& Pipeline, const FSectionTable& Sections, uint32_t Section)
{
	const FSectionData& Data = Sections.Get(Section);
	const uint32_t Types = Pipeline.GetRayTypeCount();
	for (uint32_t Type = 0; Type < Types; ++Type)
	{
		const uint32_t Group = Pipeline.HitGroup(Type, (Data.Flags & SECTION_MASKED) != 0);
		Table->SetRecord(ERTRecordKind::Hit, Section * Types + Type, Group, &Data, sizeof(Data));
	}
	RecordsWritten += Types;
}

FRTStatus FShaderBindings::Sync(IRTCommandList& List, const FRTPSO& Pipeline, FSectionTable& Sections)
{
	static_assert(sizeof(FSectionData) <= MaxRecordDataBytes);
	RecordsWritten = 0;
	std::vector<uint32_t> Changed = Sections.TakeChanged();
	const uint32_t Needed = std::max(1u, Sections.GetCapacity() * Pipeline.GetRayTypeCount());
	if (!Table || Bound != Pipeline.GetPipeline() || BoundSections != &Sections || Table->GetDesc().HitCount < Needed)
	{
		FRTShaderTableDesc Desc;
		Desc.Pipeline = Pipeline.GetPipeline();
		Desc.RayGenCount = Pipeline.GetRayGenCount();
		Desc.MissCount = Pipeline.GetRayTypeCount();
		Desc.HitCount = Table && Table->GetDesc().HitCount >= Needed ? Table->GetDesc().HitCount : Needed + Needed / 2;
		Desc.RecordDataBytes = sizeof(FSectionData);
		Desc.Name = "ShaderTable";
		if (FRTStatus S = Device.CreateShaderTable(Desc, Table.ReleaseAndGetAddress()); !S) { return S; }
		Bound = Pipeline.GetPipeline();
		BoundSections = &Sections;
		for (uint32_t I = 0; I < Pipeline.GetRayGenCount(); ++I) { Table->SetRecord(ERTRecordKind::RayGen, I, Pipeline.RayGenGroup(I), nullptr, 0); }
		for (uint32_t I = 0; I < Pipeline.GetRayTypeCount(); ++I) { Table->SetRecord(ERTRecordKind::Miss, I, Pipeline.MissGroup(I), nullptr, 0); }
		for (uint32_t Section = 0; Section < Sections.GetCapacity(); ++Section) { WriteSection(Pipeline, Sections, Section); }
	}
	else
	{
		if (Changed.empty()) { return FRTStatus::Success(); }
		for (const uint32_t Section : Changed) { WriteSection(Pipeline, Sections, Section); }
	}
	List.UpdateShaderTable(Table.Get());
	return FRTStatus::Success();
}

} // namespace Lantern
