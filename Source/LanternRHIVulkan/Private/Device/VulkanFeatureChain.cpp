// How an engine's extensions and feature structures join Lantern's, and which of them cannot.
#include "Device/VulkanFeatureChain.h"

#include <algorithm>
#include <cstring>
#include <vector>

#include "LanternRHI/RTText.h"

namespace Lantern
{

namespace
{

/// A structure that a later one of Vulkan's core contains. A chain must not have both (VkDeviceCreateInfo, "Valid Usage").
struct FPromoted
{
	VkStructureType Type;
	const char* Name;
	const char* Successor;
};

#define LANTERN_VK_PROMOTED(Type, Name, Successor)                                                                                         \
	{                                                                                                                                      \
		VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_##Type, "VkPhysicalDevice" Name, Successor                                                       \
	}
constexpr const char* Vulkan11 = "VkPhysicalDeviceVulkan11Features";
constexpr const char* Vulkan12 = "VkPhysicalDeviceVulkan12Features";
constexpr const char* Vulkan13 = "VkPhysicalDeviceVulkan13Features";
constexpr FPromoted PromotedStructures[] = {
    LANTERN_VK_PROMOTED(16BIT_STORAGE_FEATURES, "16BitStorageFeatures", Vulkan11),
    LANTERN_VK_PROMOTED(MULTIVIEW_FEATURES, "MultiviewFeatures", Vulkan11),
    LANTERN_VK_PROMOTED(VARIABLE_POINTERS_FEATURES, "VariablePointersFeatures", Vulkan11),
    LANTERN_VK_PROMOTED(PROTECTED_MEMORY_FEATURES, "ProtectedMemoryFeatures", Vulkan11),
    LANTERN_VK_PROMOTED(SAMPLER_YCBCR_CONVERSION_FEATURES, "SamplerYcbcrConversionFeatures", Vulkan11),
    LANTERN_VK_PROMOTED(SHADER_DRAW_PARAMETERS_FEATURES, "ShaderDrawParametersFeatures", Vulkan11),
    LANTERN_VK_PROMOTED(8BIT_STORAGE_FEATURES, "8BitStorageFeatures", Vulkan12),
    LANTERN_VK_PROMOTED(SHADER_ATOMIC_INT64_FEATURES, "ShaderAtomicInt64Features", Vulkan12),
    LANTERN_VK_PROMOTED(SHADER_FLOAT16_INT8_FEATURES, "ShaderFloat16Int8Features", Vulkan12),
    LANTERN_VK_PROMOTED(DESCRIPTOR_INDEXING_FEATURES, "DescriptorIndexingFeatures", Vulkan12),
    LANTERN_VK_PROMOTED(SCALAR_BLOCK_LAYOUT_FEATURES, "ScalarBlockLayoutFeatures", Vulkan12),
    LANTERN_VK_PROMOTED(IMAGELESS_FRAMEBUFFER_FEATURES, "ImagelessFramebufferFeatures", Vulkan12),
    LANTERN_VK_PROMOTED(UNIFORM_BUFFER_STANDARD_LAYOUT_FEATURES, "UniformBufferStandardLayoutFeatures", Vulkan12),
    LANTERN_VK_PROMOTED(SHADER_SUBGROUP_EXTENDED_TYPES_FEATURES, "ShaderSubgroupExtendedTypesFeatures", Vulkan12),
    LANTERN_VK_PROMOTED(SEPARATE_DEPTH_STENCIL_LAYOUTS_FEATURES, "SeparateDepthStencilLayoutsFeatures", Vulkan12),
    LANTERN_VK_PROMOTED(HOST_QUERY_RESET_FEATURES, "HostQueryResetFeatures", Vulkan12),
    LANTERN_VK_PROMOTED(TIMELINE_SEMAPHORE_FEATURES, "TimelineSemaphoreFeatures", Vulkan12),
    LANTERN_VK_PROMOTED(BUFFER_DEVICE_ADDRESS_FEATURES, "BufferDeviceAddressFeatures", Vulkan12),
    LANTERN_VK_PROMOTED(BUFFER_DEVICE_ADDRESS_FEATURES_EXT, "BufferDeviceAddressFeaturesEXT", Vulkan12),
    LANTERN_VK_PROMOTED(VULKAN_MEMORY_MODEL_FEATURES, "VulkanMemoryModelFeatures", Vulkan12),
    LANTERN_VK_PROMOTED(DYNAMIC_RENDERING_FEATURES, "DynamicRenderingFeatures", Vulkan13),
    LANTERN_VK_PROMOTED(IMAGE_ROBUSTNESS_FEATURES, "ImageRobustnessFeatures", Vulkan13),
    LANTERN_VK_PROMOTED(INLINE_UNIFORM_BLOCK_FEATURES, "InlineUniformBlockFeatures", Vulkan13),
    LANTERN_VK_PROMOTED(MAINTENANCE_4_FEATURES, "Maintenance4Features", Vulkan13),
    LANTERN_VK_PROMOTED(PIPELINE_CREATION_CACHE_CONTROL_FEATURES, "PipelineCreationCacheControlFeatures", Vulkan13),
    LANTERN_VK_PROMOTED(PRIVATE_DATA_FEATURES, "PrivateDataFeatures", Vulkan13),
    LANTERN_VK_PROMOTED(SHADER_DEMOTE_TO_HELPER_INVOCATION_FEATURES, "ShaderDemoteToHelperInvocationFeatures", Vulkan13),
    LANTERN_VK_PROMOTED(SHADER_INTEGER_DOT_PRODUCT_FEATURES, "ShaderIntegerDotProductFeatures", Vulkan13),
    LANTERN_VK_PROMOTED(SHADER_TERMINATE_INVOCATION_FEATURES, "ShaderTerminateInvocationFeatures", Vulkan13),
    LANTERN_VK_PROMOTED(SUBGROUP_SIZE_CONTROL_FEATURES, "SubgroupSizeControlFeatures", Vulkan13),
    LANTERN_VK_PROMOTED(SYNCHRONIZATION_2_FEATURES, "Synchronization2Features", Vulkan13),
    LANTERN_VK_PROMOTED(TEXTURE_COMPRESSION_ASTC_HDR_FEATURES, "TextureCompressionASTCHDRFeatures", Vulkan13),
    LANTERN_VK_PROMOTED(ZERO_INITIALIZE_WORKGROUP_MEMORY_FEATURES, "ZeroInitializeWorkgroupMemoryFeatures", Vulkan13),
};
#undef LANTERN_VK_PROMOTED

/// Its addresses are others than those of Vulkan 1.2, and a device has one kind.
constexpr const char* RefusedExtension = "VK_EXT_buffer_device_address";

/// A feature structure is sType, pNext, and VkBool32s up to its end.
template <class T>
void MergeBools(void* Into, const void* From)
{
	constexpr size_t First = sizeof(VkBaseOutStructure);
	static_assert((sizeof(T) - First) % sizeof(VkBool32) == 0);
	VkBool32* Dest = reinterpret_cast<VkBool32*>(static_cast<char*>(Into) + First);
	const VkBool32* Source = reinterpret_cast<const VkBool32*>(static_cast<const char*>(From) + First);
	// Padding at the end of an odd number of flags is merged too, which does no harm.
	for (size_t Index = 0; Index < (sizeof(T) - First) / sizeof(VkBool32); ++Index) { Dest[Index] |= Source[Index]; }
}

void MergeCore(VkPhysicalDeviceFeatures& Into, const VkPhysicalDeviceFeatures& From)
{
	VkBool32* Dest = reinterpret_cast<VkBool32*>(&Into);
	const VkBool32* Source = reinterpret_cast<const VkBool32*>(&From);
	for (size_t Index = 0; Index < sizeof(Into) / sizeof(VkBool32); ++Index) { Dest[Index] |= Source[Index]; }
}

void MergeStructure(VkBaseOutStructure* Into, const VkBaseOutStructure* From)
{
	switch (From->sType)
	{
	case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2: return MergeBools<VkPhysicalDeviceFeatures2>(Into, From);
	case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES: return MergeBools<VkPhysicalDeviceVulkan11Features>(Into, From);
	case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES: return MergeBools<VkPhysicalDeviceVulkan12Features>(Into, From);
	case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES: return MergeBools<VkPhysicalDeviceVulkan13Features>(Into, From);
	case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR:
		return MergeBools<VkPhysicalDeviceAccelerationStructureFeaturesKHR>(Into, From);
	case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_TRACING_PIPELINE_FEATURES_KHR:
		return MergeBools<VkPhysicalDeviceRayTracingPipelineFeaturesKHR>(Into, From);
	case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_OPACITY_MICROMAP_FEATURES_EXT:
		return MergeBools<VkPhysicalDeviceOpacityMicromapFeaturesEXT>(Into, From);
	default: return MergeBools<VkPhysicalDeviceRayQueryFeaturesKHR>(Into, From); // those of one flag
	}
}

VkBaseOutStructure* FindStructure(VkBaseOutStructure* Chain, VkStructureType Type)
{
	while (Chain && Chain->sType != Type) { Chain = Chain->pNext; }
	return Chain;
}

FRTStatus CheckExtensions(const FRTVulkanRequirementsDesc& Desc)
{
	if (Desc.ExtensionCount > 0 && Desc.Extensions == nullptr)
	{
		return FRTStatus::Error(
		    ERTResult::InvalidArgument, "FRTVulkanRequirementsDesc::Extensions is null, though ExtensionCount is %u", Desc.ExtensionCount);
	}
	for (uint32_t Index = 0; Index < Desc.ExtensionCount; ++Index)
	{
		if (Desc.Extensions[Index] == nullptr)
		{
			return FRTStatus::Error(ERTResult::InvalidArgument, "FRTVulkanRequirementsDesc::Extensions[%u] is null", Index);
		}
		if (strcmp(Desc.Extensions[Index], RefusedExtension) == 0)
		{
			return FRTStatus::Error(ERTResult::InvalidArgument,
			    "FRTVulkanRequirementsDesc::Extensions[%u] is %s, which excludes the bufferDeviceAddress of %s that Lantern needs", Index,
			    RefusedExtension, Vulkan12);
		}
	}
	return FRTStatus::Success();
}

} // namespace

FRTStatus CheckEngineLists(const FRTVulkanRequirementsDesc& Desc)
{
	if (const FRTStatus Status = CheckExtensions(Desc); !Status) { return Status; }
	std::vector<const VkBaseInStructure*> Seen;
	for (auto* Item = static_cast<const VkBaseInStructure*>(Desc.FeatureChain); Item != nullptr; Item = Item->pNext)
	{
		if (std::find(Seen.begin(), Seen.end(), Item) != Seen.end())
		{
			return FRTStatus::Error(ERTResult::InvalidArgument,
			    "FRTVulkanRequirementsDesc::FeatureChain has no end: its structure %zu of "
			    "sType %d comes again",
			    Seen.size() - 1, static_cast<int>(Item->sType));
		}
		Seen.push_back(Item);
		for (const FPromoted& Promoted : PromotedStructures)
		{
			if (Item->sType == Promoted.Type)
			{
				return FRTStatus::Error(ERTResult::InvalidArgument,
				    "FRTVulkanRequirementsDesc::FeatureChain has %s: Vulkan allows no chain with that and %s, which Lantern needs; set its "
				    "features there",
				    Promoted.Name, Promoted.Successor);
			}
		}
		if (Item->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2 && Desc.EnabledFeatures != nullptr)
		{
			return FRTStatus::Error(ERTResult::InvalidArgument, "FRTVulkanRequirementsDesc has EnabledFeatures, and "
			                                                    "VkPhysicalDeviceFeatures2 in FeatureChain: Vulkan allows one of them");
		}
	}
	return FRTStatus::Success();
}

void EnableFeaturesOfExtension(const char* Extension, FVulkanFeatures& Features)
{
	const struct
	{
		const char* Name;
		VkBool32* First;
		VkBool32* Second;
	} Demands[] = {
	    {VK_KHR_SHADER_DRAW_PARAMETERS_EXTENSION_NAME, &Features.Vulkan11.shaderDrawParameters, nullptr},
	    {VK_KHR_DRAW_INDIRECT_COUNT_EXTENSION_NAME, &Features.Vulkan12.drawIndirectCount, nullptr},
	    {VK_KHR_SAMPLER_MIRROR_CLAMP_TO_EDGE_EXTENSION_NAME, &Features.Vulkan12.samplerMirrorClampToEdge, nullptr},
	    {VK_EXT_DESCRIPTOR_INDEXING_EXTENSION_NAME, &Features.Vulkan12.descriptorIndexing, nullptr},
	    {VK_EXT_SAMPLER_FILTER_MINMAX_EXTENSION_NAME, &Features.Vulkan12.samplerFilterMinmax, nullptr},
	    {VK_EXT_SHADER_VIEWPORT_INDEX_LAYER_EXTENSION_NAME, &Features.Vulkan12.shaderOutputViewportIndex,
	        &Features.Vulkan12.shaderOutputLayer},
	};
	for (const auto& Demand : Demands)
	{
		if (strcmp(Extension, Demand.Name) != 0) { continue; }
		*Demand.First = VK_TRUE;
		if (Demand.Second != nullptr) { *Demand.Second = VK_TRUE; }
	}
}

const void* JoinFeatures(FVulkanFeatures& Ours, void* EngineChain, VkPhysicalDeviceFeatures* EngineFeatures)
{
	VkBaseOutStructure* Next = reinterpret_cast<VkBaseOutStructure*>(&Ours.Core);
	if (EngineFeatures != nullptr)
	{
		MergeCore(*EngineFeatures, Ours.Core.features);
		Next = Next->pNext;
	}
	VkBaseOutStructure* const Head = static_cast<VkBaseOutStructure*>(EngineChain);
	if (Head == nullptr) { return Next; }
	VkBaseOutStructure* Tail = Head;
	while (Tail->pNext) { Tail = Tail->pNext; }
	while (Next)
	{
		VkBaseOutStructure* const Item = Next;
		Next = Next->pNext;
		if (VkBaseOutStructure* const Theirs = FindStructure(Head, Item->sType)) { MergeStructure(Theirs, Item); }
		else
		{
			Item->pNext = nullptr;
			Tail->pNext = Item;
			Tail = Item;
		}
	}
	return Head;
}

} // namespace Lantern
