// What the validation wrapper's device and objects share: who lives, who died, what state each resource is in.
#pragma once

#include "LanternRHICommon/Arithmetic.h"
#include "LanternRHICommon/TableLayout.h"
#include "LanternRHIValidation/ValidationDevice.h"

#include <array>
#include <atomic>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace Lantern
{

/// As printf takes it.
inline unsigned long long Wide(uint64_t Value) { return Value; }

/// State of a buffer or texture after the last submission.
struct FAccessState
{
	ERTAccess Access = ERTAccess::None;
	bool bKnown = true;     ///< false for an imported texture before its first barrier
	bool bImplicit = false; ///< from a use, not from a barrier
	bool bMerged = false;   ///< from a memory barrier, all of which a resource barrier need not repeat
};

struct FResourceTrack
{
	std::string Label;
	bool bTexture = false;
	ERTMemory Memory = ERTMemory::Device;
	FAccessState State;
	FRTFence LastUses[QueueCount] = {}, LastWrites[QueueCount] = {}; ///< by ERTQueue
};

struct FGeometryTrack
{
	std::string Label;
	uint64_t Address = 0;
	std::vector<FRTGeometrySection> Sections; ///< as created; pointers in it are never used
	bool bAllowUpdate = false, bFastBuild = false, bAllowCompaction = false;
	uint64_t CompactedBytes = 0; ///< if > 0, made for a compacted copy
	uint64_t CompactedSize = 0;  ///< what a query said, or 0 if none was read
	bool bBuilt = false;
	bool bDead = false;
	std::atomic<uint32_t> Holders = 0; ///< lists that keep it alive
};

/// Keeps a geometry alive until the list that has it is submitted or begun anew.
class FGeometryHold
{
public:
	explicit FGeometryHold(std::shared_ptr<FGeometryTrack> InGeometry) : Geometry(std::move(InGeometry)) { ++Geometry->Holders; }
	FGeometryHold(FGeometryHold&&) = default;
	FGeometryHold& operator=(FGeometryHold&&) = delete;
	~FGeometryHold()
	{
		if (Geometry) { --Geometry->Holders; }
	}

	std::shared_ptr<FGeometryTrack> Geometry;
};

/// Which geometries' compacted sizes the queries of a pool hold; null if none was written.
struct FQueryTrack
{
	struct FQuery
	{
		std::shared_ptr<FGeometryTrack> Geometry;
		FRTFence Fence = 0; ///< of the submission that writes it
		bool bReset = false;
	};
	std::string Label;
	std::vector<FQuery> Queries;
};

/// What is known of a scene's instances. Nothing is known if a shader wrote them.
struct FSceneContent
{
	bool bBuilt = false;
	bool bKnown = false;
	uint32_t HighestOffset = 0; ///< of the shader table, over instances with a mask
	uint32_t HighestInstance = 0;
	bool bAny = false;
	std::shared_ptr<const std::vector<uint64_t>> Offsets; ///< a bit for each offset of such an instance
};

struct FSceneTrack
{
	std::string Label;
	FSceneContent Content;
};

enum class ERecordState : uint8_t
{
	Never,
	Set,
	Updated
};

/// The generation of each record's handle. 0 is no handle, 1 the first pipeline, 2 the one after the first SetPipeline, and so
/// on. Records are set without a lock, from several threads.
class FRecordTracks
{
public:
	/// FValidationState::Mutex must be held, as for every call that reads records which others may set.
	void Resize(uint32_t InCount);
	uint32_t GetCount() const { return Count; }
	uint32_t Get(uint32_t Index) const { return Generations[Index].load(std::memory_order_relaxed); }
	void Set(uint32_t Index, uint32_t Generation) { Generations[Index].store(Generation, std::memory_order_relaxed); }
	bool IsStale(uint32_t Index, uint32_t Generation) const { return Get(Index) && Get(Index) < Generation; }

private:
	std::unique_ptr<std::atomic<uint32_t>[]> Generations;
	uint32_t Count = 0;
};

struct FTableTrack
{
	std::string Label;
	std::array<FRecordTracks, RecordKindCount> Records; ///< by ERTRecordKind
	std::vector<ERecordState> RayGen;
	std::atomic<uint32_t> Generation = 1; ///< of the pipeline that SetPipeline left
	uint32_t UpdatedGeneration = 0;       ///< of the last update submitted, or 0 if there was none
};

class FValidated;

struct FValidationState
{
	FValidationState(IRTDevice* InInner, FRTValidationCallback InCallback, void* InUser)
	    : Inner(InInner),
	      Callback(InCallback),
	      User(InUser)
	{}

	TRTRef<IRTDevice> Inner;
	FRTValidationCallback Callback;
	void* User;

	std::mutex CallbackMutex;
	std::mutex SubmitMutex; ///< submissions are judged in the order in which they are made
	std::mutex Mutex;       ///< of everything below and of the tracks
	std::unordered_map<const IRTRefCounted*, FValidated*> Live;
	std::unordered_set<const void*> Dead; ///< released wrappers, until their address is used again
	std::unordered_map<uint64_t, std::shared_ptr<FGeometryTrack>> Geometries;
	std::deque<std::shared_ptr<FGeometryTrack>> DeadGeometries; ///< the oldest are forgotten
	std::vector<std::weak_ptr<FSceneTrack>> Scenes;
	std::vector<std::weak_ptr<FResourceTrack>> Buffers;
	FRTFence LastFences[QueueCount] = {}; ///< by ERTQueue
	/// By queue, then by other queue: the newest fence of the other that the queue's submissions have waited for.
	FRTFence Waited[QueueCount][QueueCount] = {};

	void NoteFence(FRTFence Fence)
	{
		FRTFence& Last = LastFences[static_cast<size_t>(GetFenceQueue(Fence))];
		Last = Fence > Last ? Fence : Last;
	}

	void Report(const std::string& Message);
	FRTStatus Fail(const std::string& Message);
	void Add(const IRTRefCounted* Key, FValidated* Object);
	void Remove(const IRTRefCounted* Key);
	FValidated* FindAny(const IRTRefCounted* Key);
	/// Notes that the geometry is dead. Its name stays known, for messages about what still points at it.
	void Bury(const std::shared_ptr<FGeometryTrack>& Geometry);
	bool IsDead(const void* Key);
	/// Returns the wrapper behind Object. Null if Object is null, released, or not of this device.
	template <class W, class I>
	W* Find(I* Object)
	{
		return Object ? dynamic_cast<W*>(FindAny(Object)) : nullptr;
	}
	/// Like Find, but reports if there is none. What: the call and the argument.
	template <class W, class I>
	W* Require(I* Object, const std::string& What)
	{
		W* Found = Find<W>(Object);
		if (!Found) { ReportNotFound(Object, What); }
		return Found;
	}

private:
	void ReportNotFound(const void* Object, const std::string& What);
};

/// Returns for example "ShaderRead|CopyRead".
std::string DescribeAccess(ERTAccess Access);
/// Returns for example "buffer 'Name'". Name may be anything: what is shown of it is short and one line.
std::string MakeLabel(const char* Type, const char* Name);
/// Formats as printf.
std::string Print(const char* Format, ...) __attribute__((format(printf, 1, 2)));

} // namespace Lantern
