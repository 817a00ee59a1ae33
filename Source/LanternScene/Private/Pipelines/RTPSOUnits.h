// A unit: one shader group of an RTPSO, and what it is made from.
#pragma once

#include "LanternScene/Pipelines/RTPSO.h"

namespace Lantern
{

struct FPipelineUnit
{
	std::string Key; ///< names the group; the same for all versions of its text
	std::string Name;
	ERTGroupKind Kind = ERTGroupKind::General;
	std::vector<FShaderSource> Shaders;                  ///< with their stages, without the program; none: the group runs nothing
	std::shared_ptr<const FMaterialProgramDesc> Program; ///< null: they do not depend on one
	/// Shaders[Index] as the compiler is to see it.
	FShaderSource GetSource(size_t Index) const
	{
		return Program ? FMaterialPrograms::MakeSource(Shaders[Index], *Program) : Shaders[Index];
	}
	uint64_t Version = 0; ///< of the program's text
};

FPipelineUnit MakeRayGenUnit(const FRTPSODesc& Desc, uint32_t Index);
FPipelineUnit MakeMissUnit(const FRTPSODesc& Desc, uint32_t RayType);
FPipelineUnit MakeCallableUnit(const FRTPSODesc& Desc, uint32_t Index);
/// In place of a callable that does not compile: does nothing.
FPipelineUnit MakeEmptyCallableUnit();
FPipelineUnit MakeHitUnit(const FRTPSODesc& Desc, uint32_t RayType, FHitProgram Program, const FMaterialPrograms& Programs);
/// Runs in place of hit programs of Class: the standard material, with the alpha test and a count of the rays that hit it.
FPipelineUnit MakeStandInUnit(const FRTPSODesc& Desc, uint32_t RayType, ERTHitClass Class, const FMaterialPrograms& Programs);
/// Largest payload of the ray types, bytes.
uint32_t GetPayloadBytes(const FRTPSODesc& Desc);

/// Text that is equal where two sources are; without programs' headers.
std::string MakeSourceKey(const FShaderSource& Source);
/// Indices[i]: where the shader of Stages[i] lies in a pipeline's list.
FRTShaderGroup MakeGroup(ERTGroupKind Kind, const std::vector<ERTShaderStage>& Stages, const std::vector<uint32_t>& Indices);

} // namespace Lantern
