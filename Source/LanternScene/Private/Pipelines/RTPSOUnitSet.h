// The units of an RTPSO and their states: what is wanted, what is compiled, what has failed.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "LanternScene/Pipelines/RTPSOCompiler.h"
#include "Pipelines/RTPSOTrash.h"
#include "Pipelines/RTPSOUnitCompiler.h"

namespace Lantern
{

enum class EUnitWork : uint8_t
{
	Idle,
	Queued,   ///< FCompileRound has it
	Compiling ///< a compile thread has it
};

/// The state of a unit, over all versions of its text.
struct FUnitState
{
	FPipelineUnit Unit;        ///< the newest version that was wanted
	bool bLibrary = false;     ///< compiled to a pipeline library, else to SPIR-V
	bool bEmptyGroup = false;  ///< the library gets a second group, without shaders
	bool bEssential = false;   ///< no pipeline can be linked without it, or it is a stand-in
	uint32_t PayloadBytes = 0; ///< largest payload of the pipeline
	uint32_t Program = StandardProgram;
	EUnitWork Work = EUnitWork::Idle;
	uint64_t Reloads = 0;       ///< edits of its shader files that were noticed
	FPipelineBuildRef Ready;    ///< the newest version that compiled; null: none has
	uint64_t ReadyVersion = 0;  ///< GetVersion() of Ready; 0: none
	uint64_t FailedVersion = 0; ///< GetVersion() of the newest one that does not compile; 0: none
	FRTStatus Error;            ///< of the newest compile
	/// The compile under way began before shortages were forgotten: if it has met one, there may be memory by now.
	bool bBeganBefore = false;
	uint64_t RetryAt = 0;    ///< frame before which it is not compiled, after a shortage of memory
	std::string ContentKey;  ///< FUnitCompiler::GetContentKey of the newest compile
	uint64_t LastWanted = 0; ///< frame
	bool bWanted = false;

	uint64_t GetVersion() const { return (Unit.Version << 24) + Reloads + 1; }
	/// The newest version is compiled, or is known not to compile.
	bool IsSettled() const { return ReadyVersion == GetVersion() || FailedVersion == GetVersion(); }
	/// A compile may begin in this frame.
	bool NeedsCompile(uint64_t Frame) const { return Work == EUnitWork::Idle && !IsSettled() && Frame >= RetryAt; }
};
using FUnitStateRef = std::shared_ptr<FUnitState>;

struct FHitUnits
{
	FHitProgram Program;
	std::vector<FUnitStateRef> Types; ///< by ray type; null: the group runs nothing
};

/// The units of a description.
struct FWantedUnits
{
	std::vector<FUnitStateRef> RayGens, Misses, Callables;
	std::vector<FHitUnits> Hits;
	std::vector<FHitUnits> StandIns; ///< at most one for each class, which Program.Class names
	FUnitStateRef EmptyCallable;     ///< for callables that do not compile; null without callables
	std::vector<FUnitStateRef> All;  ///< each unit once
};

/// A version of a unit whose files are compared with those that it was compiled from.
struct FUnitLook
{
	FUnitStateRef State;
	FPipelineUnit Unit;
	std::string ContentKey;
	uint64_t Version = 0;
};

/// Threads: the caller holds the lock of the RTPSO compiler. SetWanted also reads the material programs, on the render thread.
class FRTPSOUnitSet
{
public:
	/// The capabilities and the programs must outlive it.
	FRTPSOUnitSet(const FRTCapabilities& InCapabilities, const FMaterialPrograms& InPrograms)
	    : Capabilities(InCapabilities),
	      Programs(InPrograms)
	{}

	/// Wants the units of Desc from now on. bLibraries: pipeline libraries may be used. StandIns: each class of hit programs
	/// has a stand-in; none: as before, unless Desc is new. True: the wanted units have changed.
	bool SetWanted(const FRTPSODesc& Desc, bool bLibraries, std::optional<bool> StandIns, uint64_t Frame);
	const FRTPSODesc& GetDesc() const { return WantedDesc; }
	const FWantedUnits& GetWanted() const { return Wanted; }

	/// By program; programs beyond the end have none.
	void SetPriorities(std::vector<FProgramPriority> ByProgram) { Priorities = std::move(ByProgram); }
	/// Wanted units to be compiled, most important first.
	std::vector<FUnitStateRef> FindMissing(uint64_t Frame) const;

	bool AreHitsReady() const;              ///< every wanted hit program has a compiled version
	bool IsAnyToCome(uint64_t Frame) const; ///< a wanted unit is being compiled, or is to be
	size_t CountSettled() const;            ///< wanted units
	/// The error for which no complete pipeline can be linked; Ok: there is none.
	FRTStatus FindFatalError() const;
	/// Lets units that failed for want of memory be compiled again at once.
	void ForgetShortages();

	/// Lists all settled units, for a thread that compares their files without the lock.
	std::vector<FUnitLook> ListSettled() const;
	/// Wants Edited compiled anew, where no newer version has come meanwhile. True: there is any.
	bool Reload(const std::vector<FUnitLook>& Edited);

	/// Drops units that were not wanted for KeepFrames frames.
	void DropOld(uint64_t Frame, uint64_t KeepFrames, FTrash& Trash);
	/// Fills in Wanted, Ready, Failed and Kept.
	void Count(FRTPSOCompilerStats& Out) const;

private:
	FUnitStateRef FindUnit(FPipelineUnit Unit, bool bHit, bool bEmptyGroup);
	FHitUnits FindHitUnits(FHitProgram Program);
	FHitUnits FindStandInUnits(ERTHitClass Class);
	void CollectWanted(uint64_t Frame);
	void CollectGeneral(uint64_t Frame);
	void Want(const FUnitStateRef& State, uint64_t Frame);
	bool ComesBefore(const FUnitState& A, const FUnitState& B) const;

	const FRTCapabilities& Capabilities;
	const FMaterialPrograms& Programs;
	FRTPSODesc WantedDesc;
	uint64_t WantedEdits = 0; ///< FMaterialPrograms::GetEdits of the newest SetWanted
	bool bWantedLibraries = true, bWantedStandIns = false;
	FWantedUnits Wanted;
	std::unordered_map<std::string, FUnitStateRef> Units;
	std::map<FHitProgram, FHitUnits> HitUnits; ///< of WantedDesc's ray types
	std::vector<FProgramPriority> Priorities;
};

} // namespace Lantern
