#include "RayPrograms.h"

#include "LanternRenderer/AnyHitCounter.h"
#include "LanternRenderer/Frame.h"
#include "LanternScene/ShaderTable/SectionTable.h"

namespace Lantern
{

namespace
{
constexpr uint32_t ShadowPayloadBytes = 4;
constexpr uint32_t MaterialPayloadBytes = 32;

FShaderSource Shader(const char* Path) { return {Path, ERTShaderStage::RayGen, {}, {}}; }

FRayType MakeShadowRay(bool bBlockers)
{
	FRayType Type;
	Type.Name = "SHADOW";
	Type.Miss = Shader("Rays/Shadow.rmiss");
	Type.MaskedAnyHit = Shader("Rays/AlphaTest.rahit");
	Type.MaskedAnyHit.Defines = FAnyHitCounter::GetDefines();
	if (bBlockers)
	{
		Type.ClosestHit = Shader("Rays/Shadow.rchit");
		Type.bSharedClosestHit = true;
	}
	Type.PayloadBytes = ShadowPayloadBytes;
	return Type;
}

FRayType MakeMaterialRay()
{
	FRayType Type;
	Type.Name = "MATERIAL";
	Type.Miss = Shader("Rays/Material.rmiss");
	Type.ClosestHit = Shader("Rays/Material.rchit");
	Type.MaskedAnyHit = Shader("Rays/AlphaTest.rahit");
	Type.MaskedAnyHit.Defines = FAnyHitCounter::GetDefines();
	Type.PayloadBytes = MaterialPayloadBytes;
	return Type;
}

/// See FSignalRequests::bNothingElse.
bool IsMade(EFrameRayGen Pass, const FSignalRequests& Requests)
{
	switch (Pass)
	{
	case EFrameRayGen::SunShadow: return !Requests.bNothingElse || Requests.bSunShadow;
	case EFrameRayGen::AmbientOcclusion: return !Requests.bNothingElse || Requests.bAmbientOcclusion;
	case EFrameRayGen::DiffuseGI: return !Requests.bNothingElse || Requests.bDiffuseGI;
	case EFrameRayGen::Reflections: return !Requests.bNothingElse || Requests.bReflections;
	case EFrameRayGen::Reference:
	case EFrameRayGen::Count: break;
	}
	return true;
}
} // namespace

FPassRays MakePassRays(const char* RayGenPath, std::vector<std::pair<std::string, std::string>> Defines, bool bShadesHits)
{
	FPassRays Rays{Shader(RayGenPath), bShadesHits};
	Rays.RayGen.Defines = std::move(Defines);
	return Rays;
}

FRayPrograms ChooseRayPrograms(const FRTCapabilities& Capabilities, FRTScene& Scene, const FFrameFeatures& Features, bool bDiffuseGIReady)
{
	const FSceneFacts& Facts = Scene.GetFacts();
	FRayPrograms Programs;
	FRTPSODesc& Desc = Programs.Desc;
	const std::optional<FPassRays> DiffuseGI = ChooseDiffuseGIRays(Capabilities, Facts);
	const bool bDiffuseGI = bDiffuseGIReady && DiffuseGI;
	const auto IsQuery = [&](EFrameRayGen Pass, ERayPath Path) { return Path == ERayPath::Query && IsMade(Pass, Features.Signals); };
	Programs.bQueries = !Features.bReference && (IsQuery(EFrameRayGen::SunShadow, ChooseSunShadowPath(Capabilities, Facts)) ||
	                                                IsQuery(EFrameRayGen::AmbientOcclusion,
	                                                    ChooseAmbientOcclusionPath(Capabilities, Facts, Features.Signals, bDiffuseGI)));
	bool bShadesHits = !Features.RayGens.empty(), bBlockers = false;
	const auto Add = [&](EFrameRayGen Pass, std::optional<FPassRays> Rays) {
		if (!Rays || !IsMade(Pass, Features.Signals)) { return; }
		Desc.RayGens.push_back(Rays->RayGen);
		Programs.RayGens[static_cast<size_t>(Pass)] = std::move(Rays->RayGen);
		bShadesHits |= Rays->bShadesHits;
		bBlockers |= Rays->bBlockers;
		Programs.bLightSampling |= Rays->bShadesHits;
	};
	if (Features.bReference)
	{
		Add(EFrameRayGen::Reference, ChooseReferenceRays(Facts, Features.ReferenceSignal, Features.bReferenceFromGBuffer));
	}
	else
	{
		// Also without pipelines: passes that need them say so.
		Add(EFrameRayGen::SunShadow, ChooseSunShadowRays(Capabilities, Facts));
		Add(EFrameRayGen::AmbientOcclusion, ChooseAmbientOcclusionRays(Capabilities, Facts, Features.Signals, bDiffuseGI));
		Add(EFrameRayGen::DiffuseGI, DiffuseGI);
		Add(EFrameRayGen::Reflections, ChooseReflectionsRays(Capabilities, Facts));
	}
	Desc.RayGens.insert(Desc.RayGens.end(), Features.RayGens.begin(), Features.RayGens.end());
	if (Desc.RayGens.empty() || !Capabilities.bRayTracingPipeline)
	{
		Desc.RayGens.clear();
		Programs.RayGens.fill(std::nullopt);
		return Programs;
	}
	Desc.RayTypes = {MakeShadowRay(bBlockers)};
	if (bShadesHits) { Desc.RayTypes.push_back(MakeMaterialRay()); }
	Desc.Callables = Features.Callables;
	Desc.HitPrograms = Scene.GetSections().GetHitPrograms();
	return Programs;
}

} // namespace Lantern
