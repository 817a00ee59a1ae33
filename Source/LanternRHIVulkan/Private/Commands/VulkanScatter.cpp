// FVulkanScatter: the compute pass that copies words all over a buffer.
#include "Commands/VulkanScatter.h"

#include "Pipelines/VulkanShaderModules.h"

#include "Shaders/Scatter_comp.h"

#include <algorithm>
#include <iterator>

namespace Lantern
{

FRTStatus FVulkanScatter::Create(FVulkanDevice& Device)
{
	FVulkanModules Modules(Device);
	FRTStatus Status = Modules.Add({Scatter_comp, std::size(Scatter_comp), ERTShaderStage::Compute, "Scatter.comp"});
	if (!Status) { return Status; }
	VkComputePipelineCreateInfo Info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
	Info.stage = Modules.Stages[0];
	Info.layout = Device.Bindless.PipelineLayout;
	const VkResult Result =
	    Device.Check(Device.Api.CreateComputePipelines(Device.Handle, Device.Cache.Handle, 1, &Info, nullptr, &Pipeline));
	Pipeline = Result == VK_SUCCESS ? Pipeline : VK_NULL_HANDLE;
	Device.SetName(VK_OBJECT_TYPE_PIPELINE, ToNative(Pipeline), "Scatter");
	return MakeStatus(Result, "Creating compute pipeline", "Scatter");
}

void FVulkanScatter::Destroy(FVulkanDevice& Device)
{
	if (Pipeline)
	{
		Device.Api.DestroyPipeline(Device.Handle, Pipeline, nullptr);
		Pipeline = VK_NULL_HANDLE;
	}
}

void FVulkanScatter::Record(FVulkanDevice& Device, VkCommandBuffer List, const FPush& Push) const
{
	constexpr uint32_t GroupSize = 64, MaxGroups = 65535;
	const uint64_t Words = uint64_t(Push.WordsPerItem) * Push.Count;
	const uint32_t Groups = static_cast<uint32_t>(std::min<uint64_t>((Words + GroupSize - 1) / GroupSize, MaxGroups));
	Device.Api.CmdBindPipeline(List, VK_PIPELINE_BIND_POINT_COMPUTE, Pipeline);
	Device.Api.CmdPushConstants(List, Device.Bindless.PipelineLayout, AllStages(Device.Bits), 0, sizeof(Push), &Push);
	Device.Api.CmdDispatch(List, Groups, 1, 1);
}

} // namespace Lantern
