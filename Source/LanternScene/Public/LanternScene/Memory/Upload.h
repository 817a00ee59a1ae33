// Two ways to get bytes to the GPU. FUploader is for loading: it submits and waits by itself. FFrameUploads gives memory
// within a frame, which lives until the GPU has finished that frame. Each belongs to one thread; only memory within a frame may be
// asked for by several at once.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "LanternRHI/RTInterfaces.h"

namespace Lantern
{

/// Accesses that may follow an upload.
inline constexpr ERTAccess UploadedAccess = ERTAccess::ShaderRead | ERTAccess::IndexRead | ERTAccess::GeometryInput;

/// Value of r.RT.Upload.StagingMB, bytes. Any thread.
uint64_t GetMostStagingBytes();
/// Value of r.RT.Upload.MBPerFrame, bytes. Render thread.
uint64_t GetUploadBytesPerFrame();
/// Value of r.RT.Upload.TransferQueue. Render thread.
bool IsTransferQueueWanted();

class FUploader
{
public:
	explicit FUploader(IRTDevice& Device);
	~FUploader();
	/// Creates a device-local buffer and fills it. Size > 0.
	FRTStatus CreateBuffer(const char* Name, ERTBufferUsage Usage, const void* Data, uint64_t Size, TRTRef<IRTBuffer>& Out);
	/// Fills mip 0 from tightly packed rows and generates the others. The texture is left in ShaderRead.
	FRTStatus CreateTexture(const FRTTextureDesc& Desc, const void* Texels, TRTRef<IRTTexture>& Out);
	/// Submits pending copies and waits for them.
	FRTStatus Flush();

private:
	FRTStatus Reserve(uint64_t Size, uint64_t& OutOffset);
	FRTStatus BeginIfNeeded();

	IRTDevice& Device;
	TRTRef<IRTCommandList> List;
	TRTRef<IRTBuffer> Staging;
	uint64_t Used = 0;
	bool bRecording = false;
};

struct FUploadSlice
{
	IRTBuffer* Buffer = nullptr;
	uint64_t Offset = 0;
	uint64_t Address = 0;
	void* Data = nullptr;
};

class FFrameUploads
{
public:
	explicit FFrameUploads(IRTDevice& Device);
	/// Returns mapped memory for the current frame, aligned to 256 bytes. Size > 0. From any thread.
	FRTStatus Allocate(uint64_t Size, FUploadSlice& Out);
	/// Allocates memory and copies Data to it.
	FRTStatus Push(const void* Data, uint64_t Size, FUploadSlice& Out);
	/// Keeps the memory that was allocated since the last call until Fence. Frees memory that was idle for many frames.
	void EndFrame(FRTFence Fence);

private:
	struct FPage
	{
		TRTRef<IRTBuffer> Buffer;
		uint64_t Size = 0;
		FRTFence Fence = 0;
		uint32_t IdleFrames = 0;
	};
	void Collect();
	IRTDevice& Device;
	std::mutex Mutex; // of Allocate
	std::vector<FPage> Free, Current, InFlight;
	uint64_t Used = 0; // bytes of Current.back()
};

} // namespace Lantern
