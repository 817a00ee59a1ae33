// The creation functions of the device: each makes an object, lets it initialise itself, and hands it out.
#include "Commands/VulkanCommandList.h"

#include <cassert>

namespace Lantern
{

namespace
{

template <class T, class TInterface, class TInitialise>
FRTStatus CreateObject(FVulkanDevice& Device, TInterface** Out, TInitialise Initialise)
{
	*Out = nullptr;
	if (Device.IsLost()) { return Device.LostStatus(); }
	// AddRef and Release of TRTRef: a failed object goes the way of every released one.
	TRTRef<T> Object = MakeVulkanObject<T>(Device);
	FRTStatus Status = Initialise(*Object.Get());
	if (Status) { HandOut(Object, Out); }
	return Status;
}

} // namespace

FRTStatus FVulkanDevice::CreateBuffer(const FRTBufferDesc& Desc, IRTBuffer** Out)
{
	return CreateObject<FVulkanBuffer>(*this, Out, [&](FVulkanBuffer& It) { return It.Initialise(Desc); });
}

FRTStatus FVulkanDevice::CreateTexture(const FRTTextureDesc& Desc, IRTTexture** Out)
{
	return CreateObject<FVulkanTexture>(*this, Out, [&](FVulkanTexture& It) { return It.Initialise(Desc, VK_NULL_HANDLE); });
}

FRTStatus FVulkanDevice::ImportTexture(const FRTTextureDesc& Desc, uint64_t NativeImage, IRTTexture** Out)
{
	assert(NativeImage);
	return CreateObject<FVulkanTexture>(*this, Out, [&](FVulkanTexture& It) { return It.Initialise(Desc, (VkImage)NativeImage); });
}

FRTStatus FVulkanDevice::CreateSampler(const FRTSamplerDesc& Desc, IRTSampler** Out)
{
	return CreateObject<FVulkanSampler>(*this, Out, [&](FVulkanSampler& It) { return It.Initialise(Desc); });
}

FRTStatus FVulkanDevice::CreateComputePipeline(const FRTComputePipelineDesc& Desc, IRTPipeline** Out)
{
	return CreateObject<FVulkanPipeline>(*this, Out, [&](FVulkanPipeline& It) { return It.InitialiseCompute(Desc); });
}

FRTStatus FVulkanDevice::CreateRasterPipeline(const FRTRasterPipelineDesc& Desc, IRTPipeline** Out)
{
	return CreateObject<FVulkanPipeline>(*this, Out, [&](FVulkanPipeline& It) { return It.InitialiseRaster(Desc); });
}

FRTStatus FVulkanDevice::CreateRayTracingPipeline(const FRTRayTracingPipelineDesc& Desc, IRTPipeline** Out)
{
	return CreateObject<FVulkanPipeline>(*this, Out, [&](FVulkanPipeline& It) { return It.InitialiseRayTracing(Desc); });
}

FRTStatus FVulkanDevice::CreateGeometry(const FRTGeometryDesc& Desc, IRTGeometry** Out)
{
	return CreateObject<FVulkanGeometry>(*this, Out, [&](FVulkanGeometry& It) { return It.Initialise(Desc); });
}

FRTBuildSizes FVulkanDevice::GetGeometrySizes(const FRTGeometryDesc& Desc)
{
	return Bits.bAccel ? QueryGeometrySizes(*this, Desc) : FRTBuildSizes{};
}

FRTStatus FVulkanDevice::CreateScene(const FRTSceneDesc& Desc, IRTScene** Out)
{
	return CreateObject<FVulkanScene>(*this, Out, [&](FVulkanScene& It) { return It.Initialise(Desc); });
}

FRTStatus FVulkanDevice::CreateShaderTable(const FRTShaderTableDesc& Desc, IRTShaderTable** Out)
{
	return CreateObject<FVulkanShaderTable>(*this, Out, [&](FVulkanShaderTable& It) { return It.Initialise(Desc); });
}

FRTStatus FVulkanDevice::CreateQueryPool(ERTQuery Kind, uint32_t Count, IRTQueryPool** Out)
{
	return CreateObject<FVulkanQueryPool>(*this, Out, [&](FVulkanQueryPool& It) { return It.Initialise(Kind, Count); });
}

FRTStatus FVulkanDevice::CreateCommandList(const char* Name, IRTCommandList** Out)
{
	return CreateObject<FVulkanCommandList>(*this, Out, [&](FVulkanCommandList& It) { return It.Initialise(Name); });
}

FRTStatus FVulkanDevice::ImportCommandList(uint64_t NativeCommandBuffer, IRTCommandList** Out)
{
	assert(NativeCommandBuffer);
	return CreateObject<FVulkanCommandList>(*this, Out, [&](FVulkanCommandList& It) {
		It.InitialiseImported((VkCommandBuffer)NativeCommandBuffer);
		return FRTStatus();
	});
}

} // namespace Lantern
