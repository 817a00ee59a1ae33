// The frame graph. A frame is a list of passes; each declares what it reads and writes, and records its
// commands later. From the declarations follow barriers, lifetimes of transient resources (one that is over
// hands its place to a later one of equal description, in this frame or the next; there is no aliasing of
// memory between different descriptions), and which passes run at all: one whose results nobody reads is
// culled. Passes run in the order of AddPass. Barriers between the commands of one pass are its own affair.
//
//   FGraphTexture Mask = Graph.CreateTexture({.Width = W, .Height = H, .Format = …}, "SunShadowMask");
//   Graph.AddPass("SunShadow", [&](FPassBuilder& B) {
//       B.Read(Depth, ERTAccess::ShaderRead);
//       B.Write(Mask, ERTAccess::StorageWrite);
//       return [=](FPassContext& C) { C.Commands().SetPipeline(…); … C.GetTexture(Mask)->GetStorageIndex() … };
//   });
//
// A graph object is built, executed once, and thrown away; FFrameGraphResources keeps pools, timestamps and
// statistics across frames. Single-threaded.
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

struct FGraphTextureDesc
{
	uint32_t Width = 0, Height = 0;
	ERTFormat Format = ERTFormat::Unknown;
	/// Usage follows from the declared accesses; add what they do not show.
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
	/// Asserts unless the pass declared it. Null only for what nobody reads of FPassBuilder::WriteIfRead.
	virtual IRTTexture* GetTexture(FGraphTexture Texture) = 0;
	virtual IRTBuffer* GetBuffer(FGraphBuffer Buffer) = 0;
	/// Counts rays for the table of passes.
	virtual void CountRays(uint64_t Rays) = 0;

protected:
	~FPassContext() = default;
};

using FPassExecute = std::function<void(FPassContext&)>;

/// Read and Write of the same resource in one pass: it modifies what earlier passes left (StorageRead or ShaderRead
/// with StorageWrite only). Reading what no earlier pass wrote, and accesses that exclude each other, are errors
/// of Compile() that name pass and resource.
class FPassBuilder
{
public:
	virtual void Read(FGraphTexture Texture, ERTAccess Access) = 0;
	virtual void Read(FGraphBuffer Buffer, ERTAccess Access) = 0;
	virtual void Write(FGraphTexture Texture, ERTAccess Access) = 0;
	virtual void Write(FGraphBuffer Buffer, ERTAccess Access) = 0;
	/// One of several outputs of the pass. Where no pass that runs reads it, it is not made: GetTexture is null.
	virtual void WriteIfRead(FGraphTexture Texture, ERTAccess Access) = 0;
	/// Runs even if nobody reads its outputs (readback, writes to imported resources do so by themselves).
	virtual void NeverCull() = 0;
	/// This pass reads in the next frame what these hold at the end of this one: whatever writes them, before it or behind
	/// it, runs if it does. For what is marked by FFrameGraph::MarkForLater; no access of this pass, and no barrier.
	virtual void Keep(FGraphTexture Texture) = 0;
	virtual void Keep(FGraphBuffer Buffer) = 0;

protected:
	~FPassBuilder() = default;
};

struct FPassTiming
{
	std::string Name;
	double GpuMs = 0.0; ///< < 0: no timestamps on this device
	double CpuMs = 0.0; ///< recording, on the render thread
	uint64_t Rays = 0;
};

/// What outlives a frame: transient resource pool, timestamp queries, last finished timings.
/// From the begin of its first pass to the end of its last.
struct FFrameTiming
{
	uint64_t Frame = 0; ///< FFrameGraphResources::GetFrame
	double GpuMs = 0.0;
};

class FFrameGraphResources
{
public:
	explicit FFrameGraphResources(IRTDevice& Device);
	~FFrameGraphResources();
	/// Timings of the newest frame that the GPU has finished, in order of execution.
	const std::vector<FPassTiming>& GetTimings();
	/// Number of the graph that was executed last; rises.
	uint64_t GetFrame() const;
	/// Graphs that were found done since the last call, oldest first. One that was not submitted, or of a device without
	/// timestamps, never comes.
	std::vector<FFrameTiming> TakeFrameTimings();
	/// Frees pooled resources not used in the last Frames executed graphs or, with 0, all that are idle. Nothing else
	/// shrinks the pool but a shortage of memory: call it every frame or so.
	void Trim(uint32_t Frames);
	uint64_t GetPooledBytes() const;
	/// A debug facility: before the first pass of the next executed graph, everything in it that is marked as history and
	/// whose name contains NamePart ("": all) is overwritten with bits that are not-a-number in every float format, by a pass
	/// "Poison" of the graph's own. Calls before the same graph add up. What has no CopyDest usage is an error of Compile().
	void PoisonHistory(std::string NamePart);

private:
	friend class FFrameGraph;
	struct FImpl;
	std::unique_ptr<FImpl> Impl;
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
	/// Current: how it was last used, exactly; After (if not None): the access in which to leave it. Writing to an
	/// imported resource keeps a pass from being culled. The same object twice gives the same handle.
	FGraphTexture ImportTexture(IRTTexture* Texture, ERTAccess Current, ERTAccess After, const char* Name);
	FGraphBuffer ImportBuffer(IRTBuffer* Buffer, ERTAccess Current, ERTAccess After, const char* Name);
	/// An imported resource whose content comes from earlier frames: see FFrameGraphResources::PoisonHistory.
	void MarkHistory(FGraphTexture Texture);
	void MarkHistory(FGraphBuffer Buffer);
	/// An imported resource that is written for later frames only: by themselves, unlike others, writes to it keep no pass
	/// from being culled. Their pass runs if one that runs reads what it writes, or says FPassBuilder::Keep. OutWritten (may
	/// be null) must live until Compile, which sets it to whether a pass that runs writes the resource.
	void MarkForLater(FGraphTexture Texture, bool* OutWritten = nullptr);
	void MarkForLater(FGraphBuffer Buffer, bool* OutWritten = nullptr);
	/// What somebody does with a transient texture behind the graph, beside what passes declare.
	void AddUsage(FGraphTexture Texture, ERTTextureUsage Usage);
	const FGraphTextureDesc& GetDesc(FGraphTexture Texture) const;
	const FGraphBufferDesc& GetDesc(FGraphBuffer Buffer) const;

	/// Setup runs at once and returns what to record; it runs only if the pass is not culled.
	void AddPass(const char* Name, const std::function<FPassExecute(FPassBuilder&)>& Setup);

	/// Culls, allocates, records into Commands. On error (out of memory, device lost) nothing is recorded after
	/// the failing point and the message says which resource. Commands must be submitted, and graphs of the same
	/// FFrameGraphResources in the order of their Execute, on one queue: pooled resources carry their state over.
	/// Failure (may be null): where a pass sets it to an error, those behind it are not recorded, and it is returned.
	FRTStatus Execute(IRTCommandList& Commands, const FRTStatus* Failure = nullptr);

	/// Passes (culled ones marked), resources with size and lifetime, barriers: after Execute or Compile.
	std::string Dump() const;
	FRTStatus Compile(); ///< all of Execute but the recording
	uint32_t GetPassCount() const;
	uint32_t GetCulledPassCount() const;

private:
	struct FImpl;
	std::unique_ptr<FImpl> Impl;
};

} // namespace Lantern
