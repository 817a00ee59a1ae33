// FInstanceUploads gives the mapped memory that instances are written to and the GPU builds from: one buffer a frame. A
// buffer is used again when its frame is done. New ones have room for half as many instances again. One that was too large
// for long is released.
#pragma once

#include <vector>

#include "LanternRHI/RTInterfaces.h"

namespace Lantern
{

/// Threads: one at a time.
class FInstanceUploads
{
public:
	explicit FInstanceUploads(IRTDevice& InDevice) : Device(InDevice) {}
	FInstanceUploads(const FInstanceUploads&) = delete;
	FInstanceUploads& operator=(const FInstanceUploads&) = delete;

	/// Returns a buffer for Count instances that the GPU does not read. It is the current one from now on. Never waits.
	FRTStatus Reserve(uint32_t Count, IRTBuffer*& OutBuffer);
	/// Returns the current buffer and marks it as read by this frame. Its contents stay until the next Reserve.
	IRTBuffer* Use();
	/// bSubmitted and Fence are as in FRTScene::EndFrame.
	void EndFrame(bool bSubmitted, FRTFence Fence);

private:
	struct FPage
	{
		TRTRef<IRTBuffer> Buffer;
		FRTFence Fence = 0; ///< of the newest frame that read it
		bool bUsed = false; ///< by this frame
		bool bLost = false; ///< read by a frame whose fence is unknown: it can never be written again
		uint32_t IdleFrames = 0;
	};
	bool IsTooLarge(const FPage& Page) const;

	IRTDevice& Device;
	FPage Current;
	std::vector<FPage> Pages;
	uint64_t RecentBytes = 0; // needed by the largest of the last frames; older ones fade
};

} // namespace Lantern
