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

std::string MakeRayProgramsKey(const FRTPSODesc& Desc)
{
	std::string Key;
	for (const FHitProgram Program : Desc.HitPrograms) { Key += std::to_string(Program.Program) + ':' + std::to_string(static_cast<int>(Program.Class)) + ' '; }
	for (const FShaderSource& RayGen : Desc.RayGens)
	{
		Key += RayGen.Path;
		for (const auto& [Name, Value] : RayGen.Defines) { Key += '|' + Name + '=' + Value; }
		Key += '\n';
	}
	for (const FRayType& Type : Desc.RayTypes) { Key += Type.Name + '\n'; }
	return Key;
}

FRayPrograms ChooseRayPrograms(const FRTCapabilities& Capabilities, const FSceneFacts& Facts, const FFrameFeatures& Features)
{
	FRayPrograms Programs;
	FRTPSODesc& Desc = Programs.Desc;
	Desc.HitPrograms.push_back({StandardProgram, ERTHitClass::Opaque});
	if (Facts.bMasked) { Desc.HitPrograms.push_back({StandardProgram, ERTHitClass::Masked}); }
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
