#include "RayPrograms.h"

#include "LanternRenderer/AnyHitCounter.h"
#include "LanternRenderer/Frame.h"
#include "LanternScene/SectionTable.h"
#include "PassTools.h"
#include "Shadow/SunShadow.h"

namespace Lantern
{

namespace
{
constexpr uint32_t ShadowPayloadBytes = 4;
constexpr uint32_t MaterialPayloadBytes = 32;

FShaderSource Shader(const char* Path) { return {Path, ERTShaderStage::RayGen, {}, {}}; }

FRayType MakeShadowRay()
{
	FRayType Type;
	Type.Name = "SHADOW";
	Type.Miss = Shader("Rays/Shadow.rmiss");
	Type.MaskedAnyHit = Shader("Rays/AlphaTest.rahit");
	Type.MaskedAnyHit.Defines = FAnyHitCounter::GetDefines();
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
} // namespace

FRayPrograms ChooseRayPrograms(const FRTCapabilities& Capabilities, FRTScene& Scene, const FFrameFeatures& Features)
{
	FRayPrograms Programs;
	FRTPSODesc& Desc = Programs.Desc;
	if (!Capabilities.bRayTracingPipeline) { return Programs; }
	if (Features.bReference)
	{
		Programs.Reference = Shader("Reference/PathTrace.rgen");
		Programs.Reference->Defines = MakeFactDefines(Scene.GetFacts());
		if (Scene.GetFacts().bEmissive) { Programs.Reference->Defines.emplace_back("HAS_EMISSIVE", "1"); }
		Desc.RayGens = {*Programs.Reference};
		Desc.RayTypes = {MakeShadowRay(), MakeMaterialRay()};
	}
	else if (ChooseSunShadowPath(Capabilities, Scene.GetFacts()) == ESunShadowPath::Pipeline)
	{
		Programs.SunShadow = Shader("Shadow/SunShadow.rgen");
		Programs.SunShadow->Defines = MakeSunShadowDefines();
		Desc.RayGens = {*Programs.SunShadow};
		Desc.RayTypes = {MakeShadowRay()};
	}
	if (!Features.RayGens.empty())
	{
		Desc.RayGens.insert(Desc.RayGens.end(), Features.RayGens.begin(), Features.RayGens.end());
		Desc.RayTypes = {MakeShadowRay(), MakeMaterialRay()};
		Desc.Callables = Features.Callables;
	}
	if (!Desc.RayGens.empty()) { Desc.HitPrograms = Scene.GetSections().GetHitPrograms(); }
	return Programs;
}

} // namespace Lantern
