// Internals of the frame graph, shared by the files FrameGraph*.cpp.
#pragma once

#include <chrono>
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

/// Timestamps and numbers of one executed graph.
struct FTimedFrame
{
	TRTRef<IRTQueryPool> Pool;
	std::vector<FPassTiming> Passes;
	uint64_t Serial = 0;
	uint64_t LastFirstNs = 0; ///< first timestamp read before: the same again means not yet written anew
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

	/// Returns a frame to record into. It has a query pool for PassCount passes if the device has timestamps.
	FTimedFrame& BeginTiming(uint32_t PassCount);
	void PollTimings();

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
	ERTAccess GetAccess() const { return Read | Write; }
};

struct FGraphBarrier
{
	uint32_t Resource = 0;
	ERTAccess Before = ERTAccess::None, After = ERTAccess::None;
};

struct FGraphPass
{
	std::string Name;
	std::vector<FPassUse> Uses;
	std::vector<uint32_t> Keeps;         ///< resources, see FPassBuilder::Keep
	std::vector<uint32_t> Dropped;       ///< resources that WriteIfRead declared and nobody reads
	std::vector<FGraphBarrier> Barriers; ///< before the pass
	FPassExecute Execute;
	bool bNeverCull = false;
	bool bCulled = false;
	std::string BadUse; ///< first wrong declaration, reported by Compile

	const FPassUse* Find(uint32_t Resource) const;
};

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
	void PlaceBarriersOf(uint32_t Resource, const std::vector<std::pair<uint32_t, ERTAccess>>& Uses);

	void Record(IRTCommandList& Commands, const FRTStatus* Failure);
	void RecordBarriers(IRTCommandList& Commands, const std::vector<FGraphBarrier>& Barriers) const;

	FFrameGraphResources::FImpl& Shared;
	std::vector<FGraphResource> Resources;
	std::vector<FGraphPass> Passes;
	std::vector<FGraphBarrier> FinalBarriers;
	std::unordered_map<const void*, uint32_t> Imported; ///< native object to resource
	/// Access of every pooled resource after the passes compiled so far.
	std::unordered_map<FPooledResource*, ERTAccess> PooledAccess;
	bool bCompiled = false;
	bool bExecuted = false;
	FRTStatus CompileStatus;
};

} // namespace Lantern
