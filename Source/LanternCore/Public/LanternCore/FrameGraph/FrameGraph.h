// The frame graph. A frame is a list of passes. Each pass declares what it reads and writes, and records its commands later.
// Barriers, lifetimes of transient resources and culling follow from the declarations. A pass is culled if nobody reads its
// results. A transient resource reuses an earlier one of equal description, of this frame or the previous one, whose lifetime
// has ended. Memory is not aliased between different descriptions. Passes run in the order of AddPass, but for groups
// (FPassBuilder::RunBeside). There what is declared decides, and functions must not rely on another order. A pass records
// the barriers between its own commands itself.
//
//   FGraphTexture Mask = Graph.CreateTexture({.Width = W, .Height = H, .Format = …}, "SunShadowMask");
//   Graph.AddPass("SunShadow", [&](FPassBuilder& B) {
//       B.Read(Depth, ERTAccess::ShaderRead);
//       B.Write(Mask, ERTAccess::StorageWrite);
//       return [=](FPassContext& C) { C.Commands().SetPipeline(…); … C.GetTexture(Mask)->GetStorageIndex() … };
//   });
//
// A graph object is built, executed once, and destroyed. FFrameGraphResources keeps pools, timestamps and statistics across
// frames. Single-threaded.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "LanternRHI/RTInterfaces.h"

namespace Lantern
{

struct FGraphTexture
{
	uint32_t Index = ~0u;
	bool IsValid() const { return Index != ~0u; }
};
struct FGraphBuffer
{
	uint32_t Index = ~0u;
	bool IsValid() const { return Index != ~0u; }
};

/// Stands for data that the graph does not hold, such as the scene's tables. It has no memory and no barriers: passes record those
/// themselves. It orders queues.
struct FGraphToken
{
	uint32_t Index = ~0u;
	bool IsValid() const { return Index != ~0u; }
};

struct FGraphTextureDesc
{
	uint32_t Width = 0, Height = 0;
	ERTFormat Format = ERTFormat::Unknown;
	/// Usage beyond what follows from the declared accesses.
	ERTTextureUsage ExtraUsage = ERTTextureUsage::None;
	uint32_t MipCount = 1;
};

struct FGraphBufferDesc
{
	uint64_t Size = 0;
	ERTBufferUsage ExtraUsage = ERTBufferUsage::None;
};

class FPassContext
{
public:
	virtual IRTCommandList& Commands() = 0;
	virtual IRTDevice& Device() = 0;
	/// Asserts that the pass declared the texture. Returns null only for a texture of FPassBuilder::WriteIfRead that nobody
	/// reads.
	virtual IRTTexture* GetTexture(FGraphTexture Texture) = 0;
	virtual IRTBuffer* GetBuffer(FGraphBuffer Buffer) = 0;
	/// Adds rays to FPassTiming::Rays of this pass.
	virtual void CountRays(uint64_t Rays) = 0;

protected:
	~FPassContext() = default;
};

using FPassExecute = std::function<void(FPassContext&)>;

/// Declares what a pass reads and writes. A pass that both reads and writes a resource modifies what earlier passes left; only
/// StorageRead or ShaderRead may be combined with StorageWrite. Compile() returns an error that names pass and resource if no
/// earlier pass wrote what is read, or if accesses exclude each other.
class FPassBuilder
{
public:
	virtual void Read(FGraphTexture Texture, ERTAccess Access) = 0;
	virtual void Read(FGraphBuffer Buffer, ERTAccess Access) = 0;
	virtual void Write(FGraphTexture Texture, ERTAccess Access) = 0;
	virtual void Write(FGraphBuffer Buffer, ERTAccess Access) = 0;
	/// Declares an optional output. If no pass that runs reads it, it is not created, and GetTexture returns null.
	virtual void WriteIfRead(FGraphTexture Texture, ERTAccess Access) = 0;
	/// Lets a task record the pass, into a command list of its own, while other passes are recorded (FGraphRecorder). Its function
	/// must touch nothing that the functions of other passes write.
	virtual void RecordOnTask() = 0;
	/// Lets the pass run on ERTQueue::AsyncCompute, beside others, if r.RT.Async names it. It must not raster. What it declares to
	/// read and write orders it against passes of the other queue.
	virtual void AllowAsync() = 0;
	/// Lets the pass run at the same time as others of a group (r.RT.FrameGraph.Groups). The graph moves those together that do not need
	/// each other, what they need before them, and places no barrier in between. A few long threads then keep no other pass waiting.
	/// The memory of its results is no other member's. It must record no barrier of its own. Not for passes that raster.
	virtual void RunBeside(const char* Group) = 0;
	/// Says that passes of one group write parts of the buffer that no other of them reads or writes, or by atomics in any order.
	/// After Read and Write, which must be the same in all of them.
	virtual void ShareApart(FGraphBuffer Buffer) = 0;
	/// Says that the pass changes what Token stands for. All other passes count as readers, and wait for it if they run on another
	/// queue.
	virtual void Write(FGraphToken Token) = 0;
	/// Says that the pass does not touch what Token stands for.
	virtual void Without(FGraphToken Token) = 0;
	/// Makes the pass run even if nobody reads its outputs. Readback and writes to imported resources imply this.
	virtual void NeverCull() = 0;
	/// Says that this pass will read the resource in the next frame. The passes that write it, earlier or later, then run if
	/// this pass runs. Only for resources of FFrameGraph::MarkForLater. Adds no access and no barrier.
	virtual void Keep(FGraphTexture Texture) = 0;
	virtual void Keep(FGraphBuffer Buffer) = 0;

protected:
	~FPassBuilder() = default;
};

struct FPassTiming
{
	std::string Name;
	double GpuMs = 0.0; ///< < 0: no timestamps on this device. 0 if it ran in a group, which has an entry of its own before (RunBeside)
	double CpuMs = 0.0; ///< time to record, on the render thread or on a task's
	uint64_t Rays = 0;
	ERTQueue Queue = ERTQueue::Graphics;
	/// When the device began with it, since the first pass of its queue began in this frame; < 0: no timestamps.
	double BeginMs = -1.0;
};

/// GPU time of a frame, from the begin of its first pass to the end of its last, on the graphics queue.
struct FFrameTiming
{
	uint64_t Frame = 0; ///< FFrameGraphResources::GetFrame
	double GpuMs = 0.0;
};

/// Resources that outlive a frame: the pool of transient resources, timestamp queries and the last finished timings.
class FFrameGraphResources
{
public:
	explicit FFrameGraphResources(IRTDevice& Device);
	~FFrameGraphResources();
	/// Returns the passes of the newest frame that the GPU has finished, in order of execution.
	const std::vector<FPassTiming>& GetTimings();
	/// Returns the number of the last executed graph; it increases.
	uint64_t GetFrame() const;
	/// Returns the frames that the GPU has finished since the last call, oldest first. Frames that were not submitted are left
	/// out, and so are all frames on a device without timestamps.
	std::vector<FFrameTiming> TakeFrameTimings();
	/// Frees pooled resources that the last Frames executed graphs did not use; 0: all that are idle. Each executed graph does
	/// so by r.RT.FrameGraph.KeepFrames. What the GPU still uses is freed once it is done.
	void Trim(uint32_t Frames);
	uint64_t GetPooledBytes() const;
	/// Overwrites histories with not-a-number, for debugging. It affects the resources of the next executed graph that are
	/// marked as history and whose name contains NamePart ("": all). A pass "Poison", before the first one, writes bits that
	/// are NaN in every float format. Calls before the same graph add up. Compile() returns an error if such a resource lacks
	/// CopyDest usage.
	void PoisonHistory(std::string NamePart);

private:
	friend class FFrameGraph;
	struct FImpl;
	std::unique_ptr<FImpl> Impl;
};

/// Where a graph gets its command lists from, and whether it should go on.
struct FGraphRecorder
{
	/// Returns the next command list of a queue, begun. The graph asks for them in the order of FFrameGraph::GetSubmissions. Render
	/// thread.
	std::function<FRTStatus(ERTQueue Queue, IRTCommandList*& Out)> NextList;
	/// Returns the first error that a pass met; later passes are then not recorded. From any thread; may be empty.
	std::function<FRTStatus()> GetFailure;
	bool bAsync = false; ///< lists of ERTQueue::AsyncCompute may be asked for
	/// An engine's list, begun, of ERTQueue::Graphics. It becomes the last submission by itself. One submission may lie ahead of it,
	/// on AheadQueue. It has the passes that allow AllowAsync, use no texture and no buffer of the graph, and share no token with
	/// earlier passes behind it. Null: all lists come from NextList.
	IRTCommandList* Engine = nullptr;
	ERTQueue AheadQueue = ERTQueue::Graphics; ///< from FindAheadQueue
};

/// Returns the queue of what an engine's frame submits ahead of the engine's list. It is ERTQueue::AsyncCompute if the device has it
/// and r.RT.Async names passes, else graphics. Render thread.
ERTQueue FindAheadQueue(const IRTDevice& Device);

/// Lists of one queue that are submitted together.
struct FGraphSubmission
{
	ERTQueue Queue = ERTQueue::Graphics;
	uint32_t ListCount = 0;
	std::vector<uint32_t> Waits; ///< earlier submissions, of other queues, whose fences it waits for
	/// The fence of the graph before is among those that it waits for.
	bool bWaitsForLastGraph = false;
};

class FFrameGraph
{
public:
	explicit FFrameGraph(FFrameGraphResources& Resources);
	~FFrameGraph();
	FFrameGraph(const FFrameGraph&) = delete;
	FFrameGraph& operator=(const FFrameGraph&) = delete;

	FGraphTexture CreateTexture(const FGraphTextureDesc& Desc, const char* Name);
	FGraphBuffer CreateBuffer(const FGraphBufferDesc& Desc, const char* Name);
	/// Imports a resource. Current must be exactly how it was last used; After, if not None, is the access to leave it in. A
	/// pass that writes to an imported resource is not culled. Importing an object twice returns the same handle.
	FGraphTexture ImportTexture(IRTTexture* Texture, ERTAccess Current, ERTAccess After, const char* Name);
	FGraphBuffer ImportBuffer(IRTBuffer* Buffer, ERTAccess Current, ERTAccess After, const char* Name);
	FGraphToken CreateToken(const char* Name);
	/// Marks an imported resource whose content comes from earlier frames: see FFrameGraphResources::PoisonHistory.
	void MarkHistory(FGraphTexture Texture);
	void MarkHistory(FGraphBuffer Buffer);
	/// Marks an imported resource that is written for later frames only. Unlike with other imported resources, a pass that
	/// writes it may be culled. The pass runs if one that runs reads the resource, or declares FPassBuilder::Keep. OutWritten
	/// (may be null) must live until Compile, which sets it to whether a pass that runs writes the resource.
	void MarkForLater(FGraphTexture Texture, bool* OutWritten = nullptr);
	void MarkForLater(FGraphBuffer Buffer, bool* OutWritten = nullptr);
	/// Adds usage to a transient texture for accesses after the graph, which no pass declares.
	void AddUsage(FGraphTexture Texture, ERTTextureUsage Usage);
	const FGraphTextureDesc& GetDesc(FGraphTexture Texture) const;
	const FGraphBufferDesc& GetDesc(FGraphBuffer Buffer) const;

	/// Adds a pass. Setup runs at once and returns the function that records the commands. That function runs only if the pass
	/// is not culled.
	void AddPass(const char* Name, const std::function<FPassExecute(FPassBuilder&)>& Setup);

	/// Culls passes, allocates resources, and records into Commands. On error (out of memory, device lost) nothing is recorded
	/// after the failing point; the message names the resource. Commands must be submitted. Graphs of one FFrameGraphResources
	/// must be submitted in the order of their Execute, on one queue, since pooled resources carry their state over.
	/// Failure (may be null): if a pass sets it to an error, later passes are not recorded, and Execute returns it.
	FRTStatus Execute(IRTCommandList& Commands, const FRTStatus* Failure = nullptr);
	/// Executes into several lists. A task records each pass of FPassBuilder::RecordOnTask into a list of its own, and this thread
	/// records the others meanwhile. All must be submitted as GetSubmissions says. If r.RT.FrameGraph.Tasks is off and no pass
	/// runs on another queue, one list takes all passes.
	FRTStatus Execute(const FGraphRecorder& Recorder);
	/// Returns what to submit after Execute, in this order. The last one is of ERTQueue::Graphics, and complete when all are.
	const std::vector<FGraphSubmission>& GetSubmissions() const;

	/// Lists passes (culled ones are marked), resources with size and lifetime, and barriers. After Execute or Compile.
	std::string Dump() const;
	FRTStatus Compile(); ///< does all of Execute except recording
	uint32_t GetPassCount() const;
	uint32_t GetCulledPassCount() const;

private:
	struct FImpl;
	std::unique_ptr<FImpl> Impl;
};

} // namespace Lantern
