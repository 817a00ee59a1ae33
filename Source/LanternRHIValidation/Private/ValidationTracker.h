// Judges what a submission does to resources, in order, before it is let through.
#pragma once

#include "ValidationState.h"

#include <map>
#include <set>

namespace Lantern
{

/// One step of a command list that depends on what was submitted before it.
struct FValidationStep
{
	enum class EKind : uint8_t
	{
		Barrier,      ///< Resource (null for a memory barrier), Before, After
		Use,          ///< Resource, After: the access it needs
		SetState,     ///< Resource, After: the state it is left in
		CheckIndices, ///< Memory: Count indices of IndexType, each below Limit
		BuildGeometry,
		UpdateGeometry,
		RequireBuilt, ///< Geometry
		WriteSize,    ///< Queries, Count: query; of Geometry
		BuildScene,   ///< Scene, Memory at Offset: Count instances
		UpdateTable,  ///< Table, Count: generation of its pipeline
		TraceRays,    ///< Table, Count: generation of its pipeline
	};

	EKind Kind = EKind::Use;
	std::string What; ///< the call, for the message
	std::shared_ptr<FResourceTrack> Resource;
	ERTAccess Before = ERTAccess::None, After = ERTAccess::None;
	std::shared_ptr<FGeometryTrack> Geometry;
	std::shared_ptr<FSceneTrack> Scene;
	std::shared_ptr<FTableTrack> Table;
	std::shared_ptr<FQueryTrack> Queries;
	TRTRef<IRTBuffer> Memory; ///< of the wrapped device, mapped; null if its contents are unknown
	uint64_t Offset = 0;
	uint32_t Count = 0, Limit = 0;
	ERTIndexType IndexType = ERTIndexType::None;
};

/// Works on an overlay, so that a refused submission changes nothing. FValidationState::Mutex must be held throughout.
class FValidationTracker
{
public:
	/// Waits: fences that the submission waits for.
	FValidationTracker(FValidationState& InState, ERTQueue InQueue, const FRTFence* Waits = nullptr, uint32_t WaitCount = 0);

	/// Geometries that the lists keep alive though their owners released them.
	void Keep(const std::shared_ptr<FGeometryTrack>& Geometry) { Kept.insert(Geometry.get()); }
	void Run(const FValidationStep& Step);
	const std::vector<std::string>& GetMessages() const { return Messages; }
	/// Fence: the fence of what was submitted.
	void Commit(FRTFence Fence);
	/// Returns why an instance may not point there; empty if it may. Kept: geometries kept alive though released.
	std::string CheckAddress(uint64_t Address, bool bRecording) const;

private:
	/// Reports what another queue may still do with the step's resource.
	void CheckQueues(const FValidationStep& Step);
	bool IsBusy(const FResourceTrack& Resource, bool bWrite) const;
	void Barrier(const FValidationStep& Step);
	void MemoryBarrier(const FValidationStep& Step);
	void Use(const FValidationStep& Step);
	void CheckIndices(const FValidationStep& Step);
	void BuildScene(const FValidationStep& Step);
	void TraceRays(const FValidationStep& Step);
	void CheckPipelineOf(const FValidationStep& Step, const FSceneContent* Content);
	void CheckHits(const FValidationStep& Step, const FSceneContent* Content);
	/// Returns the only scene and what it holds. Null if there are others, or if its instances are unknown.
	const FSceneTrack* FindOnlyScene(FSceneContent& OutContent) const;
	FAccessState& Get(const std::shared_ptr<FResourceTrack>& Resource);
	bool IsBuilt(FGeometryTrack* Geometry) const { return Geometry->bBuilt || Built.contains(Geometry); }
	void Add(std::string Message);

	FValidationState& State;
	const ERTQueue Queue;
	FRTFence Waited[QueueCount] = {};        ///< by other queue
	std::map<FResourceTrack*, bool> Touched; ///< and whether it was written
	std::map<std::shared_ptr<FResourceTrack>, FAccessState> Accesses;
	std::map<FSceneTrack*, FSceneContent> Scenes;
	std::set<FGeometryTrack*> Built, Kept;
	std::map<FTableTrack*, uint32_t> Updated; ///< generation
	std::vector<const FValidationStep*> Sizes;
	std::vector<std::string> Messages;
};

} // namespace Lantern
