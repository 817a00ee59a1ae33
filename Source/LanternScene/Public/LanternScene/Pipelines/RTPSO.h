// The RTPSO: one ray-tracing pipeline for all dispatches of a frame, made of what the scene needs. A scene
// without alpha-tested materials has no any-hit shader in it; a frame without a pass that shades hits has no
// closest-hit shader.
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

/// A kind of ray: what it runs where it hits and where it misses. In shaders NAME_RAY and NAME_MISS are its
/// indices, RAY_TYPES their number. Hit shaders are compiled once for each program: see FMaterialPrograms::MakeSource.
struct FRayType
{
	std::string Name; ///< upper case
	FShaderSource Miss;
	std::optional<FShaderSource> ClosestHit;
	bool bSharedClosestHit = false; ///< it runs nothing of a material's program: one for all opaque ones
	FShaderSource MaskedAnyHit;
	uint32_t PayloadBytes = 0;
	friend bool operator==(const FRayType&, const FRayType&) = default;
};

struct FRTPSODesc
{
	std::vector<FRayType> RayTypes;
	std::vector<FShaderSource> RayGens;
	std::vector<FShaderSource> Callables; ///< record i of the table is callable i
	std::vector<FHitProgram> HitPrograms;
	friend bool operator==(const FRTPSODesc&, const FRTPSODesc&) = default;
};

/// All shaders that the description names, each once: programs' own among them.
std::vector<FShaderSource> ListShaders(const FRTPSODesc& Desc, const FMaterialPrograms& Programs);

inline constexpr uint32_t NoRayGen = ~0u;

enum class ERTHitState : uint8_t
{
	Missing, ///< nothing to run: objects that use it are to be left out of the scene
	StandIn, ///< a stand-in of its class
	Ready,
};

/// What a linked pipeline holds, by group number.
struct FRTPSOLayout
{
	struct FHit
	{
		FHitProgram Program;
		ERTHitState State = ERTHitState::Missing;
		std::vector<uint32_t> Groups; ///< by ray type
	};
	std::vector<FShaderSource> RayGens; ///< those that are in it
	std::vector<uint32_t> RayGenGroups, MissGroups, CallableGroups;
	std::vector<FHit> Hits;
	/// By ray type: what stands in for hit programs that are not in Hits. Empty: nothing does.
	std::array<std::vector<uint32_t>, HitClassCount> StandIns;
	/// Where a class has no stand-in: the standard program of that class serves, if it is ready.
	bool bStandardServes = false;
	uint32_t EmptyHitGroup = 0; ///< runs nothing
};

/// An immutable pipeline and its numbering. Lives as long as somebody holds it; what was recorded with it keeps what it
/// needs.
class FRTPSO
{
public:
	FRTPSO() = default;
	FRTPSO(TRTRef<IRTPipeline> InPipeline, FRTPSOLayout InLayout);

	/// Makes one at once, on the calling thread's workers and without libraries: for tests, tools and comparison. Errors
	/// name shader, file and line.
	static FRTStatus Create(
	    IRTDevice& Device, FShaderCompiler& Compiler, const FMaterialPrograms& Programs, const FRTPSODesc& Desc, FRTPSO& Out);

	IRTPipeline* GetPipeline() const { return Pipeline.Get(); }
	uint32_t GetRayTypeCount() const { return static_cast<uint32_t>(Layout.MissGroups.size()); }
	uint32_t GetRayGenCount() const { return static_cast<uint32_t>(Layout.RayGenGroups.size()); }
	uint32_t GetCallableCount() const { return static_cast<uint32_t>(Layout.CallableGroups.size()); }
	/// Hit programs times ray types.
	uint32_t GetHitGroupCount() const { return static_cast<uint32_t>(Layout.Hits.size()) * GetRayTypeCount(); }
	/// Of them, those that are not there yet.
	uint32_t GetMissingCount() const { return MissingCount; }
	/// Record of a ray generation shader (as in FRTPSODesc: path and defines) in the table; NoRayGen: not in it.
	uint32_t FindRayGen(const FShaderSource& Source) const;
	/// The same, or else a variant of it: the same path with other defines.
	uint32_t FindRayGenVariant(const FShaderSource& Source) const;
	uint32_t RayGenGroup(uint32_t Index) const { return Layout.RayGenGroups[Index]; }
	uint32_t MissGroup(uint32_t RayType) const { return Layout.MissGroups[RayType]; }
	uint32_t CallableGroup(uint32_t Index) const { return Layout.CallableGroups[Index]; }
	/// Its own, or that of what stands in for it; where there is neither, a group that runs nothing. Any thread.
	uint32_t HitGroup(uint32_t RayType, FHitProgram Program) const { return HitGroups[IndexOf(Program) * GetRayTypeCount() + RayType]; }
	ERTHitState GetState(FHitProgram Program) const { return States[IndexOf(Program)]; }
	bool IsStandIn(FHitProgram Program) const { return GetState(Program) == ERTHitState::StandIn; }
	bool IsMissing(FHitProgram Program) const { return GetState(Program) == ERTHitState::Missing; }
	/// Differs for every pipeline.
	uint64_t GetRevision() const { return Revision; }

private:
	/// Programs that the pipeline knows nothing of share one entry for each class, at the end.
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
