// FUploader: one staging buffer and its waits. FFrameUploads: pages that are used again after their fence.
#include "LanternScene/Memory/Upload.h"

#include <algorithm>
#include <cassert>
#include <cstring>

#include "LanternCore/Config/ConsoleVariables.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<int32_t> CVarStaging("r.RT.Upload.StagingMB", 64,
    "Limits the staging memory for new meshes, MiB. Meshes that find no room in it wait on the CPU. Renderers that are created later use "
    "it.",
    {1, 4096});
TRTConsoleVariable<int32_t> CVarPerFrame("r.RT.Upload.MBPerFrame", 16,
    "Limits the data of new meshes that a frame copies to the GPU, MiB; at least one piece is copied.", {1, 4096});
TRTConsoleVariable<bool> CVarTransfer(
    "r.RT.Upload.TransferQueue", true, "Copies new meshes on a queue of their own, if the device has one. Off: within the frame.");

constexpr uint64_t StagingBytes = 32ull << 20;
constexpr uint64_t PageBytes = 1ull << 20;
constexpr uint64_t Alignment = 256;
constexpr uint32_t MostIdleFrames = 120;
constexpr uint64_t WaitNs = 60'000'000'000ull;

uint64_t AlignUpload(uint64_t Value) { return (Value + Alignment - 1) & ~(Alignment - 1); }
} // namespace

uint64_t GetMostStagingBytes() { return static_cast<uint64_t>(std::get<int32_t>(CVarStaging.GetValue())) << 20; }
uint64_t GetUploadBytesPerFrame() { return static_cast<uint64_t>(CVarPerFrame.GetOnRenderThread()) << 20; }
bool IsTransferQueueWanted() { return CVarTransfer.GetOnRenderThread(); }

FUploader::FUploader(IRTDevice& InDevice) : Device(InDevice) {}

FUploader::~FUploader()
{
	// Callers that care about errors have flushed already.
	if (bRecording) { (void)Flush(); }
}

FRTStatus FUploader::BeginIfNeeded()
{
	if (bRecording) { return FRTStatus::Success(); }
	if (!List)
	{
		if (FRTStatus S = Device.CreateCommandList("Uploads", List.ReleaseAndGetAddress()); !S) { return S; }
	}
	const FRTStatus Begun = List->Begin();
	bRecording = Begun.IsOk();
	return Begun;
}

FRTStatus FUploader::Reserve(uint64_t Size, uint64_t& OutOffset)
{
	if (Used + Size > (Staging ? Staging->GetDesc().Size : 0))
	{
		if (FRTStatus S = Flush(); !S) { return S; }
		if (!Staging || Staging->GetDesc().Size < Size)
		{
			const FRTBufferDesc Desc{std::max(Size, StagingBytes), ERTBufferUsage::CopySource, ERTMemory::Upload, "UploadStaging"};
			if (FRTStatus S = Device.CreateBuffer(Desc, Staging.ReleaseAndGetAddress()); !S) { return S; }
		}
	}
	OutOffset = Used;
	Used = AlignUpload(Used + Size);
	return BeginIfNeeded();
}

FRTStatus FUploader::CreateBuffer(const char* Name, ERTBufferUsage Usage, const void* Data, uint64_t Size, TRTRef<IRTBuffer>& Out)
{
	const FRTBufferDesc Desc{Size, Usage | ERTBufferUsage::CopyDest, ERTMemory::Device, Name};
	if (FRTStatus S = Device.CreateBuffer(Desc, Out.ReleaseAndGetAddress()); !S) { return S; }
	uint64_t Offset = 0;
	if (FRTStatus S = Reserve(Size, Offset); !S) { return S; }
	std::memcpy(static_cast<uint8_t*>(Staging->GetMapped()) + Offset, Data, Size);
	List->CopyBuffer(Out.Get(), 0, Staging.Get(), Offset, Size);
	return FRTStatus::Success();
}

FRTStatus FUploader::CreateTexture(const FRTTextureDesc& Desc, const void* Texels, TRTRef<IRTTexture>& Out)
{
	FRTTextureDesc Full = Desc;
	Full.Usage |= ERTTextureUsage::CopyDest | ERTTextureUsage::CopySource;
	if (FRTStatus S = Device.CreateTexture(Full, Out.ReleaseAndGetAddress()); !S) { return S; }
	const uint64_t Size = uint64_t(Desc.Width) * Desc.Height * BytesPerTexel(Desc.Format);
	uint64_t Offset = 0;
	if (FRTStatus S = Reserve(Size, Offset); !S) { return S; }
	std::memcpy(static_cast<uint8_t*>(Staging->GetMapped()) + Offset, Texels, Size);
	const FRTBarrier ToCopy{nullptr, Out.Get(), ERTAccess::None, ERTAccess::CopyWrite};
	List->Barriers(&ToCopy, 1);
	List->CopyBufferToTexture(Out.Get(), 0, 0, Staging.Get(), Offset);
	if (Desc.MipCount > 1) { List->GenerateMips(Out.Get()); }
	else
	{
		const FRTBarrier ToRead{nullptr, Out.Get(), ERTAccess::CopyWrite, ERTAccess::ShaderRead};
		List->Barriers(&ToRead, 1);
	}
	return FRTStatus::Success();
}

FRTStatus FUploader::Flush()
{
	Used = 0;
	if (!bRecording) { return FRTStatus::Success(); }
	bRecording = false;
	const FRTBarrier AllDone{nullptr, nullptr, ERTAccess::CopyWrite, UploadedAccess};
	List->Barriers(&AllDone, 1);
	if (FRTStatus S = List->End(); !S) { return S; }
	FRTFence Fence = 0;
	IRTCommandList* const Lists[] = {List.Get()};
	if (FRTStatus S = Device.Submit(Lists, 1, &Fence); !S) { return S; }
	return Device.WaitFor(Fence, WaitNs);
}

FFrameUploads::FFrameUploads(IRTDevice& InDevice) : Device(InDevice) {}

void FFrameUploads::Collect()
{
	const FRTFence Completed = Device.GetCompletedFence();
	for (size_t I = 0; I < InFlight.size();)
	{
		if (InFlight[I].Fence > Completed)
		{
			++I;
			continue;
		}
		Free.push_back(std::move(InFlight[I]));
		if (I + 1 < InFlight.size()) { InFlight[I] = std::move(InFlight.back()); }
		InFlight.pop_back();
	}
}

FRTStatus FFrameUploads::Allocate(uint64_t Size, FUploadSlice& Out)
{
	const std::lock_guard Lock(Mutex);
	if (Current.empty() || Used + Size > Current.back().Size)
	{
		Collect();
		// The smallest page that is large enough, so that large ones stay idle and are freed.
		auto Fitting = Free.end();
		for (auto Page = Free.begin(); Page != Free.end(); ++Page)
		{
			if (Page->Size >= Size && (Fitting == Free.end() || Page->Size < Fitting->Size)) { Fitting = Page; }
		}
		FPage Page;
		if (Fitting != Free.end())
		{
			Page = std::move(*Fitting);
			Free.erase(Fitting);
		}
		else
		{
			Page.Size = std::max(PageBytes, AlignUpload(Size));
			const FRTBufferDesc Desc{Page.Size, ERTBufferUsage::CopySource | ERTBufferUsage::Storage | ERTBufferUsage::GeometryInput,
			    ERTMemory::Upload, "FrameUploads"};
			if (FRTStatus S = Device.CreateBuffer(Desc, Page.Buffer.ReleaseAndGetAddress()); !S) { return S; }
		}
		Current.push_back(std::move(Page));
		Used = 0;
	}
	FPage& Page = Current.back();
	Out.Buffer = Page.Buffer.Get();
	Out.Offset = Used;
	Out.Address = Page.Buffer->GetDeviceAddress() + Used;
	Out.Data = static_cast<uint8_t*>(Page.Buffer->GetMapped()) + Used;
	Used = AlignUpload(Used + Size);
	return FRTStatus::Success();
}

FRTStatus FFrameUploads::Push(const void* Data, uint64_t Size, FUploadSlice& Out)
{
	if (FRTStatus S = Allocate(Size, Out); !S) { return S; }
	std::memcpy(Out.Data, Data, Size);
	return FRTStatus::Success();
}

void FFrameUploads::EndFrame(FRTFence Fence)
{
	for (FPage& Page : Current)
	{
		Page.Fence = Fence;
		Page.IdleFrames = 0;
		InFlight.push_back(std::move(Page));
	}
	std::erase_if(Free, [](FPage& Page) { return ++Page.IdleFrames > MostIdleFrames; });
	Current.clear();
	Used = 0;
}

} // namespace Lantern
