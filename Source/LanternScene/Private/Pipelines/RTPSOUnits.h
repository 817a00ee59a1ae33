// A unit: one shader group of an RTPSO, and the shaders that it is made from.
#pragma once

#include "LanternScene/Pipelines/RTPSO.h"

namespace Lantern
{

struct FPipelineUnit
{
	std::string Key; ///< identifies the group, over all versions of its text
	std::string Name;
	ERTGroupKind Kind = ERTGroupKind::General;
	std::vector<FShaderSource> Shaders;                  ///< with stages, without the program's text; empty: the group runs nothing
	std::shared_ptr<const FMaterialProgramDesc> Program; ///< null: the shaders include no material program
	/// Shaders[Index] with the text of the program, as the shader compiler takes it.
	FShaderSource GetSource(size_t Index) const
	{
		return Program ? FMaterialPrograms::MakeSource(Shaders[Index], *Program) : Shaders[Index];
	}
	uint64_t Version = 0; ///< FMaterialPrograms::GetRevision of the program
};

FPipelineUnit MakeRayGenUnit(const FRTPSODesc& Desc, uint32_t Index);
FPipelineUnit MakeMissUnit(const FRTPSODesc& Desc, uint32_t RayType);
FPipelineUnit MakeCallableUnit(const FRTPSODesc& Desc, uint32_t Index);
/// A callable that does nothing, for one that does not compile.
FPipelineUnit MakeEmptyCallableUnit();
FPipelineUnit MakeHitUnit(const FRTPSODesc& Desc, uint32_t RayType, FHitProgram Program, const FMaterialPrograms& Programs);
/// The stand-in for hit programs of Class: the standard material, which counts the rays that hit it. A masked class has its
/// alpha test.
FPipelineUnit MakeStandInUnit(const FRTPSODesc& Desc, uint32_t RayType, ERTHitClass Class, const FMaterialPrograms& Programs);
/// Largest payload of the ray types, in bytes, at least 4.
uint32_t GetPayloadBytes(const FRTPSODesc& Desc);

/// Text that is equal for equal sources. Ignores FShaderSource::Headers and Name.
std::string MakeSourceKey(const FShaderSource& Source);
/// Indices[i]: the place of the shader with stage Stages[i] in FRTRayTracingPipelineDesc::Shaders.
FRTShaderGroup MakeGroup(ERTGroupKind Kind, const std::vector<ERTShaderStage>& Stages, const std::vector<uint32_t>& Indices);

} // namespace Lantern
