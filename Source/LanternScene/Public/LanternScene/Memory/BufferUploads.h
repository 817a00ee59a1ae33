// Buffers of geometry on their way to the GPU, through a ring of staging memory, while frames go on. Whoever adds one copies it into
// the ring if there is room. Otherwise a thread of its own does so once there is. The render thread only records the copies, so
// many a frame. Where the device has a queue for copies alone, they run there.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "LanternScene/Geometry/Geometry.h"

namespace Lantern
{

/// One buffer's way to the GPU.
struct FBufferUpload
{
	/// Writes Size bytes from Offset on to Out. Called from any thread, one at a time; empty once all is in the ring.
	std::function<void(uint64_t Offset, uint64_t Size, uint8_t* Out)> Copy;
	TRTRef<IRTBuffer> Buffer; ///< with ERTBufferUsage::CopyDest
	uint64_t Bytes = 0;       ///< of Buffer
	// Render thread.
	FRTGeometryRef Geometry; ///< in Buffer; for the owner
	/// Commands that are recorded from now on find the data. Any thread may read it.
	std::atomic<bool> bFilled = false;
};
using FBufferUploadRef = std::shared_ptr<FBufferUpload>;

class FBufferUploads
{
public:
	explicit FBufferUploads(IRTDevice& InDevice);
	~FBufferUploads();
	FBufferUploads(const FBufferUploads&) = delete;
	FBufferUploads& operator=(const FBufferUploads&) = delete;

	/// Takes an upload whose source and buffer are there. OutOfDeviceMemory: there is none for the ring. Any thread; waits for nothing
	/// but other threads' copies of memory.
	FRTStatus Add(const FBufferUploadRef& Upload);
	/// Records copies into List, or submits them on the queue for copies. Ends with barriers, after which the buffers of
	/// OutFilled may be read in List. On an error List must not be submitted. Render thread; waits for nothing.
	FRTStatus Record(IRTCommandList& List, std::vector<FBufferUploadRef>& OutFilled);
	/// Fence: that of List; 0: it never runs, and what it had is recorded again. Render thread.
	void EndFrame(FRTFence Fence);

private:
	struct FWaiting
	{
		FBufferUploadRef Upload;
		uint64_t Done = 0; ///< bytes that are in the ring
	};
	/// A part of a buffer in the ring.
	struct FChunk
	{
		FBufferUploadRef Upload;
		TRTRef<IRTBuffer> Ring; ///< the one of its time
		uint64_t DestOffset = 0, RingOffset = 0, Size = 0;
		uint64_t RingBytes = 0; ///< taken of the ring, with what was left over at its end
		bool bLast = false;     ///< of its buffer
	};
	/// Chunks whose place in the ring is free again after the fence.
	struct FBatch
	{
		FRTFence Fence = 0;
		std::vector<FChunk> Chunks;
		TRTRef<IRTCommandList> List; ///< of the queue for copies; null: the frame's
	};

	/// Makes the first ring.
	FRTStatus MakeRing();
	/// Takes a larger ring from now on. StageMutex must be held. False: there is none.
	bool Grow();
	FRTStatus SetRing(uint64_t Size);
	/// Mutex must be held. False: there is no room.
	bool TakeRoom(uint64_t Wanted, FChunk& Out);
	/// Fills the ring until nothing waits or there is no room. One thread at a time; others leave it to that one.
	void Stage();
	/// False: nothing waits, or there is no room.
	bool NextChunk(FChunk& Out);
	void RunStager();
	std::vector<FChunk> TakeStaged();
	void ReleaseRoom(const std::vector<FChunk>& Chunks);
	void PutBack(std::vector<FChunk> Chunks);
	FRTStatus Submit(std::vector<FChunk> Chunks);
	FRTStatus BeginTransferList(TRTRef<IRTCommandList>& Out);
	void CollectBatches();
	void RecordCopies(IRTCommandList& List, const std::vector<FChunk>& Chunks);

	IRTDevice& Device;
	std::mutex StageMutex;           ///< of whoever copies into the ring
	std::atomic<bool> bRing = false; ///< Ring is there
	const uint64_t LargestRing;

	std::mutex Mutex; ///< of the next members; held for moments only
	std::deque<FWaiting> Waiting;
	std::deque<FChunk> Staged;
	TRTRef<IRTBuffer> Ring;
	uint64_t RingSize = 0;
	uint64_t Head = 0, Used = 0; ///< of the ring: where the next chunk begins, and bytes taken before it
	bool bStop = false, bWake = false;
	std::condition_variable Wake;
	std::thread Stager; ///< runs from the first time that something waited

	// Render thread.
	std::deque<FBatch> Batches; ///< in flight, oldest first
	std::vector<FChunk> Recorded;
	std::vector<FBufferUploadRef> Copied;   ///< by the queue for copies; barriers in a frame's list are missing
	std::vector<FBufferUploadRef> Acquired; ///< of these, in the frame that is being recorded
	std::vector<TRTRef<IRTCommandList>> FreeLists;
};

} // namespace Lantern
