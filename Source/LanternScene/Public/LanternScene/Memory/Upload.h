// Ways of getting bytes to the GPU: FUploader while loading (submits and waits by itself), FFrameUploads within
// a frame (memory that lives until the GPU has finished that frame). Each belongs to one thread.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "LanternRHI/RTInterfaces.h"

namespace Lantern
{

/// How buffers are read once they are filled.
inline constexpr ERTAccess UploadedAccess = ERTAccess::ShaderRead | ERTAccess::IndexRead | ERTAccess::GeometryInput;

class FUploader
{
public:
	explicit FUploader(IRTDevice& Device);
	~FUploader();
	/// Creates a device-local buffer and fills it. Size > 0.
	FRTStatus CreateBuffer(const char* Name, ERTBufferUsage Usage, const void* Data, uint64_t Size, TRTRef<IRTBuffer>& Out);
	/// Mip 0 from tightly packed rows, the others generated; left in ShaderRead.
	FRTStatus CreateTexture(const FRTTextureDesc& Desc, const void* Texels, TRTRef<IRTTexture>& Out);
	/// Submits what is pending and waits for it.
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
	/// Mapped memory for the current frame; Size > 0, aligned to 256 bytes.
	FRTStatus Allocate(uint64_t Size, FUploadSlice& Out);
	/// Allocates and copies.
	FRTStatus Push(const void* Data, uint64_t Size, FUploadSlice& Out);
	/// What was allocated since the last call is in use until Fence. Memory that nobody has needed for many frames is
	/// given back.
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
	std::vector<FPage> Free, Current, InFlight;
	uint64_t Used = 0; // of Current.back()
};

} // namespace Lantern
