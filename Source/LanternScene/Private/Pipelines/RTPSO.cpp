#include "LanternScene/Pipelines/RTPSO.h"

#include <atomic>
#include <cassert>
#include <map>

#include "LanternCore/Tasks/Tasks.h"
#include "Pipelines/RTPSOUnits.h"

namespace Lantern
{

namespace
{
/// Shaders and groups of a pipeline without libraries; each distinct shader once.
struct FMonolith
{
	std::vector<FShaderSource> Sources;
	std::vector<FRTShaderGroup> Groups;
	std::map<std::string, uint32_t> Known;

	uint32_t AddGroup(const FPipelineUnit& Unit)
	{
		std::vector<uint32_t> Indices;
		std::vector<ERTShaderStage> Stages;
		for (size_t I = 0; I < Unit.Shaders.size(); ++I)
		{
			FShaderSource Source = Unit.GetSource(I);
			Stages.push_back(Source.Stage);
			const auto [It, bNew] = Known.try_emplace(MakeSourceKey(Source) + Source.Name, static_cast<uint32_t>(Sources.size()));
			if (bNew) { Sources.push_back(std::move(Source)); }
			Indices.push_back(It->second);
		}
		Groups.push_back(MakeGroup(Unit.Kind, Stages, Indices));
		return static_cast<uint32_t>(Groups.size() - 1);
	}
};

FRTPSOLayout AddGroups(const FRTPSODesc& Desc, const FMaterialPrograms& Programs, FMonolith& Monolith)
{
	FRTPSOLayout Layout;
	Layout.RayGens = Desc.RayGens;
	const uint32_t Types = static_cast<uint32_t>(Desc.RayTypes.size());
	for (uint32_t I = 0; I < Desc.RayGens.size(); ++I) { Layout.RayGenGroups.push_back(Monolith.AddGroup(MakeRayGenUnit(Desc, I))); }
	for (uint32_t I = 0; I < Types; ++I) { Layout.MissGroups.push_back(Monolith.AddGroup(MakeMissUnit(Desc, I))); }
	for (uint32_t I = 0; I < Desc.Callables.size(); ++I) { Layout.CallableGroups.push_back(Monolith.AddGroup(MakeCallableUnit(Desc, I))); }
	Layout.EmptyHitGroup = static_cast<uint32_t>(Monolith.Groups.size());
	Monolith.Groups.push_back({ERTGroupKind::Triangles});
	for (const FHitProgram Program : Desc.HitPrograms)
	{
		FRTPSOLayout::FHit& Hit = Layout.Hits.emplace_back();
		Hit.Program = Program;
		Hit.State = ERTHitState::Ready;
		for (uint32_t Type = 0; Type < Types; ++Type)
		{
			const FPipelineUnit Unit = MakeHitUnit(Desc, Type, Program, Programs);
			Hit.Groups.push_back(Unit.Shaders.empty() ? Layout.EmptyHitGroup : Monolith.AddGroup(Unit));
		}
	}
	return Layout;
}
} // namespace

std::vector<FShaderSource> ListShaders(const FRTPSODesc& Desc, const FMaterialPrograms& Programs)
{
	FMonolith Monolith;
	AddGroups(Desc, Programs, Monolith);
	return std::move(Monolith.Sources);
}

FRTPSO::FRTPSO(TRTRef<IRTPipeline> InPipeline, FRTPSOLayout InLayout) : Pipeline(std::move(InPipeline)), Layout(std::move(InLayout))
{
	static std::atomic<uint64_t> NextRevision{1};
	Revision = NextRevision++;
	const uint32_t Types = GetRayTypeCount();
	for (const FRTPSOLayout::FHit& Hit : Layout.Hits)
	{
		std::vector<uint32_t>& StandIn = Layout.StandIns[static_cast<size_t>(Hit.Program.Class)];
		const bool bServes = Layout.bStandardServes && Hit.Program.Program == StandardProgram && Hit.State == ERTHitState::Ready;
		if (bServes && StandIn.empty()) { StandIn = Hit.Groups; }
	}
	for (const FRTPSOLayout::FHit& Hit : Layout.Hits) { KnownPrograms = std::max(KnownPrograms, Hit.Program.Program + 1); }
	HitGroups.resize(size_t(KnownPrograms + 1) * HitClassCount * Types, Layout.EmptyHitGroup);
	States.resize(size_t(KnownPrograms + 1) * HitClassCount, ERTHitState::Missing);
	for (size_t Index = 0; Index < States.size(); ++Index)
	{
		const std::vector<uint32_t>& StandIns = Layout.StandIns[Index % HitClassCount];
		if (StandIns.empty()) { continue; }
		States[Index] = ERTHitState::StandIn;
		std::copy(StandIns.begin(), StandIns.end(), HitGroups.begin() + static_cast<ptrdiff_t>(Index * Types));
	}
	for (const FRTPSOLayout::FHit& Hit : Layout.Hits)
	{
		const uint32_t Index = IndexOf(Hit.Program);
		if (Hit.State == ERTHitState::Ready)
		{
			States[Index] = ERTHitState::Ready;
			std::copy(Hit.Groups.begin(), Hit.Groups.end(), HitGroups.begin() + static_cast<ptrdiff_t>(Index * Types));
		}
		else { MissingCount += Types; }
	}
}

uint32_t FRTPSO::FindRayGen(const FShaderSource& Source) const
{
	for (size_t I = 0; I < Layout.RayGens.size(); ++I)
	{
		const FShaderSource& Own = Layout.RayGens[I];
		if (Own.Path == Source.Path && Own.Defines == Source.Defines && Own.Text == Source.Text) { return static_cast<uint32_t>(I); }
	}
	return NoRayGen;
}

uint32_t FRTPSO::FindRayGenVariant(const FShaderSource& Source) const
{
	if (const uint32_t Index = FindRayGen(Source); Index != NoRayGen) { return Index; }
	const auto IsVariant = [&](const FShaderSource& Own) { return Own.Path == Source.Path; };
	const auto Found = std::find_if(Layout.RayGens.begin(), Layout.RayGens.end(), IsVariant);
	return Found == Layout.RayGens.end() ? NoRayGen : static_cast<uint32_t>(Found - Layout.RayGens.begin());
}

FRTStatus FRTPSO::Create(
    IRTDevice& Device, FShaderCompiler& Compiler, const FMaterialPrograms& Programs, const FRTPSODesc& Desc, FRTPSO& Out)
{
	FMonolith Monolith;
	FRTPSOLayout Layout = AddGroups(Desc, Programs, Monolith);
	const size_t Count = Monolith.Sources.size();
	std::vector<FShaderBinary> Binaries(Count);
	std::vector<FRTStatus> Results(Count);
	ParallelFor(Count, 1, [&](size_t Begin, size_t End) {
		for (size_t I = Begin; I < End; ++I) { Results[I] = Compiler.Compile(Monolith.Sources[I], Binaries[I]); }
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
	Pipeline.Groups = Monolith.Groups.data();
	Pipeline.GroupCount = static_cast<uint32_t>(Monolith.Groups.size());
	Pipeline.MaxPayloadBytes = GetPayloadBytes(Desc);
	Pipeline.Name = "RTPSO";
	TRTRef<IRTPipeline> Made;
	if (FRTStatus S = Device.CreateRayTracingPipeline(Pipeline, Made.ReleaseAndGetAddress()); !S) { return S; }
	Out = FRTPSO(std::move(Made), std::move(Layout));
	return FRTStatus::Success();
}

} // namespace Lantern
