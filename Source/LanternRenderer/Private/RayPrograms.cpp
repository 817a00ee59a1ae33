// Collects from the registry of signals what a frame traces with.
#include "RayPrograms.h"

#include <algorithm>

#include "BruteForce/BruteForce.h"
#include "Feedback/AnyHitCounter.h"
#include "Fog/FogShadow.h"
#include "FrameChoices.h"
#include "IndirectVolume/IndirectVolume.h"
#include "LanternRenderer/HostSurface.h"
#include "LanternScene/ShaderTable/SectionTable.h"
#include "Lights/EmissiveTriangles.h"
#include "Lights/PixelChannels.h"
#include "LocalLights/LightMask.h"
#include "Motion/CameraMotion.h"
#include "RadianceCells/RadianceCells.h"
#include "Reference/Reference.h"
#include "SignalPasses.h"
#include "Transmission/Transmission.h"

namespace Lantern
{

namespace
{
constexpr uint32_t ShadowPayloadBytes = 4;
constexpr uint32_t MaterialPayloadBytes = 36, TransmissionBytes = 8, DiffuseTransmissionBytes = 8;

FShaderSource Shader(const char* Path) { return {Path, ERTShaderStage::RayGen, {}, {}}; }

FRayType MakeShadowRay(const FSceneFacts& Facts, bool bBlockers)
{
	FRayType Type;
	Type.Name = "SHADOW";
	Type.Miss = Shader("Rays/Shadow.rmiss");
	Type.MaskedAnyHit = Shader("Rays/AlphaTest.rahit");
	Type.MaskedAnyHit.Defines = FAnyHitCounter::GetDefines();
	AddTransmissionDefine(Facts, Type.Miss.Defines);
	AddTransmissionDefine(Facts, Type.MaskedAnyHit.Defines);
	if (Facts.bTransmissive) { Type.MaskedAnyHit.Defines.emplace_back("TO_LIGHT", "1"); }
	if (bBlockers)
	{
		Type.ClosestHit = Shader("Rays/Shadow.rchit");
		Type.bSharedClosestHit = true;
	}
	Type.PayloadBytes = ShadowPayloadBytes;
	return Type;
}

/// bStandard: materials are seen as the standard program shows them.
FRayType MakeMaterialRay(const FSceneFacts& Facts, bool bStandard)
{
	FRayType Type;
	Type.Name = bStandard ? "STANDARD" : "MATERIAL";
	Type.bStandardProgram = bStandard;
	Type.Miss = Shader("Rays/Material.rmiss");
	Type.ClosestHit = Shader("Rays/Material.rchit");
	AddLightEmissionDefine(Facts, Type.ClosestHit->Defines);
	Type.MaskedAnyHit = Shader("Rays/AlphaTest.rahit");
	Type.MaskedAnyHit.Defines = FAnyHitCounter::GetDefines();
	AddTransmissionDefine(Facts, Type.Miss.Defines);
	AddTransmissionDefine(Facts, Type.ClosestHit->Defines);
	AddTransmissionDefine(Facts, Type.MaskedAnyHit.Defines);
	for (FShaderDefines* const Defines : {&Type.Miss.Defines, &Type.ClosestHit->Defines})
	{
		if (Facts.bDiffuseTransmission) { Defines->emplace_back("HAS_DIFFUSE_TRANSMISSION", "1"); }
	}
	Type.PayloadBytes = MaterialPayloadBytes + (Facts.bTransmissive ? TransmissionBytes : 0);
	Type.PayloadBytes += Facts.bDiffuseTransmission ? DiffuseTransmissionBytes : 0;
	return Type;
}

/// Collects passes into one frame's programs.
struct FCollector
{
	FRayPrograms& Programs;
	bool bOwnHits = false, bStandardHits = false, bBlockers = false, bFilters = false, bFollowsHits = false;
	ERayPath RadianceCells = ERayPath::None; ///< of the pass that ends in them

	void Add(ESignal Signal, FPassRays Rays, const std::string& RayGenPath)
	{
		Programs.RayGens[ToIndex(Signal)] = Add(std::move(Rays), RayGenPath);
	}
	void Add(EPassRayGen Pass, FPassRays Rays, const std::string& RayGenPath)
	{
		Programs.PassRayGens[static_cast<size_t>(Pass)] = Add(std::move(Rays), RayGenPath);
	}
	FShaderSource Add(FPassRays Rays, const std::string& RayGenPath)
	{
		FShaderSource RayGen = Shader(RayGenPath.c_str());
		RayGen.Defines = std::move(Rays.Defines);
		std::vector<FShaderSource>& All = Programs.Desc.RayGens;
		if (std::find(All.begin(), All.end(), RayGen) == All.end()) { All.push_back(RayGen); } // signals may share one
		bOwnHits |= Rays.bShadesHits && Rays.HitPrograms != EHitPrograms::Standard;
		bStandardHits |= Rays.bShadesHits && Rays.HitPrograms != EHitPrograms::Own;
		bBlockers |= Rays.bBlockers;
		Programs.bLightSampling |= Rays.bShadesHits;
		return RayGen;
	}
};

/// Also on devices without pipelines: passes that need them say so.
void CollectSignals(FCollector& Collector, const FRTCapabilities& Capabilities, FRTScene& Scene, const FSceneFacts& Facts,
    const FSignalRequests& Requests, FSignalSet Ready)
{
	std::array<FPassRays, SignalCount> Chosen;
	ForEachSignalPass([&](const FSignalPass& Pass) {
		const bool bMayBeReplaced = Pass.ReplacedBy != ESignal::Count && Ready.Has(Pass.ReplacedBy);
		const bool bReplaced =
		    bMayBeReplaced && GetSignalPass(Pass.ReplacedBy).ChooseRays({Capabilities, Facts, Requests}).Path != ERayPath::None;
		if (AsksForRays(Pass.Signal, Requests))
		{
			Chosen[ToIndex(Pass.Signal)] = Pass.ChooseRays({Capabilities, Facts, Requests, bReplaced});
		}
	});
	ShareQueueShader(Chosen);
	ForEachSignalPass([&](const FSignalPass& Pass) {
		FPassRays& Rays = Chosen[ToIndex(Pass.Signal)];
		if (Rays.Path == ERayPath::None) { return; }
		Collector.Programs.bLightSampling |= Rays.bLightSampling;
		if (Rays.bRadianceCells) { Collector.RadianceCells = Rays.Path; }
		const bool bMade = IsMade(Pass.Signal, Requests);
		const bool bMask = Pass.Signal == GetLightMaskRow() && IsLightMaskAccumulated(Facts);
		const bool bFollows = bMade && Pass.WantsMotion && Pass.WantsMotion(Scene);
		Collector.Programs.bMotion |= bMask || bFollows;
		Collector.bFollowsHits |= bFollows && Pass.bFollowsHits;
		Collector.bFilters |= bMask;
		Collector.Programs.bMotion |= Pass.AskShadowRays && Facts.bCharacters; // it names the pixels' objects
		std::vector<FShaderSource>& Compute = Collector.Programs.Compute;
		if (Rays.Path == ERayPath::Query && Rays.bTraces)
		{
			Collector.Programs.bQueries = true;
			Compute.push_back(MakeQuerySource(Facts, Pass.Signal, Rays));
			if (Rays.bRadianceCells) { Compute.push_back(MakeQuerySource(Facts, Pass.Signal, MakeDeferredRays(Pass.Signal, Rays))); }
		}
		Compute.insert(Compute.end(), Rays.Compute.begin(), Rays.Compute.end());
		if (bMade && Pass.ListFilters)
		{
			const size_t Before = Compute.size();
			Pass.ListFilters(Scene, {Capabilities, Facts, Requests}, Compute);
			Collector.bFilters |= Compute.size() > Before;
		}
		if (Rays.Path == ERayPath::Pipeline && Rays.bTraces)
		{
			const std::string RayGen = GetRayShaderPath(Pass.Signal, Rays, ".rgen");
			if (Rays.bRadianceCells)
			{
				FPassRays Deferred = MakeDeferredRays(Pass.Signal, Rays);
				const std::string Second = GetRayShaderPath(Pass.Signal, Deferred, ".rgen");
				Collector.Add(EPassRayGen::DeferredPaths, std::move(Deferred), Second);
			}
			Collector.Add(Pass.Signal, std::move(Rays), RayGen);
		}
	});
}

/// For a pass that makes no signal. Path: of its shader, without suffix.
void CollectPass(FCollector& Collector, EPassRayGen Pass, const char* Path, FPassRays Rays, const FSceneFacts& Facts)
{
	if (Rays.Path == ERayPath::None) { return; }
	std::vector<FShaderSource>& Compute = Collector.Programs.Compute;
	Collector.Programs.bLightSampling |= Rays.bShadesHits;
	if (Rays.Path == ERayPath::Query)
	{
		Collector.Programs.bQueries = true;
		Compute.push_back(MakeQuerySource(Facts, Path, Rays));
	}
	Compute.insert(Compute.end(), Rays.Compute.begin(), Rays.Compute.end());
	if (Rays.Path == ERayPath::Pipeline) { Collector.Add(Pass, std::move(Rays), std::string(Path) + ".rgen"); }
}
/// Types of rays that shade hits. Where no material has a program of its own, one type does for both.
void AddMaterialRays(const FCollector& Collector, const FSceneFacts& Facts, FRTPSODesc& Desc)
{
	const auto IsOwn = [](FHitProgram Hit) { return Hit.Program != StandardProgram && Hit.Class != ERTHitClass::Procedural; };
	const bool bPrograms = std::any_of(Desc.HitPrograms.begin(), Desc.HitPrograms.end(), IsOwn);
	const bool bStandard = Collector.bStandardHits && bPrograms;
	if (Collector.bOwnHits || (Collector.bStandardHits && !bPrograms)) { Desc.RayTypes.push_back(MakeMaterialRay(Facts, false)); }
	if (bStandard) { Desc.RayTypes.push_back(MakeMaterialRay(Facts, true)); }
}
} // namespace

FRayPrograms ChooseRayPrograms(
    const FRTCapabilities& Capabilities, FRTScene& Scene, const FFrameFeatures& Features, const FSignalRequests& Requests, FSignalSet Ready)
{
	FRayPrograms Programs;
	FRTPSODesc& Desc = Programs.Desc;
	FCollector Collector{Programs};
	Collector.bOwnHits = !Features.RayGens.empty();
	const FSceneFacts Facts = AddFrameFacts(Scene.GetFacts(), Features, Requests);
	if (Features.bReference)
	{
		Collector.Add(ESignal::Frame, ChooseReferenceRays(Capabilities, Facts, Features.ReferenceSignal, Features.bReferenceFromGBuffer),
		    GetReferencePath(Features.ReferenceSignal));
		if (Features.bReferenceFromGBuffer)
		{
			Programs.Compute = ListReferenceComputeShaders(Facts, Features.ReferenceSignal);
			Programs.bMotion = Facts.bLightChannels || Facts.bToon; // it names the pixels' objects
		}
	}
	else
	{
		Programs.bMotion = Requests.bMotion || Facts.bLightChannels || Facts.bToon; // it names the pixels' objects
		if (Facts.bLightChannels) { Programs.Compute.push_back(MakePixelChannelsSource()); }
		CollectSignals(Collector, Capabilities, Scene, Facts, Requests, Ready);
		const FPassQuery Query{Capabilities, Facts, Requests};
		CollectPass(Collector, EPassRayGen::Fog, FogShaders, ChooseFogRays(Query), Facts);
		CollectPass(
		    Collector, EPassRayGen::RadianceCells, RadianceCellShaders, ChooseRadianceCellRays(Query, Collector.RadianceCells), Facts);
		CollectPass(Collector, EPassRayGen::Transmission, TransmissionShaders, ChooseTransmissionRays(Query), Facts);
		CollectPass(Collector, EPassRayGen::IndirectVolume, IndirectVolumeShaders, ChooseIndirectVolumeRays(Query), Facts);
		Programs.bMotion = (Programs.bMotion && Features.bMotion) || Collector.bFollowsHits;
	}
	if (Features.bHostSurface) { Programs.Compute.push_back(MakeHostSurfaceSource()); }
	if (Features.bCameraMotion && Collector.bFilters) { Programs.Compute.push_back(MakeCameraMotionSource()); }
	if (!Features.Skinning.empty()) { ListSkinningShaders(Scene, Programs.Compute); }
	if (Programs.bLightSampling) { ListEmissiveShaders(Facts, Programs.Compute); }
	Desc.RayGens.insert(Desc.RayGens.end(), Features.RayGens.begin(), Features.RayGens.end());
	if (Desc.RayGens.empty() || !Capabilities.bRayTracingPipeline)
	{
		Desc.RayGens.clear();
		Programs.RayGens.fill(std::nullopt);
		Programs.PassRayGens.fill(std::nullopt);
		return Programs;
	}
	Desc.RayTypes = {MakeShadowRay(Facts, Collector.bBlockers)};
	Desc.HitPrograms = Scene.GetSections().GetHitPrograms();
	AddMaterialRays(Collector, Facts, Desc);
	Desc.Callables = Features.Callables;
	return Programs;
}

} // namespace Lantern
