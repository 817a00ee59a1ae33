// Mapped memory that instances are written to and that the GPU builds from: one buffer a frame, used again when its
// frame is done, grown by half, and given back when it has been too large for long.
#pragma once

#include <vector>

#include "LanternRHI/RTInterfaces.h"

namespace Lantern
{

/// One thread at a time.
class FInstanceUploads
{
public:
	explicit FInstanceUploads(IRTDevice& InDevice) : Device(InDevice) {}
	FInstanceUploads(const FInstanceUploads&) = delete;
	FInstanceUploads& operator=(const FInstanceUploads&) = delete;

	/// A buffer for Count instances that nobody reads; the current one from now on. Never waits.
	FRTStatus Reserve(uint32_t Count, IRTBuffer*& OutBuffer);
	/// The current buffer, which this frame's commands read. Its contents stay until the next Reserve.
	IRTBuffer* Use();
	/// bSubmitted, Fence: as FRTScene::EndFrame.
	void EndFrame(bool bSubmitted, FRTFence Fence);

private:
	struct FPage
	{
		TRTRef<IRTBuffer> Buffer;
		FRTFence Fence = 0; ///< of the newest frame that read it
		bool bUsed = false; ///< by this frame
		bool bLost = false; ///< was read by a frame whose fence is unknown: it can never be written again
		uint32_t IdleFrames = 0;
	};
	bool IsTooLarge(const FPage& Page) const;

	IRTDevice& Device;
	FPage Current;
	std::vector<FPage> Pages;
	uint64_t RecentBytes = 0; // needed by the largest of the last frames; older ones fade
};

} // namespace Lantern
