// The second device of FRTVulkanDeviceDesc::bCompileDevice.
#include "Pipelines/VulkanCompileAhead.h"

#include "Pipelines/VulkanPipeline.h"

#include <cassert>

namespace Lantern
{

FVulkanOwnCache::~FVulkanOwnCache()
{
	if (Handle) { Device.Api.DestroyPipelineCache(Device.Handle, Handle, nullptr); }
}

VkResult FVulkanOwnCache::Create(const std::vector<char>& Data)
{
	VkPipelineCacheCreateInfo Info{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
	Info.initialDataSize = Data.size();
	Info.pInitialData = Data.data();
	return Device.Check(Device.Api.CreatePipelineCache(Device.Handle, &Info, nullptr, &Handle));
}

VkResult FVulkanOwnCache::Read(std::vector<char>& OutData) const
{
	size_t Size = 0;
	VkResult Result = Device.Check(Device.Api.GetPipelineCacheData(Device.Handle, Handle, &Size, nullptr));
	OutData.resize(Size);
	Result = Result ? Result : Device.Check(Device.Api.GetPipelineCacheData(Device.Handle, Handle, &Size, OutData.data()));
	OutData.resize(Size);
	return Result;
}

FRTStatus CompileAhead(FVulkanDevice& Helper, const FRTRayTracingPipelineDesc& Desc, std::vector<char>& OutData)
{
	assert(Desc.bLibrary && Desc.LibraryCount == 0);
	FVulkanOwnCache Cache(Helper);
	FRTStatus Status = MakeStatus(Cache.Create({}), "Creating a pipeline cache for", Desc.Name);
	if (Status)
	{
		TRTRef<FVulkanPipeline> Pipeline = MakeVulkanObject<FVulkanPipeline>(Helper);
		Status = Pipeline->InitialiseRayTracing(Desc, Cache.Handle);
	}
	Helper.CollectGarbage(); // it submits nothing, which would do so
	return Status ? MakeStatus(Cache.Read(OutData), "Reading the pipeline cache of", Desc.Name) : Status;
}

} // namespace Lantern
