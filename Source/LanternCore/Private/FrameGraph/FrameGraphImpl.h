// Internals of the frame graph, shared by the files FrameGraph*.cpp.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "FrameGraph/FrameGraphAccess.h"
#include "LanternCore/FrameGraph/FrameGraph.h"

namespace Lantern
{

inline constexpr uint32_t NoPass = ~0u;

/// All that must be equal for one pooled resource to stand in for another.
struct FPoolKey
{
	bool bTexture = false;
	uint32_t Width = 0, Height = 0, MipCount = 0;
	ERTFormat Format = ERTFormat::Unknown;
	uint64_t Size = 0;
	uint32_t Usage = 0;

	auto Tie() const { return std::tie(bTexture, Width, Height, MipCount, Format, Size, Usage); }
	bool operator<(const FPoolKey& Other) const { return Tie() < Other.Tie(); }
	uint64_t GetBytes() const; ///< without the driver's padding
};

struct FPooledResource
{
	std::string Name; ///< of the first that used it, which is also its name in a debugger
	FPoolKey Key;
	TRTRef<IRTTexture> Texture;
	TRTRef<IRTBuffer> Buffer;
	ERTAccess LastAccess = ERTAccess::None; ///< as the last executed graph left it
	uint64_t LastFrame = 0;
	const void* Owner = nullptr; ///< the graph that compiled it in; no other may have it
	bool bBusy = false;          ///< within that graph: between first and last use of the present tenant
};

/// Queues that passes run on: graphics, then compute beside it. Others have no passes.
inline constexpr uint32_t PassQueueCount = 2;

/// Timestamps of the passes of one queue.
struct FQueueQueries
{
	TRTRef<IRTQueryPool> Pool; ///< null: none are taken
	uint32_t PassCount = 0;
	uint64_t LastFirstNs = 0; ///< first timestamp read before: the same again means not yet written anew
};

/// Timestamps and numbers of one executed graph.
struct FTimedFrame
{
	FQueueQueries Queues[PassQueueCount];
	std::vector<FPassTiming> Passes;
	std::vector<uint32_t> Places; ///< by entry of Passes: its place among those of its queue; NoPass: the time is its group's
	uint64_t Serial = 0;
	uint64_t RecordedNs = 0; ///< by FTaskTrace::GetNow; 0: the trace was off
	int64_t TraceFrame = 0;
	bool bPending = false;
};

struct FFrameGraphResources::FImpl
{
	explicit FImpl(IRTDevice& InDevice) : Device(InDevice) {}

	/// Takes a pooled resource that Owner may use, or creates one. Prefers one of this name, so that bindless indices and
	/// debugger names stay equal from frame to frame.
	FRTStatus Acquire(const FPoolKey& Key, const std::string& Name, const void* Owner, std::shared_ptr<FPooledResource>& Out);
	FRTStatus Create(const FPoolKey& Key, const std::string& Name, std::shared_ptr<FPooledResource>& Out);
	/// Returns bytes freed.
	uint64_t Trim(uint32_t Frames);
	void TrimByAge(); ///< by r.RT.FrameGraph.KeepFrames

	/// Returns a frame to record into. It has query pools for PassCounts passes, by queue, if the device has timestamps.
	FTimedFrame& BeginTiming(const uint32_t (&PassCounts)[PassQueueCount]);
	void PollTimings();
	/// Reads a queue's timestamps. False: they are not there yet.
	static bool ReadTimes(FTimedFrame& Frame, uint32_t Queue, uint64_t& OutFirst, uint64_t& OutLast);

	IRTDevice& Device;
	std::map<FPoolKey, std::vector<std::shared_ptr<FPooledResource>>> Pool;
	std::vector<std::unique_ptr<FTimedFrame>> Frames;
	std::vector<FPassTiming> Newest;
	std::vector<FFrameTiming> Done; ///< that nobody has taken
	uint64_t FrameCounter = 0;
	std::vector<std::string> Poison; ///< parts of names, see FFrameGraphResources::PoisonHistory
};

struct FGraphResource
{
	std::string Name;
	bool bTexture = false;
	bool bImported = false;
	FGraphTextureDesc TextureDesc;
	FGraphBufferDesc BufferDesc;
	TRTRef<IRTTexture> ImportedTexture;
	TRTRef<IRTBuffer> ImportedBuffer;
	ERTAccess Current = ERTAccess::None, After = ERTAccess::None; ///< imported only
	bool bHistory = false;                                        ///< see FFrameGraph::MarkHistory
	bool bForLater = false;                                       ///< see FFrameGraph::MarkForLater
	bool* OutWritten = nullptr;

	// Compiled:
	uint32_t FirstPass = NoPass, LastPass = NoPass; ///< of those that run
	ERTAccess AllAccess = ERTAccess::None;
	std::shared_ptr<FPooledResource> Pooled;

	FPoolKey MakeKey() const;
	IRTTexture* GetTexture() const { return bImported ? ImportedTexture.Get() : Pooled ? Pooled->Texture.Get() : nullptr; }
	IRTBuffer* GetBuffer() const { return bImported ? ImportedBuffer.Get() : Pooled ? Pooled->Buffer.Get() : nullptr; }
	std::string Describe() const; ///< "texture 'Name' (64x64 R8_UNORM)"
};

struct FPassUse
{
	uint32_t Resource = 0;
	ERTAccess Read = ERTAccess::None, Write = ERTAccess::None; ///< as declared by Read() and Write()
	bool bIfRead = false;                                      ///< see FPassBuilder::WriteIfRead
	bool bApart = false;                                       ///< see FPassBuilder::ShareApart
	ERTAccess GetAccess() const { return Read | Write; }
};

/// Whether one layout of a resource serves two accesses.
bool SharesLayout(const FGraphResource& Resource, ERTAccess A, ERTAccess B);
/// Whether passes of one group may write so in any order.
inline bool AreApart(const FPassUse& A, const FPassUse& B) { return A.bApart && B.bApart && A.GetAccess() == B.GetAccess(); }

struct FGraphBarrier
{
	uint32_t Resource = 0;
	ERTAccess Before = ERTAccess::None, After = ERTAccess::None;
	bool bOtherQueue = false; ///< see FRTBarrier
};

struct FGraphPass
{
	std::string Name;
	std::string Group; ///< see FPassBuilder::RunBeside
	std::vector<FPassUse> Uses;
	std::vector<uint32_t> Keeps;         ///< resources, see FPassBuilder::Keep
	std::vector<uint32_t> Dropped;       ///< resources that WriteIfRead declared and nobody reads
	std::vector<FGraphBarrier> Barriers; ///< before the pass
	FPassExecute Execute;
	bool bNeverCull = false;
	bool bOnTask = false;     ///< see FPassBuilder::RecordOnTask
	bool bAllowAsync = false; ///< see FPassBuilder::AllowAsync
	bool bAhead = false;      ///< see FGraphRecorder::Engine
	ERTQueue Queue = ERTQueue::Graphics;
	std::vector<uint32_t> TokenWrites, TokensUnused;
	std::vector<uint32_t> Needs; ///< earlier passes of another queue that must have finished
	bool bCulled = false;
	std::string BadUse; ///< first wrong declaration, reported by Compile

	const FPassUse* Find(uint32_t Resource) const;
};

/// Passes that lie together and run at the same time.
struct FGroupRun
{
	uint32_t First = 0, Last = 0;
	bool Contains(uint32_t Pass) const { return Pass >= First && Pass <= Last; }
};

/// Whether the later pass must stay behind the earlier one because of what tokens stand for.
bool AreOrderedByTokens(const FGraphPass& Earlier, const FGraphPass& Later);

struct FFrameGraph::FImpl
{
	explicit FImpl(FFrameGraphResources::FImpl& InShared) : Shared(InShared) {}
	~FImpl();

	// FrameGraphCompile.cpp, in this order:
	FRTStatus Validate() const;
	FRTStatus ValidateUse(const FGraphPass& Pass, const FPassUse& Use, const std::vector<bool>& Written) const;
	FRTStatus AddPoison();
	void Cull();
	void CullWhatNobodyReads(std::vector<bool> Needed);
	void DropUnreadOutputs();
	void ReportWritten() const;
	void FindLifetimes();
	FRTStatus Allocate();
	void PlaceBarriers();
	/// How a pass uses a resource.
	struct FStateUse
	{
		uint32_t Pass = 0;
		FPassUse Use;
		ERTAccess GetAccess() const { return Use.GetAccess(); }
	};
	/// Frees what is not used behind these passes, for those that follow.
	void ReleaseBehind(uint32_t First, uint32_t Last);
	void PlaceBarriersOf(uint32_t Resource, const std::vector<FStateUse>& Uses);

	// FrameGraphQueues.cpp:
	/// Those that use a resource in its present state.
	struct FStateUsers
	{
		std::vector<uint32_t> Passes;
		uint32_t Entered = NoPass; ///< the pass that brought it there
	};
	void AssignQueues();
	/// Moves the passes that run ahead of an engine's list to the front.
	void ChooseAhead();
	bool IsOnOtherQueue(uint32_t Pass, uint32_t Than) const { return Passes[Pass].Queue != Passes[Than].Queue; }
	/// Pass enters another state: it needs all users of the old one. Returns whether one of them was on another queue, or perhaps
	/// an earlier graph.
	bool EnterState(FStateUsers& Users, uint32_t Pass);
	/// Pass uses the state in which the resource is.
	void UseState(FStateUsers& Users, uint32_t Pass);
	void OrderTokens();

	// FrameGraphGroups.cpp:
	/// Whether the later pass must stay behind the earlier one.
	bool AreOrdered(const FGraphPass& Earlier, const FGraphPass& Later) const;
	/// Moves a pass behind the last of a run, and before the first what it needs. False: something of the run must be before that.
	bool JoinGroup(FGroupRun& Run, uint32_t Joining);
	void GatherGroups();
	/// Null: the pass runs by itself.
	const FGroupRun* FindRun(uint32_t Pass) const;
	void HoistBarriersOfGroups();

	// FrameGraphRecord.cpp:
	using FGetFailure = std::function<FRTStatus()>;
	/// Consecutive passes that one thread records into one list.
	struct FSegment
	{
		IRTCommandList* List = nullptr;
		std::vector<uint32_t> Passes;
		bool bOnTask = false;
	};
	/// Puts passes into submissions, and these into segments. Fills Submissions.
	std::vector<FSegment> MakeSegments(bool bTasks);
	FRTStatus Record(const std::vector<FSegment>& Segments, const FGetFailure& GetFailure);
	/// Resets the queries of each queue in its first list. OutIndices: by pass, its place among those that run.
	FTimedFrame& BeginTiming(const std::vector<FSegment>& Segments, std::vector<uint32_t>& OutIndices);
	/// Lists what is timed: passes that run, and groups, each before its first pass. OutCounts: pairs of timestamps, by queue.
	void ListTimed(FTimedFrame& Out, std::vector<uint32_t>& OutIndices, uint32_t (&OutCounts)[PassQueueCount]) const;
	void RecordSegment(
	    const FSegment& Segment, FTimedFrame& Frame, const std::vector<uint32_t>& Indices, const FGetFailure& GetFailure) const;
	void RecordPass(IRTCommandList& Commands, const FGraphPass& Pass, FPassTiming& Timing, IRTQueryPool* Queries, uint32_t Query) const;
	void RecordBarriers(IRTCommandList& Commands, const std::vector<FGraphBarrier>& Barriers) const;

	FFrameGraphResources::FImpl& Shared;
	std::vector<FGraphResource> Resources;
	std::vector<FGraphPass> Passes;
	std::vector<FGroupRun> GroupRuns;
	std::vector<FGraphBarrier> FinalBarriers;
	std::vector<FGraphSubmission> Submissions;
	uint32_t TokenCount = 0;
	bool bAsync = false;                                ///< passes may run on another queue
	bool bAhead = false;                                ///< see FGraphRecorder::Engine
	ERTQueue AheadQueue = ERTQueue::Graphics;           ///< if bAhead
	uint32_t AheadCount = 0;                            ///< the first passes, which run ahead of the engine's list
	bool bAnyAsync = false;                             ///< some do
	std::unordered_map<const void*, uint32_t> Imported; ///< native object to resource
	/// Access of every pooled resource after the passes compiled so far.
	std::unordered_map<FPooledResource*, ERTAccess> PooledAccess;
	std::unordered_map<FPooledResource*, FStateUsers> PooledUsers;
	bool bCompiled = false;
	bool bExecuted = false;
	FRTStatus CompileStatus;
};

} // namespace Lantern
