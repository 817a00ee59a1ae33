// The numbers of a linked RTPSO, and the shaders that a description names.
#include "LanternScene/Pipelines/RTPSO.h"

#include <atomic>
#include <set>

#include "Pipelines/RTPSOUnits.h"

namespace Lantern
{

std::vector<FShaderSource> ListShaders(const FRTPSODesc& Desc, const FMaterialPrograms& Programs)
{
	std::vector<FShaderSource> Sources;
	std::set<std::string> Known;
	const auto Add = [&](const FPipelineUnit& Unit) {
		for (size_t I = 0; I < Unit.Shaders.size(); ++I)
		{
			FShaderSource Source = Unit.GetSource(I);
			if (Known.insert(MakeSourceKey(Source) + Source.Name).second) { Sources.push_back(std::move(Source)); }
		}
	};
	const uint32_t Types = static_cast<uint32_t>(Desc.RayTypes.size());
	for (uint32_t I = 0; I < Desc.RayGens.size(); ++I) { Add(MakeRayGenUnit(Desc, I)); }
	for (uint32_t I = 0; I < Types; ++I) { Add(MakeMissUnit(Desc, I)); }
	for (uint32_t I = 0; I < Desc.Callables.size(); ++I) { Add(MakeCallableUnit(Desc, I)); }
	for (const FHitProgram Program : Desc.HitPrograms)
	{
		for (uint32_t Type = 0; Type < Types; ++Type) { Add(MakeHitUnit(Desc, Type, Program, Programs)); }
	}
	return Sources;
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
		std::copy(StandIns.begin(), StandIns.end(), HitGroups.begin() + static_cast<ptrdiff_t>(Index) * Types);
	}
	for (const FRTPSOLayout::FHit& Hit : Layout.Hits)
	{
		const uint32_t Index = IndexOf(Hit.Program);
		if (Hit.State == ERTHitState::Ready)
		{
			States[Index] = ERTHitState::Ready;
			std::copy(Hit.Groups.begin(), Hit.Groups.end(), HitGroups.begin() + static_cast<ptrdiff_t>(Index) * Types);
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

} // namespace Lantern
