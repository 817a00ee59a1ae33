// Tables from the RHI's formats, usages and accesses to Vulkan's.
#include "Device/VulkanTranslate.h"

#include "LanternRHIVulkan/VulkanInterop.h"

#include <cassert>

namespace Lantern
{

VkFormat GetVulkanFormat(ERTFormat Format)
{
	switch (Format)
	{
	case ERTFormat::Unknown: return VK_FORMAT_UNDEFINED;
	case ERTFormat::R8_UNORM: return VK_FORMAT_R8_UNORM;
	case ERTFormat::RG8_UNORM: return VK_FORMAT_R8G8_UNORM;
	case ERTFormat::RGBA8_UNORM: return VK_FORMAT_R8G8B8A8_UNORM;
	case ERTFormat::RGBA8_SRGB: return VK_FORMAT_R8G8B8A8_SRGB;
	case ERTFormat::RGB10A2_UNORM: return VK_FORMAT_A2B10G10R10_UNORM_PACK32;
	case ERTFormat::R11G11B10_FLOAT: return VK_FORMAT_B10G11R11_UFLOAT_PACK32;
	case ERTFormat::R16_FLOAT: return VK_FORMAT_R16_SFLOAT;
	case ERTFormat::RG16_FLOAT: return VK_FORMAT_R16G16_SFLOAT;
	case ERTFormat::RGBA16_FLOAT: return VK_FORMAT_R16G16B16A16_SFLOAT;
	case ERTFormat::RG16_UNORM: return VK_FORMAT_R16G16_UNORM;
	case ERTFormat::RGBA16_UNORM: return VK_FORMAT_R16G16B16A16_UNORM;
	case ERTFormat::RG16_SNORM: return VK_FORMAT_R16G16_SNORM;
	case ERTFormat::RGBA16_SNORM: return VK_FORMAT_R16G16B16A16_SNORM;
	case ERTFormat::R16_UINT: return VK_FORMAT_R16_UINT;
	case ERTFormat::R32_UINT: return VK_FORMAT_R32_UINT;
	case ERTFormat::RG32_UINT: return VK_FORMAT_R32G32_UINT;
	case ERTFormat::RGBA32_UINT: return VK_FORMAT_R32G32B32A32_UINT;
	case ERTFormat::R32_FLOAT: return VK_FORMAT_R32_SFLOAT;
	case ERTFormat::RG32_FLOAT: return VK_FORMAT_R32G32_SFLOAT;
	case ERTFormat::RGBA32_FLOAT: return VK_FORMAT_R32G32B32A32_SFLOAT;
	case ERTFormat::D32_FLOAT: return VK_FORMAT_D32_SFLOAT;
	case ERTFormat::RGBA8_SNORM: return VK_FORMAT_R8G8B8A8_SNORM;
	case ERTFormat::BGRA8_UNORM: return VK_FORMAT_B8G8R8A8_UNORM;
	case ERTFormat::BGRA8_SRGB: return VK_FORMAT_B8G8R8A8_SRGB;
	case ERTFormat::D16_UNORM: return VK_FORMAT_D16_UNORM;
	case ERTFormat::D24_UNORM_S8_UINT: return VK_FORMAT_D24_UNORM_S8_UINT;
	case ERTFormat::D32_FLOAT_S8_UINT: return VK_FORMAT_D32_SFLOAT_S8_UINT;
	case ERTFormat::BC1_UNORM: return VK_FORMAT_BC1_RGBA_UNORM_BLOCK;
	case ERTFormat::BC1_SRGB: return VK_FORMAT_BC1_RGBA_SRGB_BLOCK;
	case ERTFormat::BC3_UNORM: return VK_FORMAT_BC3_UNORM_BLOCK;
	case ERTFormat::BC3_SRGB: return VK_FORMAT_BC3_SRGB_BLOCK;
	case ERTFormat::BC4_UNORM: return VK_FORMAT_BC4_UNORM_BLOCK;
	case ERTFormat::BC5_UNORM: return VK_FORMAT_BC5_UNORM_BLOCK;
	case ERTFormat::BC6H_FLOAT: return VK_FORMAT_BC6H_UFLOAT_BLOCK;
	case ERTFormat::BC7_UNORM: return VK_FORMAT_BC7_UNORM_BLOCK;
	case ERTFormat::BC7_SRGB: return VK_FORMAT_BC7_SRGB_BLOCK;
	case ERTFormat::ASTC4x4_UNORM: return VK_FORMAT_ASTC_4x4_UNORM_BLOCK;
	case ERTFormat::ASTC4x4_SRGB: return VK_FORMAT_ASTC_4x4_SRGB_BLOCK;
	}
	return VK_FORMAT_UNDEFINED;
}

VkImageLayout GetVulkanLayout(ERTAccess Access)
{
	if (HasAny(Access, ERTAccess::StorageRead | ERTAccess::StorageWrite)) { return VK_IMAGE_LAYOUT_GENERAL; }
	switch (Access)
	{
	case ERTAccess::None: return VK_IMAGE_LAYOUT_UNDEFINED;
	case ERTAccess::ShaderRead: return VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
	case ERTAccess::RenderTarget: return VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
	case ERTAccess::DepthWrite: return VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
	case ERTAccess::CopyRead: return VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
	case ERTAccess::CopyWrite: return VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
	// No single layout serves such reads, for example sampled and copied from.
	default: return VK_IMAGE_LAYOUT_GENERAL;
	}
}

VkImageAspectFlags AspectOf(ERTFormat Format) { return IsDepth(Format) ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT; }

VkImageAspectFlags AllAspectsOf(ERTFormat Format)
{
	return AspectOf(Format) | (HasStencil(Format) ? VkImageAspectFlags(VK_IMAGE_ASPECT_STENCIL_BIT) : 0u);
}

bool IsIntegerFormat(ERTFormat Format)
{
	switch (Format)
	{
	case ERTFormat::R16_UINT:
	case ERTFormat::R32_UINT:
	case ERTFormat::RG32_UINT:
	case ERTFormat::RGBA32_UINT: return true;
	default: return false;
	}
}

VkImageUsageFlags ImageUsageOf(const FRTTextureDesc& Desc)
{
	VkImageUsageFlags Usage = 0;
	const auto Map = [&](ERTTextureUsage From, VkImageUsageFlags To) {
		if (HasAny(Desc.Usage, From)) { Usage |= To; }
	};
	Map(ERTTextureUsage::Sampled, VK_IMAGE_USAGE_SAMPLED_BIT);
	Map(ERTTextureUsage::Storage, VK_IMAGE_USAGE_STORAGE_BIT);
	Map(ERTTextureUsage::RenderTarget, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT);
	Map(ERTTextureUsage::Depth, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT);
	Map(ERTTextureUsage::CopySource, VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
	Map(ERTTextureUsage::CopyDest, VK_IMAGE_USAGE_TRANSFER_DST_BIT);
	if (Desc.MipCount > 1 && HasAny(Desc.Usage, ERTTextureUsage::CopyDest))
	{
		Usage |= VK_IMAGE_USAGE_TRANSFER_SRC_BIT; // GenerateMips blits from one mip to the next
	}
	return Usage;
}

VkBufferUsageFlags BufferUsageOf(ERTBufferUsage Usage, const FVulkanCapabilityBits& Bits)
{
	// Buffers are reached by address and may be filled or read back: what costs nothing is always there.
	VkBufferUsageFlags Result = VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
	const auto Map = [&](ERTBufferUsage From, VkBufferUsageFlags To) {
		if (HasAny(Usage, From)) { Result |= To; }
	};
	Map(ERTBufferUsage::Index, VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
	Map(ERTBufferUsage::Indirect, VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT);
	Map(ERTBufferUsage::CopySource, VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
	Map(ERTBufferUsage::CopyDest, VK_BUFFER_USAGE_TRANSFER_DST_BIT);
	if (Bits.bAccel) { Map(ERTBufferUsage::GeometryInput, VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR); }
	if (Bits.bPipeline) { Map(ERTBufferUsage::ShaderTable, VK_BUFFER_USAGE_SHADER_BINDING_TABLE_BIT_KHR); }
	return Result;
}

namespace
{

VkPipelineStageFlags2 ShaderStages(const FVulkanCapabilityBits& Bits)
{
	VkPipelineStageFlags2 Stages =
	    VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
	if (Bits.bPipeline) { Stages |= VK_PIPELINE_STAGE_2_RAY_TRACING_SHADER_BIT_KHR; }
	return Stages;
}

FVulkanAccess TraceReadOf(const FVulkanCapabilityBits& Bits)
{
	FVulkanAccess Result;
	if (Bits.bPipeline)
	{
		Result.Stages |= VK_PIPELINE_STAGE_2_RAY_TRACING_SHADER_BIT_KHR;
		// Without VK_KHR_ray_tracing_maintenance1, the shader table is read as SHADER_READ.
		Result.Access |= VK_ACCESS_2_SHADER_READ_BIT | VK_ACCESS_2_ACCELERATION_STRUCTURE_READ_BIT_KHR;
		if (Bits.bMaintenance1) { Result.Access |= VK_ACCESS_2_SHADER_BINDING_TABLE_READ_BIT_KHR; }
	}
	if (Bits.bRayQuery)
	{
		Result.Stages |= ShaderStages(Bits);
		Result.Access |= VK_ACCESS_2_ACCELERATION_STRUCTURE_READ_BIT_KHR;
	}
	return Result;
}

FVulkanAccess BuildAccessOf(ERTAccess One, const FVulkanCapabilityBits& Bits)
{
	if (One == ERTAccess::TraceRead) { return TraceReadOf(Bits); }
	if (!Bits.bAccel) { return {}; }
	const VkPipelineStageFlags2 Build = VK_PIPELINE_STAGE_2_ACCELERATION_STRUCTURE_BUILD_BIT_KHR;
	switch (One)
	{
	case ERTAccess::GeometryInput: return {Build, VK_ACCESS_2_SHADER_READ_BIT};
	case ERTAccess::BuildRead: return {Build, VK_ACCESS_2_ACCELERATION_STRUCTURE_READ_BIT_KHR};
	case ERTAccess::BuildWrite:
		return {Build, VK_ACCESS_2_ACCELERATION_STRUCTURE_READ_BIT_KHR | VK_ACCESS_2_ACCELERATION_STRUCTURE_WRITE_BIT_KHR};
	default: return {};
	}
}

FVulkanAccess OneAccessOf(ERTAccess One, const FVulkanCapabilityBits& Bits)
{
	switch (One)
	{
	case ERTAccess::None: return {};
	case ERTAccess::ShaderRead: return {ShaderStages(Bits), VK_ACCESS_2_SHADER_SAMPLED_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_READ_BIT};
	case ERTAccess::StorageRead: return {ShaderStages(Bits), VK_ACCESS_2_SHADER_STORAGE_READ_BIT};
	case ERTAccess::StorageWrite: return {ShaderStages(Bits), VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT};
	case ERTAccess::RenderTarget:
		return {VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
		    VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};
	case ERTAccess::DepthWrite:
		return {VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
		    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};
	case ERTAccess::IndexRead: return {VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT, VK_ACCESS_2_INDEX_READ_BIT};
	case ERTAccess::IndirectRead: return {VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT};
	case ERTAccess::CopyRead: return {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT};
	case ERTAccess::CopyWrite: return {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT};
	case ERTAccess::HostRead: return {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT};
	default: return BuildAccessOf(One, Bits);
	}
}

} // namespace

FVulkanAccess AccessOf(ERTAccess Access, const FVulkanCapabilityBits& Bits)
{
	FVulkanAccess Result;
	for (uint32_t Left = static_cast<uint32_t>(Access); Left != 0; Left &= Left - 1)
	{
		const FVulkanAccess One = OneAccessOf(static_cast<ERTAccess>(Left & (~Left + 1)), Bits);
		Result.Stages |= One.Stages;
		Result.Access |= One.Access;
	}
	return Result;
}

FVulkanAccess ForComputeQueue(FVulkanAccess Access)
{
	constexpr VkPipelineStageFlags2 Stages =
	    VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_RAY_TRACING_SHADER_BIT_KHR |
	    VK_PIPELINE_STAGE_2_ACCELERATION_STRUCTURE_BUILD_BIT_KHR | VK_PIPELINE_STAGE_2_ACCELERATION_STRUCTURE_COPY_BIT_KHR |
	    VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT | VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_2_HOST_BIT;
	constexpr VkAccessFlags2 Raster = VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT |
	                                  VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT |
	                                  VK_ACCESS_2_INDEX_READ_BIT;
	return {Access.Stages & Stages, Access.Access & ~Raster};
}

VkShaderStageFlagBits StageOf(ERTShaderStage Stage)
{
	switch (Stage)
	{
	case ERTShaderStage::Vertex: return VK_SHADER_STAGE_VERTEX_BIT;
	case ERTShaderStage::Fragment: return VK_SHADER_STAGE_FRAGMENT_BIT;
	case ERTShaderStage::Compute: return VK_SHADER_STAGE_COMPUTE_BIT;
	case ERTShaderStage::RayGen: return VK_SHADER_STAGE_RAYGEN_BIT_KHR;
	case ERTShaderStage::Miss: return VK_SHADER_STAGE_MISS_BIT_KHR;
	case ERTShaderStage::ClosestHit: return VK_SHADER_STAGE_CLOSEST_HIT_BIT_KHR;
	case ERTShaderStage::AnyHit: return VK_SHADER_STAGE_ANY_HIT_BIT_KHR;
	case ERTShaderStage::Intersection: return VK_SHADER_STAGE_INTERSECTION_BIT_KHR;
	case ERTShaderStage::Callable: return VK_SHADER_STAGE_CALLABLE_BIT_KHR;
	}
	assert(false);
	return VK_SHADER_STAGE_COMPUTE_BIT;
}

VkShaderStageFlags AllStages(const FVulkanCapabilityBits& Bits)
{
	VkShaderStageFlags Stages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT | VK_SHADER_STAGE_COMPUTE_BIT;
	if (Bits.bPipeline)
	{
		Stages |= VK_SHADER_STAGE_RAYGEN_BIT_KHR | VK_SHADER_STAGE_MISS_BIT_KHR | VK_SHADER_STAGE_CLOSEST_HIT_BIT_KHR |
		          VK_SHADER_STAGE_ANY_HIT_BIT_KHR | VK_SHADER_STAGE_INTERSECTION_BIT_KHR | VK_SHADER_STAGE_CALLABLE_BIT_KHR;
	}
	return Stages;
}

} // namespace Lantern
