// From compiled units to a linked RTPSO.
#include <algorithm>
#include <cassert>

#include "Pipelines/RTPSOCompilerImpl.h"

namespace Lantern
{

namespace
{
/// Numbers the groups of a link: its own first, then those of each library.
class FLinker
{
public:
	explicit FLinker(const FLinkPlan& InPlan) : Plan(InPlan) {}

	/// Builds of which the pipeline consists, each once.
	void AddBuilds()
	{
		for (const auto* List : {&Plan.RayGens, &Plan.Misses, &Plan.Callables}) { AddList(*List); }
		for (const auto* List : {&Plan.StandIns, &Plan.Hits})
		{
			for (const FLinkPlan::FHit& Hit : *List) { AddList(Hit.Builds); }
		}
		if (!Plan.Misses.front()->bEmptyGroup)
		{
			EmptyGroup = static_cast<uint32_t>(Groups.size());
			Groups.push_back({ERTGroupKind::Triangles});
		}
		uint32_t Next = static_cast<uint32_t>(Groups.size());
		for (const FPipelineBuild* Build : LibraryBuilds)
		{
			Libraries.push_back(Build->Library.Get());
			Numbers[Build] = Next;
			Next += Build->bEmptyGroup ? 2 : 1;
		}
		if (Plan.Misses.front()->bEmptyGroup) { EmptyGroup = Numbers[Plan.Misses.front().get()] + 1; }
	}

	FRTPSOLayout MakeLayout() const
	{
		FRTPSOLayout Layout;
		Layout.RayGens = Plan.RayGenSources;
		Layout.RayGenGroups = NumbersOf(Plan.RayGens);
		Layout.MissGroups = NumbersOf(Plan.Misses);
		Layout.CallableGroups = NumbersOf(Plan.Callables);
		Layout.EmptyHitGroup = EmptyGroup;
		Layout.bStandardServes = Plan.bStandardServes;
		for (const FLinkPlan::FHit& Hit : Plan.StandIns)
		{
			Layout.StandIns[static_cast<size_t>(Hit.Program.Class)] = NumbersOf(Hit.Builds);
		}
		for (const FLinkPlan::FHit& Hit : Plan.Hits) { Layout.Hits.push_back({Hit.Program, Hit.State, NumbersOf(Hit.Builds)}); }
		return Layout;
	}

	FRTRayTracingPipelineDesc MakeDesc() const
	{
		FRTRayTracingPipelineDesc Desc;
		Desc.Shaders = Codes.data();
		Desc.ShaderCount = static_cast<uint32_t>(Codes.size());
		Desc.Groups = Groups.data();
		Desc.GroupCount = static_cast<uint32_t>(Groups.size());
		Desc.Libraries = Libraries.data();
		Desc.LibraryCount = static_cast<uint32_t>(Libraries.size());
		Desc.MaxPayloadBytes = Plan.PayloadBytes;
		Desc.Name = "RTPSO";
		return Desc;
	}

private:
	void AddList(const std::vector<FPipelineBuildRef>& Builds)
	{
		for (const FPipelineBuildRef& Build : Builds)
		{
			if (!Build || !Numbers.try_emplace(Build.get(), 0).second) { continue; }
			if (Build->Library) { LibraryBuilds.push_back(Build.get()); }
			else { AddOwn(*Build); }
		}
	}

	void AddOwn(const FPipelineBuild& Build)
	{
		std::vector<uint32_t> Indices;
		for (const FShaderBinaryRef& Binary : Build.Codes)
		{
			const auto [It, bNew] = Shaders.try_emplace(Binary.get(), static_cast<uint32_t>(Codes.size()));
			if (bNew) { Codes.push_back(Binary->GetCode()); }
			Indices.push_back(It->second);
		}
		Numbers[&Build] = static_cast<uint32_t>(Groups.size());
		Groups.push_back(MakeGroup(Build.Kind, Build.Stages, Indices));
	}

	std::vector<uint32_t> NumbersOf(const std::vector<FPipelineBuildRef>& Builds) const
	{
		std::vector<uint32_t> Out;
		for (const FPipelineBuildRef& Build : Builds) { Out.push_back(Build ? Numbers.at(Build.get()) : EmptyGroup); }
		return Out;
	}

	const FLinkPlan& Plan;
	std::unordered_map<const FPipelineBuild*, uint32_t> Numbers;
	std::vector<const FPipelineBuild*> LibraryBuilds;
	std::vector<IRTPipeline*> Libraries;
	std::unordered_map<const FShaderBinary*, uint32_t> Shaders;
	std::vector<FRTShaderCode> Codes;
	std::vector<FRTShaderGroup> Groups;
	uint32_t EmptyGroup = 0;
};

/// False: some type is not compiled.
bool TakeBuilds(const FHitSlots& Hit, std::vector<FPipelineBuildRef>& Out)
{
	for (const FPipelineSlotRef& Slot : Hit.Types)
	{
		if (Slot && !Slot->Ready) { return false; }
		Out.push_back(Slot ? Slot->Ready : nullptr);
	}
	return true;
}

void AppendKey(FLinkPlan& Plan, const std::vector<FPipelineBuildRef>& Builds)
{
	Plan.Key.push_back(Builds.size());
	for (const FPipelineBuildRef& Build : Builds) { Plan.Key.push_back(Build ? Build->Id : 0); }
}

void AppendKey(FLinkPlan& Plan, const std::vector<FLinkPlan::FHit>& Hits)
{
	Plan.Key.push_back(Hits.size());
	for (const FLinkPlan::FHit& Hit : Hits)
	{
		Plan.Key.push_back(uint64_t(Hit.Program.Program) * 16 + uint64_t(Hit.Program.Class) * 4 + uint64_t(Hit.State));
		AppendKey(Plan, Hit.Builds);
	}
}
} // namespace

FLinkPlan FRTPSOCompiler::FImpl::MakePlan() const
{
	FLinkPlan Plan;
	Plan.PayloadBytes = GetPayloadBytes(WantedDesc);
	Plan.bComplete = !Wanted.Misses.empty();
	for (size_t I = 0; I < Wanted.RayGens.size(); ++I)
	{
		if (!Wanted.RayGens[I]->Ready) { continue; }
		Plan.RayGens.push_back(Wanted.RayGens[I]->Ready);
		Plan.RayGenSources.push_back(WantedDesc.RayGens[I]);
	}
	for (const FPipelineSlotRef& Slot : Wanted.Misses)
	{
		Plan.Misses.push_back(Slot->Ready);
		Plan.bComplete &= Slot->Ready != nullptr;
	}
	for (const FPipelineSlotRef& Slot : Wanted.Callables)
	{
		const bool bRefused = !Slot->Ready && Slot->IsSettled();
		Plan.Callables.push_back(bRefused ? Wanted.EmptyCallable->Ready : Slot->Ready);
		Plan.bComplete &= Plan.Callables.back() != nullptr;
	}
	for (const FHitSlots& Hit : Wanted.StandIns)
	{
		FLinkPlan::FHit Entry{Hit.Program, ERTHitState::StandIn, {}};
		if (TakeBuilds(Hit, Entry.Builds)) { Plan.StandIns.push_back(std::move(Entry)); }
		else
		{
			// Without it there would be holes. One that does not compile holds up nothing.
			const auto IsSettled = [](const FPipelineSlotRef& Slot) { return !Slot || Slot->IsSettled(); };
			Plan.bComplete &= std::all_of(Hit.Types.begin(), Hit.Types.end(), IsSettled);
		}
	}
	for (const FHitSlots& Hit : Wanted.Hits)
	{
		FLinkPlan::FHit Entry{Hit.Program, ERTHitState::Ready, {}};
		if (!TakeBuilds(Hit, Entry.Builds)) { Entry = {Hit.Program, ERTHitState::Missing, {}}; }
		Plan.Hits.push_back(std::move(Entry));
	}
	Plan.bComplete &= !Plan.RayGens.empty();
	Plan.bStandardServes = bStandardServes;
	Plan.Key.push_back(bStandardServes);
	for (const auto* List : {&Plan.RayGens, &Plan.Misses, &Plan.Callables}) { AppendKey(Plan, *List); }
	for (const auto* List : {&Plan.StandIns, &Plan.Hits}) { AppendKey(Plan, *List); }
	return Plan;
}

bool FRTPSOCompiler::FImpl::CoversFrame(const FLinkPlan& Made, const FLinkPlan& Plan)
{
	if (Made.bStandardServes != Plan.bStandardServes || Made.Misses != Plan.Misses || Made.Callables != Plan.Callables ||
	    Made.StandIns.size() != Plan.StandIns.size())
	{
		return false;
	}
	for (const FPipelineBuildRef& Build : Plan.RayGens)
	{
		if (std::find(Made.RayGens.begin(), Made.RayGens.end(), Build) == Made.RayGens.end()) { return false; }
	}
	for (size_t I = 0; I < Plan.StandIns.size(); ++I)
	{
		if (Made.StandIns[I].Program != Plan.StandIns[I].Program || Made.StandIns[I].Builds != Plan.StandIns[I].Builds) { return false; }
	}
	return true;
}

size_t FRTPSOCompiler::FImpl::CountNewPrograms(const FLinkPlan& Made, const FLinkPlan& Plan)
{
	std::map<FHitProgram, const FLinkPlan::FHit*> Hits;
	for (const FLinkPlan::FHit& Hit : Made.Hits) { Hits[Hit.Program] = &Hit; }
	const auto IsNew = [&](const FLinkPlan::FHit& Hit) {
		const auto Found = Hits.find(Hit.Program);
		return Hit.State == ERTHitState::Ready && (Found == Hits.end() || Found->second->Builds != Hit.Builds);
	};
	return static_cast<size_t>(std::count_if(Plan.Hits.begin(), Plan.Hits.end(), IsNew));
}

FRTStatus FRTPSOCompiler::FImpl::Link(const FLinkPlan& Plan, std::shared_ptr<const FRTPSO>& Out)
{
	FLinker Linker(Plan);
	Linker.AddBuilds();
	TRTRef<IRTPipeline> Pipeline;
	if (FRTStatus S = Device.CreateRayTracingPipeline(Linker.MakeDesc(), Pipeline.ReleaseAndGetAddress()); !S) { return S; }
	Out = std::make_shared<const FRTPSO>(std::move(Pipeline), Linker.MakeLayout());
	return FRTStatus::Success();
}

} // namespace Lantern
