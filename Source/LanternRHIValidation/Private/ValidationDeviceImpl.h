// The wrapper around a device.
#pragma once

#include "ValidationCommandList.h"

namespace Lantern
{

class FValidatedDevice final : public TRefCounted<IRTDevice>, public FValidated
{
public:
	explicit FValidatedDevice(std::shared_ptr<FValidationState> InState) : FValidated(std::move(InState), "device") {}

	IRTRefCounted* GetInner() const override { return State->Inner.Get(); }

	uint32_t GetVersion() const override { return State->Inner->GetVersion(); }
	const FRTCapabilities& GetCapabilities() const override { return State->Inner->GetCapabilities(); }
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
	FRTFence GetCompletedFence(ERTQueue Queue) override { return State->Inner->GetCompletedFence(Queue); }
	FRTStatus WaitFor(FRTFence Fence, uint64_t TimeoutNs) override;
	FRTStatus WaitIdle() override { return State->Inner->WaitIdle(); }
	void CollectGarbage() override { State->Inner->CollectGarbage(); }
	FRTMemoryStats GetMemoryStats() const override { return State->Inner->GetMemoryStats(); }
	uint32_t GetValidationMessageCount() const override { return State->Inner->GetValidationMessageCount(); }
	uint64_t GetNative(ERTNative Kind) const override { return State->Inner->GetNative(Kind); }

private:
	FRTStatus CheckWaits(const char* Call, ERTQueue Queue, const FRTFence* Waits, uint32_t WaitCount);
	/// Reports what was never released.
	void OnFinalRelease() override;
	// These return what is wrong, or nothing if the description is good.
	std::string CheckTexture(const FRTTextureDesc& Desc) const;
	std::string CheckSections(const FRTGeometryDesc& Desc) const;
	std::vector<FRTGeometrySection> UnwrapSections(const FRTGeometryDesc& Desc) const;
	/// OutLibraries: the wrappers around the libraries.
	std::string CheckLibraries(const FRTRayTracingPipelineDesc& Desc, std::vector<FValidatedPipeline*>& OutLibraries) const;
	FRTStatus Collect(IRTCommandList* const* Lists, uint32_t Count, bool bImported, std::vector<FValidatedCommandList*>& OutLists);
};

} // namespace Lantern
