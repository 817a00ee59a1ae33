// The groups of a link, own ones and those of libraries, and their numbers.
#include "Pipelines/RTPSOLink.h"

#include <cassert>
#include <unordered_map>

namespace Lantern
{

namespace
{
/// Numbers the groups of a link: first its own groups, then those of each library.
class FLinker
{
public:
	explicit FLinker(const FLinkPlan& InPlan) : Plan(InPlan) {}

	/// Adds each build of the plan once.
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
		Out.reserve(Builds.size());
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
} // namespace

FRTStatus LinkRTPSO(IRTDevice& Device, const FLinkPlan& Plan, std::shared_ptr<const FRTPSO>& Out)
{
	assert(Plan.bComplete);
	FLinker Linker(Plan);
	Linker.AddBuilds();
	TRTRef<IRTPipeline> Pipeline;
	if (FRTStatus S = Device.CreateRayTracingPipeline(Linker.MakeDesc(), Pipeline.ReleaseAndGetAddress()); !S) { return S; }
	Out = std::make_shared<const FRTPSO>(std::move(Pipeline), Linker.MakeLayout());
	return FRTStatus::Success();
}

} // namespace Lantern
