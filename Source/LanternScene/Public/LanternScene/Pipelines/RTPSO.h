// The RTPSO: one ray-tracing pipeline for all dispatches of a frame. It holds what the scene needs and no more. A scene
// without alpha-tested materials has no any-hit shader in it; a frame that shades no hits has no closest-hit shader.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "LanternRHI/RTInterfaces.h"
#include "LanternScene/Pipelines/MaterialPrograms.h"

namespace Lantern
{

/// A kind of ray: the shaders that run where it hits and where it misses. Shaders see its indices as NAME_RAY and NAME_MISS,
/// and the number of ray types as RAY_TYPES. Hit shaders are compiled once for each program: see FMaterialPrograms::MakeSource.
struct FRayType
{
	std::string Name; ///< upper case
	FShaderSource Miss;
	std::optional<FShaderSource> ClosestHit;
	bool bSharedClosestHit = false; ///< ClosestHit runs no material program: all opaque hit programs share one group
	/// All materials are seen as the standard program shows them, which their hit groups run in place of their own. Own shapes keep theirs.
	bool bStandardProgram = false;
	FShaderSource MaskedAnyHit; ///< the alpha test
	uint32_t PayloadBytes = 0;
	friend bool operator==(const FRayType&, const FRayType&) = default;
};

struct FRTPSODesc
{
	std::vector<FRayType> RayTypes;
	std::vector<FShaderSource> RayGens;
	std::vector<FShaderSource> Callables; ///< callable record i of the shader table runs Callables[i]
	std::vector<FHitProgram> HitPrograms;
	friend bool operator==(const FRTPSODesc&, const FRTPSODesc&) = default;
};

/// Lists each shader of the description once, those of material programs included.
std::vector<FShaderSource> ListShaders(const FRTPSODesc& Desc, const FMaterialPrograms& Programs);

inline constexpr uint32_t NoRayGen = ~0u;

/// What a pipeline runs for a hit program.
enum class ERTHitState : uint8_t
{
	Missing, ///< nothing: the scene leaves out objects that use it
	StandIn, ///< the stand-in of its class
	Ready,   ///< the program itself
};

/// The content of a linked pipeline, by group number.
struct FRTPSOLayout
{
	struct FHit
	{
		FHitProgram Program;
		ERTHitState State = ERTHitState::Missing;
		std::vector<uint32_t> Groups; ///< by ray type; empty if missing
	};
	std::vector<FShaderSource> RayGens; ///< by record; a pipeline may have fewer than its description
	std::vector<uint32_t> RayGenGroups, MissGroups, CallableGroups;
	std::vector<FHit> Hits;
	/// By class, then by ray type: the groups that stand in for hit programs which are missing. Empty: there are none.
	std::array<std::vector<uint32_t>, HitClassCount> StandIns;
	/// The standard program of a class, if it is ready, stands in where the class has no stand-in.
	bool bStandardServes = false;
	uint32_t EmptyHitGroup = 0; ///< a hit group without shaders
};

/// A linked pipeline and its group numbers, made by FRTPSOCompiler. Lives as long as somebody holds it. A command list keeps
/// alive what it was recorded with.
/// Threads: immutable, any number at once.
class FRTPSO
{
public:
	FRTPSO() = default;
	FRTPSO(TRTRef<IRTPipeline> InPipeline, FRTPSOLayout InLayout);

	IRTPipeline* GetPipeline() const { return Pipeline.Get(); }
	uint32_t GetRayTypeCount() const { return static_cast<uint32_t>(Layout.MissGroups.size()); }
	uint32_t GetRayGenCount() const { return static_cast<uint32_t>(Layout.RayGenGroups.size()); }
	uint32_t GetCallableCount() const { return static_cast<uint32_t>(Layout.CallableGroups.size()); }
	/// Hit programs times ray types, missing ones included.
	uint32_t GetHitGroupCount() const { return static_cast<uint32_t>(Layout.Hits.size()) * GetRayTypeCount(); }
	/// Hit groups whose program is not compiled yet.
	uint32_t GetMissingCount() const { return MissingCount; }
	/// Finds the shader-table record of a ray generation shader by path, defines and text, as FRTPSODesc has them. NoRayGen: the
	/// pipeline does not have it.
	uint32_t FindRayGen(const FShaderSource& Source) const;
	/// Finds the record of a ray generation shader as FindRayGen does, or else one with the same path and other defines.
	uint32_t FindRayGenVariant(const FShaderSource& Source) const;
	/// The shader of a ray generation record, as FRTPSODesc has it.
	const FShaderSource& GetRayGen(uint32_t Index) const { return Layout.RayGens[Index]; }
	uint32_t RayGenGroup(uint32_t Index) const { return Layout.RayGenGroups[Index]; }
	uint32_t MissGroup(uint32_t RayType) const { return Layout.MissGroups[RayType]; }
	uint32_t CallableGroup(uint32_t Index) const { return Layout.CallableGroups[Index]; }
	/// The group of the program, or else of its stand-in, or else one that runs nothing.
	uint32_t HitGroup(uint32_t RayType, FHitProgram Program) const { return HitGroups[IndexOf(Program) * GetRayTypeCount() + RayType]; }
	ERTHitState GetState(FHitProgram Program) const { return States[IndexOf(Program)]; }
	bool IsMissing(FHitProgram Program) const { return GetState(Program) == ERTHitState::Missing; }
	/// A number that no other pipeline of the process has.
	uint64_t GetRevision() const { return Revision; }

private:
	/// Programs that the pipeline does not know share one entry for each class, behind the known ones.
	uint32_t IndexOf(FHitProgram Program) const
	{
		const uint32_t Index = std::min(Program.Program, KnownPrograms) * HitClassCount + static_cast<uint32_t>(Program.Class);
		return Index;
	}

	TRTRef<IRTPipeline> Pipeline;
	FRTPSOLayout Layout;
	uint32_t KnownPrograms = 0;
	uint32_t MissingCount = 0;
	std::vector<uint32_t> HitGroups;
	std::vector<ERTHitState> States;
	uint64_t Revision = 0;
};

} // namespace Lantern
