// The compute pass that bends the reed.
#include "Example/ForkSkin.h"

#include <cmath>
#include <cstring>

#include "ForkSkinShader.h"

namespace Fork
{

namespace
{

struct FPush
{
	VkDeviceAddress BindPose = 0, Vertices = 0, Traced = 0;
	float Sine = 0.0f, Cosine = 1.0f;
	uint32_t Count = 0;
};

constexpr uint32_t GroupSize = 64; // Fork.comp

/// All memory, which is simple and slow.
void Barrier(VkCommandBuffer Commands, VkPipelineStageFlags2 From, VkPipelineStageFlags2 To)
{
	VkMemoryBarrier2 Item{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
	Item.srcStageMask = From;
	Item.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
	Item.dstStageMask = To;
	Item.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
	VkDependencyInfo Info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
	Info.memoryBarrierCount = 1;
	Info.pMemoryBarriers = &Item;
	vkCmdPipelineBarrier2(Commands, &Info);
}

} // namespace

FError FForkSkin::Create(const FForkDevice& Owner)
{
	Device = Owner.Device;
	const FReedMesh Mesh = MakeReedMesh();
	VertexCount = static_cast<uint32_t>(Mesh.Vertices.size());
	IndexCount = static_cast<uint32_t>(Mesh.Indices.size());
	constexpr VkBufferUsageFlags Read = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
	FError Error = BindPose.Create(Owner, VertexCount * sizeof(FSkinVertex), Read);
	if (Error.empty()) { Error = Vertices.Create(Owner, VertexCount * sizeof(FVertex), Read | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT); }
	if (Error.empty()) { Error = Indices.Create(Owner, IndexCount * sizeof(uint32_t), VK_BUFFER_USAGE_INDEX_BUFFER_BIT); }
	if (!Error.empty()) { return Error; }
	std::memcpy(BindPose.Mapped, Mesh.Vertices.data(), VertexCount * sizeof(FSkinVertex));
	std::memset(Vertices.Mapped, 0, VertexCount * sizeof(FVertex)); // the frame before the first one
	std::memcpy(Indices.Mapped, Mesh.Indices.data(), IndexCount * sizeof(uint32_t));
	return CreatePipeline();
}

FError FForkSkin::CreatePipeline()
{
	const VkPushConstantRange Range{VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(FPush)};
	VkPipelineLayoutCreateInfo LayoutInfo{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
	LayoutInfo.pushConstantRangeCount = 1;
	LayoutInfo.pPushConstantRanges = &Range;
	vkCreatePipelineLayout(Device, &LayoutInfo, nullptr, &Layout);
	return CreateComputePipeline(Device, {ForkSkinShader, sizeof(ForkSkinShader)}, Layout, Pipeline);
}

void FForkSkin::Run(VkCommandBuffer Commands, const FReed& Reed, VkDeviceAddress Traced) const
{
	// The frame before may still read what is written here.
	Barrier(Commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT);
	const FPush Push{
	    BindPose.GetAddress(), Vertices.GetAddress(), Traced, float(std::sin(Reed.Bend)), float(std::cos(Reed.Bend)), VertexCount};
	vkCmdBindPipeline(Commands, VK_PIPELINE_BIND_POINT_COMPUTE, Pipeline);
	vkCmdPushConstants(Commands, Layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(Push), &Push);
	vkCmdDispatch(Commands, (VertexCount + GroupSize - 1) / GroupSize, 1, 1);
	Barrier(Commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT);
}

FForkSkin::~FForkSkin()
{
	if (Device != VK_NULL_HANDLE)
	{
		vkDestroyPipeline(Device, Pipeline, nullptr);
		vkDestroyPipelineLayout(Device, Layout, nullptr);
	}
}

} // namespace Fork
