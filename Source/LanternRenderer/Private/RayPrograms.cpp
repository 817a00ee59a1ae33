#include "RayPrograms.h"

#include "LanternRenderer/Frame.h"
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
	Type.PayloadBytes = MaterialPayloadBytes;
	return Type;
}
} // namespace

FRayPrograms ChooseRayPrograms(const FRTCapabilities& Capabilities, const FSceneFacts& Facts, const FFrameFeatures& Features)
{
	FRayPrograms Programs;
	FRTPSODesc& Desc = Programs.Desc;
	Desc.bMasked = Facts.bMasked;
	if (!Capabilities.bRayTracingPipeline) { return Programs; }
	if (Features.bReference)
	{
		FShaderSource PathTrace = Shader("Reference/PathTrace.rgen");
		PathTrace.Defines = MakeFactDefines(Facts);
		if (Facts.bEmissive) { PathTrace.Defines.emplace_back("HAS_EMISSIVE", "1"); }
		Programs.ReferenceRayGen = static_cast<uint32_t>(Desc.RayGens.size());
		Desc.RayGens.push_back(std::move(PathTrace));
		Desc.RayTypes = {MakeShadowRay(), MakeMaterialRay()};
		return Programs;
	}
	if (ChooseSunShadowPath(Capabilities, Facts) == ESunShadowPath::Pipeline)
	{
		Programs.SunShadowRayGen = static_cast<uint32_t>(Desc.RayGens.size());
		Desc.RayGens.push_back(Shader("Shadow/SunShadow.rgen"));
		Desc.RayGens.back().Defines = MakeSunShadowDefines();
		Desc.RayTypes = {MakeShadowRay()};
	}
	return Programs;
}

} // namespace Lantern
