// The mock device behind IRTDevice.
#pragma once

#include "MockObjects.h"

namespace Lantern
{

class FMockDevice final : public TRefCounted<IRTDevice>
{
public:
	explicit FMockDevice(std::shared_ptr<FMockState> InState);

	uint32_t GetVersion() const override { return RHIVersion; }
	const FRTCapabilities& GetCapabilities() const override { return State->Capabilities; }
	FRTStatus CreateBuffer(const FRTBufferDesc& Desc, IRTBuffer** Out) override;
	FRTStatus ImportBuffer(const FRTBufferDesc& Desc, const FRTNativeBuffer& Native, IRTBuffer** Out) override;
	FRTStatus CreateTexture(const FRTTextureDesc& Desc, IRTTexture** Out) override;
	FRTStatus ImportTexture(const FRTTextureDesc& Desc, uint64_t NativeImage, IRTTexture** Out) override;
	FRTStatus CreateSampler(const FRTSamplerDesc& Desc, IRTSampler** Out) override;
	FRTStatus CreateComputePipeline(const FRTComputePipelineDesc& Desc, IRTPipeline** Out) override;
	FRTStatus CreateRasterPipeline(const FRTRasterPipelineDesc& Desc, IRTPipeline** Out) override;
	FRTStatus CreateRayTracingPipeline(const FRTRayTracingPipelineDesc& Desc, IRTPipeline** Out) override;
	FRTStatus CreateGeometry(const FRTGeometryDesc& Desc, IRTGeometry** Out) override;
	FRTBuildSizes GetGeometrySizes(const FRTGeometryDesc& Desc) override;
	FRTStatus CreateScene(const FRTSceneDesc& Desc, IRTScene** Out) override;
	FRTStatus CreateShaderTable(const FRTShaderTableDesc& Desc, IRTShaderTable** Out) override;
	FRTStatus CreateQueryPool(ERTQuery Kind, uint32_t Count, IRTQueryPool** Out) override;
	FRTStatus CreateCommandList(const char* Name, IRTCommandList** Out, ERTQueue Queue) override;
	FRTStatus ImportCommandList(uint64_t NativeCommandBuffer, IRTCommandList** Out) override;
	FRTStatus Submit(IRTCommandList* const* Lists, uint32_t Count, FRTFence* OutFence, const FRTFence* Waits, uint32_t WaitCount) override;
	FRTStatus NotifyExternalSubmit(
	    IRTCommandList* const* Lists, uint32_t Count, FRTFence* OutFence, const FRTFence* Waits, uint32_t WaitCount) override;
	FRTFence GetCompletedFence(ERTQueue Queue) override;
	FRTStatus WaitFor(FRTFence Fence, uint64_t TimeoutNs) override;
	FRTStatus WaitIdle() override;
	void CollectGarbage() override { State->Collect(); }
	FRTMemoryStats GetMemoryStats() const override;
	uint32_t GetValidationMessageCount() const override { return 0; }
	uint64_t GetNative(ERTNative Kind) const override { return Kind == ERTNative::Device ? State->GetNativeDevice() : 0; }

	FRTMock Mock;

private:
	void OnFinalRelease() override;
	/// Logs the call; returns DeviceLost if the device is lost.
	FRTStatus Start(ERTMockCall Kind, const char* Name, const FRTMockNumbers& Numbers = {});
	FRTStatus TakeIndices(const FRTTextureDesc& Desc, FMockTexture& Texture);
	/// Sleeps and fails as tests asked for. Call it under no lock.
	FRTStatus Compile(const char* Name);
	void CheckLibrary(const FMockPipeline& Link, const FMockPipeline& Library);
	FRTStatus Enqueue(
	    ERTMockCall Kind, IRTCommandList* const* Lists, uint32_t Count, FRTFence* OutFence, const FRTFence* Waits, uint32_t WaitCount);

	std::shared_ptr<FMockState> State;
};

/// Hands the object out with its accounted memory.
template <class T, class I>
FRTStatus Finish(FMockState& State, std::unique_ptr<T> Object, EMockMemory Memory, uint64_t Bytes, I** Out)
{
	Object->Memory = Memory;
	Object->MemoryBytes = Bytes;
	State.Add(Object.get());
	*Out = Object.release();
	return FRTStatus::Success();
}

} // namespace Lantern
