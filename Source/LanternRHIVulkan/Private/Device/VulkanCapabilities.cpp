// Probes a physical device: capabilities, features and extensions to enable, and what is missing.
#include "Device/VulkanCapabilities.h"

#include "Device/VulkanQuirks.h"

#include <algorithm>
#include <cstring>

#include "LanternRHI/RTText.h"

namespace Lantern
{

namespace
{

constexpr uint32_t WantedTextures = 65536;
constexpr uint32_t WantedSamplers = 1024;
constexpr uint32_t WantedScenes = 4096;
/// Room that the layer of limits "per stage resources" must leave beside our own arrays.
constexpr uint32_t OtherResources = 64;

bool Contains(const std::vector<const char*>& List, const char* Name)
{
	return std::any_of(List.begin(), List.end(), [&](const char* Item) { return strcmp(Item, Name) == 0; });
}

struct FSupported
{
	std::vector<VkExtensionProperties> Extensions;
	FVulkanFeatures Features;
	VkPhysicalDeviceProperties2 Core{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
	VkPhysicalDeviceVulkan12Properties Vulkan12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_PROPERTIES};
	VkPhysicalDeviceMaintenance4Properties Maintenance4{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_PROPERTIES};
	VkPhysicalDeviceAccelerationStructurePropertiesKHR Accel{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_PROPERTIES_KHR};
	VkPhysicalDeviceRayTracingPipelinePropertiesKHR Pipeline{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_TRACING_PIPELINE_PROPERTIES_KHR};

	bool Has(const char* Name) const
	{
		return std::any_of(
		    Extensions.begin(), Extensions.end(), [&](const VkExtensionProperties& Item) { return strcmp(Item.extensionName, Name) == 0; });
	}
};

void QuerySupported(const FVulkanInstanceApi& Api, VkPhysicalDevice Physical, FSupported& Out)
{
	uint32_t Count = 0;
	Api.EnumerateDeviceExtensionProperties(Physical, nullptr, &Count, nullptr);
	Out.Extensions.resize(Count);
	Api.EnumerateDeviceExtensionProperties(Physical, nullptr, &Count, Out.Extensions.data());
	Out.Extensions.resize(Count);

	std::vector<const char*> Names;
	for (const VkExtensionProperties& Item : Out.Extensions) { Names.push_back(Item.extensionName); }
	Out.Features.Link(Names);
	Api.GetPhysicalDeviceFeatures2(Physical, &Out.Features.Core);

	Out.Core.pNext = &Out.Vulkan12;
	Out.Vulkan12.pNext = &Out.Maintenance4;
	void** Tail = &Out.Maintenance4.pNext;
	if (Out.Has(VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME))
	{
		*Tail = &Out.Accel;
		Tail = &Out.Accel.pNext;
	}
	if (Out.Has(VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME)) { *Tail = &Out.Pipeline; }
	Api.GetPhysicalDeviceProperties2(Physical, &Out.Core);
}

/// Copies a feature that every device must have from Supported to the enabled set, or notes its absence.
#define LANTERN_VK_NEED(Structure, Feature)                                                                                                \
	Out.Features.Structure.Feature = Supported.Features.Structure.Feature;                                                                 \
	if (!Supported.Features.Structure.Feature)                                                                                             \
	{                                                                                                                                      \
		bAll = false;                                                                                                                      \
		Out.Missing += "feature " #Feature ": nothing runs without it\n";                                                                  \
	}
#define LANTERN_VK_WANT(Structure, Feature) Out.Features.Structure.Feature = Supported.Features.Structure.Feature;

bool EnableBaseline(const FSupported& Supported, FVulkanProbe& Out)
{
	bool bAll = true;
	LANTERN_VK_NEED(Core.features, shaderInt64)
	LANTERN_VK_NEED(Core.features, shaderStorageImageReadWithoutFormat)
	LANTERN_VK_NEED(Core.features, shaderStorageImageWriteWithoutFormat)
	LANTERN_VK_NEED(Vulkan12, timelineSemaphore)
	LANTERN_VK_NEED(Vulkan12, bufferDeviceAddress)
	LANTERN_VK_NEED(Vulkan12, hostQueryReset)
	LANTERN_VK_NEED(Vulkan12, scalarBlockLayout)
	LANTERN_VK_NEED(Vulkan12, runtimeDescriptorArray)
	LANTERN_VK_NEED(Vulkan12, descriptorBindingPartiallyBound)
	LANTERN_VK_NEED(Vulkan12, descriptorBindingUpdateUnusedWhilePending)
	LANTERN_VK_NEED(Vulkan12, descriptorBindingSampledImageUpdateAfterBind)
	LANTERN_VK_NEED(Vulkan12, descriptorBindingStorageImageUpdateAfterBind)
	LANTERN_VK_NEED(Vulkan12, shaderSampledImageArrayNonUniformIndexing)
	LANTERN_VK_NEED(Vulkan12, shaderStorageImageArrayNonUniformIndexing)
	LANTERN_VK_NEED(Vulkan13, synchronization2)
	LANTERN_VK_NEED(Vulkan13, dynamicRendering)
	LANTERN_VK_NEED(Vulkan13, maintenance4)

	LANTERN_VK_WANT(Core.features, samplerAnisotropy)
	LANTERN_VK_WANT(Core.features, shaderInt16)
	LANTERN_VK_WANT(Core.features, shaderImageGatherExtended)
	LANTERN_VK_WANT(Core.features, shaderStorageImageExtendedFormats)
	LANTERN_VK_WANT(Core.features, fragmentStoresAndAtomics)
	LANTERN_VK_WANT(Core.features, vertexPipelineStoresAndAtomics)
	LANTERN_VK_WANT(Core.features, independentBlend)
	LANTERN_VK_WANT(Vulkan11, storageBuffer16BitAccess)
	LANTERN_VK_WANT(Vulkan12, storageBuffer8BitAccess)
	LANTERN_VK_WANT(Vulkan12, shaderFloat16)
	LANTERN_VK_WANT(Vulkan12, shaderInt8)
	LANTERN_VK_WANT(Vulkan12, shaderBufferInt64Atomics)
	LANTERN_VK_WANT(Vulkan12, vulkanMemoryModel)
	LANTERN_VK_WANT(Vulkan12, vulkanMemoryModelDeviceScope)
	LANTERN_VK_WANT(Vulkan13, shaderDemoteToHelperInvocation)
	LANTERN_VK_WANT(Vulkan13, shaderTerminateInvocation)
	LANTERN_VK_WANT(Vulkan13, shaderZeroInitializeWorkgroupMemory)
	return bAll;
}

#undef LANTERN_VK_NEED
#undef LANTERN_VK_WANT

/// Finds what the driver has, before the caller's wishes. Fills the lines of Missing.
struct FLadder
{
	bool bAccel = false, bQuery = false, bPipeline = false, bReorder = false, bMicromap = false;
};

FLadder FindLadder(const FSupported& Supported, std::string& Missing)
{
	const FVulkanFeatures& Features = Supported.Features;
	FLadder Ladder;
	Ladder.bAccel = Supported.Has(VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME) &&
	                Supported.Has(VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME) && Features.Accel.accelerationStructure &&
	                Features.Accel.descriptorBindingAccelerationStructureUpdateAfterBind;
	Ladder.bQuery = Ladder.bAccel && Supported.Has(VK_KHR_RAY_QUERY_EXTENSION_NAME) && Features.Query.rayQuery;
	Ladder.bPipeline = Ladder.bAccel && Supported.Has(VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME) && Features.Pipeline.rayTracingPipeline;
	Ladder.bReorder = Ladder.bPipeline && Supported.Has(VK_NV_RAY_TRACING_INVOCATION_REORDER_EXTENSION_NAME) &&
	                  Features.Reorder.rayTracingInvocationReorder;
	Ladder.bMicromap = Ladder.bPipeline && Supported.Has(VK_EXT_OPACITY_MICROMAP_EXTENSION_NAME) && Features.Micromap.micromap;
	if (!Ladder.bAccel)
	{
		Missing += "VK_KHR_acceleration_structure (with bindless descriptors): no ray-traced feature runs\n";
		return Ladder;
	}
	if (!Ladder.bQuery) { Missing += "VK_KHR_ray_query: no inline rays; rays need pipelines\n"; }
	if (!Ladder.bPipeline) { Missing += "VK_KHR_ray_tracing_pipeline: no hit groups, so no reference path tracer and no RTPSO\n"; }
	if (!Ladder.bReorder) { Missing += "VK_NV_ray_tracing_invocation_reorder: divergent hit shading is slower\n"; }
	if (!Ladder.bMicromap) { Missing += "VK_EXT_opacity_micromap: alpha tests run in any-hit shaders\n"; }
	return Ladder;
}

/// A rung includes those below it: what the caller hides is cut from the top.
void ApplyWishes(const FVulkanProbeDesc& Desc, FLadder& Ladder)
{
	Ladder.bQuery &= !Desc.bDisableRayQuery && Desc.MaxRung >= ERTRung::RayQuery;
	Ladder.bPipeline &= !Desc.bDisablePipeline && Desc.MaxRung >= ERTRung::Pipeline;
	Ladder.bReorder &= Ladder.bPipeline && Desc.MaxRung >= ERTRung::Reorder;
	Ladder.bMicromap &= Ladder.bPipeline && Desc.MaxRung >= ERTRung::Micromap;
	Ladder.bAccel = Ladder.bQuery || Ladder.bPipeline;
}

ERTRung RungOf(const FLadder& Ladder)
{
	if (!Ladder.bPipeline) { return Ladder.bQuery ? ERTRung::RayQuery : ERTRung::None; }
	if (!Ladder.bReorder) { return ERTRung::Pipeline; }
	return Ladder.bMicromap ? ERTRung::Micromap : ERTRung::Reorder;
}

void EnablePipelines(const FSupported& Supported, FVulkanProbe& Out)
{
	FVulkanFeatures& Features = Out.Features;
	FRTCapabilities& Caps = Out.Capabilities;
	Out.Extensions.push_back(VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME);
	Features.Pipeline.rayTracingPipeline = VK_TRUE;
	Features.Pipeline.rayTracingPipelineTraceRaysIndirect = Supported.Features.Pipeline.rayTracingPipelineTraceRaysIndirect;
	Features.Pipeline.rayTraversalPrimitiveCulling = Supported.Features.Pipeline.rayTraversalPrimitiveCulling;
	Caps.bIndirectTrace = Features.Pipeline.rayTracingPipelineTraceRaysIndirect;
	Caps.bPipelineLibraries = Supported.Has(VK_KHR_PIPELINE_LIBRARY_EXTENSION_NAME);
	if (Caps.bPipelineLibraries) { Out.Extensions.push_back(VK_KHR_PIPELINE_LIBRARY_EXTENSION_NAME); }
}

void EnableLadder(const FSupported& Supported, const FLadder& Ladder, FVulkanProbe& Out)
{
	FVulkanFeatures& Features = Out.Features;
	FRTCapabilities& Caps = Out.Capabilities;
	Caps.Rung = RungOf(Ladder);
	Caps.bRayQuery = Ladder.bQuery;
	Caps.bRayTracingPipeline = Ladder.bPipeline;
	Caps.bReorder = Ladder.bReorder;
	Caps.bMicromap = Ladder.bMicromap;
	Out.bAccel = Ladder.bAccel;
	if (!Ladder.bAccel) { return; }
	Out.Extensions.push_back(VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME);
	Out.Extensions.push_back(VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME);
	Features.Accel.accelerationStructure = VK_TRUE;
	Features.Accel.descriptorBindingAccelerationStructureUpdateAfterBind = VK_TRUE;
	Caps.bDeferredOperations = true;
	if (Supported.Has(VK_KHR_RAY_TRACING_MAINTENANCE_1_EXTENSION_NAME) && Supported.Features.Maintenance1.rayTracingMaintenance1)
	{
		Out.Extensions.push_back(VK_KHR_RAY_TRACING_MAINTENANCE_1_EXTENSION_NAME);
		Features.Maintenance1.rayTracingMaintenance1 = VK_TRUE;
		Out.bMaintenance1 = true;
	}
#ifdef VK_KHR_ray_tracing_position_fetch
	if (Supported.Has(VK_KHR_RAY_TRACING_POSITION_FETCH_EXTENSION_NAME) && Supported.Features.PositionFetch.rayTracingPositionFetch)
	{
		Out.Extensions.push_back(VK_KHR_RAY_TRACING_POSITION_FETCH_EXTENSION_NAME);
		Features.PositionFetch.rayTracingPositionFetch = VK_TRUE;
		Caps.bPositionFetch = true;
	}
#endif
	if (Ladder.bQuery)
	{
		Out.Extensions.push_back(VK_KHR_RAY_QUERY_EXTENSION_NAME);
		Features.Query.rayQuery = VK_TRUE;
	}
	if (Ladder.bPipeline) { EnablePipelines(Supported, Out); }
	if (Ladder.bReorder)
	{
		Out.Extensions.push_back(VK_NV_RAY_TRACING_INVOCATION_REORDER_EXTENSION_NAME);
		Features.Reorder.rayTracingInvocationReorder = VK_TRUE;
	}
	if (Ladder.bMicromap)
	{
		Out.Extensions.push_back(VK_EXT_OPACITY_MICROMAP_EXTENSION_NAME);
		Features.Micromap.micromap = VK_TRUE;
	}
}

void FillRayTracingLimits(const FSupported& Supported, FVulkanProbe& Out)
{
	FRTCapabilities& Caps = Out.Capabilities;
	if (Out.bAccel)
	{
		Caps.ScratchAlignment = std::max(Supported.Accel.minAccelerationStructureScratchOffsetAlignment, 1u);
		Caps.MaxInstanceCount = Supported.Accel.maxInstanceCount;
		Caps.MaxPrimitiveCount = Supported.Accel.maxPrimitiveCount;
		Out.MaxBindlessScenes = std::min({WantedScenes, Supported.Accel.maxPerStageDescriptorUpdateAfterBindAccelerationStructures,
		    Supported.Accel.maxDescriptorSetUpdateAfterBindAccelerationStructures});
	}
	if (Caps.bRayTracingPipeline)
	{
		Caps.ShaderGroupHandleSize = Supported.Pipeline.shaderGroupHandleSize;
		Caps.ShaderGroupHandleAlignment = Supported.Pipeline.shaderGroupHandleAlignment;
		Caps.ShaderGroupBaseAlignment = Supported.Pipeline.shaderGroupBaseAlignment;
		Caps.MaxShaderGroupStride = Supported.Pipeline.maxShaderGroupStride;
		Caps.MaxRayRecursionDepth = Supported.Pipeline.maxRayRecursionDepth;
	}
}

void FillLimits(const FSupported& Supported, FVulkanProbe& Out)
{
	FRTCapabilities& Caps = Out.Capabilities;
	const VkPhysicalDeviceVulkan12Properties& Limits = Supported.Vulkan12;
	Caps.MaxTextureDimension = Supported.Core.properties.limits.maxImageDimension2D;
	Out.MaxBufferBytes = Supported.Maintenance4.maxBufferSize;
	Caps.TimestampPeriodNs = Supported.Core.properties.limits.timestampPeriod;
	Out.bAnisotropy = Supported.Features.Core.features.samplerAnisotropy;
	Out.MaxAnisotropy = Out.bAnisotropy ? Supported.Core.properties.limits.maxSamplerAnisotropy : 1.0f;
	FillRayTracingLimits(Supported, Out);

	Out.MaxBindlessSamplers =
	    std::min({WantedSamplers, Limits.maxPerStageDescriptorUpdateAfterBindSamplers, Limits.maxDescriptorSetUpdateAfterBindSamplers});
	uint32_t PerStage = Limits.maxPerStageUpdateAfterBindResources;
	const uint32_t Others = Out.MaxBindlessSamplers + Out.MaxBindlessScenes + OtherResources;
	PerStage = PerStage > Others ? (PerStage - Others) / 2 : 0;
	Caps.MaxBindlessTextures = std::min({WantedTextures, PerStage, Limits.maxPerStageDescriptorUpdateAfterBindSampledImages,
	    Limits.maxPerStageDescriptorUpdateAfterBindStorageImages, Limits.maxDescriptorSetUpdateAfterBindSampledImages,
	    Limits.maxDescriptorSetUpdateAfterBindStorageImages});
}

void FillQueueAndMemory(const FVulkanInstanceApi& Api, VkPhysicalDevice Physical, FVulkanProbe& Out)
{
	uint32_t Count = 0;
	Api.GetPhysicalDeviceQueueFamilyProperties(Physical, &Count, nullptr);
	std::vector<VkQueueFamilyProperties> Families(Count);
	Api.GetPhysicalDeviceQueueFamilyProperties(Physical, &Count, Families.data());
	constexpr VkQueueFlags Wanted = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
	for (uint32_t Index = 0; Index < Count && Out.QueueFamily == FVulkanProbe::NoQueueFamily; ++Index)
	{
		if ((Families[Index].queueFlags & Wanted) == Wanted)
		{
			Out.QueueFamily = Index;
			Out.Capabilities.bTimestamps = Families[Index].timestampValidBits > 0;
		}
	}
	for (uint32_t Index = 0; Index < Count && Out.TransferFamily == FVulkanProbe::NoQueueFamily; ++Index)
	{
		const VkQueueFlags Flags = Families[Index].queueFlags & (Wanted | VK_QUEUE_TRANSFER_BIT);
		if (Flags == VK_QUEUE_TRANSFER_BIT) { Out.TransferFamily = Index; }
	}
	for (uint32_t Index = 0; Index < Count && Out.ComputeFamily == FVulkanProbe::NoQueueFamily; ++Index)
	{
		if ((Families[Index].queueFlags & Wanted) == VK_QUEUE_COMPUTE_BIT) { Out.ComputeFamily = Index; }
	}
	const bool bSecond = Out.QueueFamily != FVulkanProbe::NoQueueFamily && Families[Out.QueueFamily].queueCount > 1;
	if (Out.ComputeFamily == FVulkanProbe::NoQueueFamily && bSecond) { Out.ComputeFamily = Out.QueueFamily; }
	VkPhysicalDeviceMemoryProperties Memory{};
	Api.GetPhysicalDeviceMemoryProperties(Physical, &Memory);
	for (uint32_t Heap = 0; Heap < Memory.memoryHeapCount; ++Heap)
	{
		if (Memory.memoryHeaps[Heap].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT)
		{
			Out.Capabilities.DeviceMemoryBytes += Memory.memoryHeaps[Heap].size;
		}
	}
}

void FillNames(const FSupported& Supported, FVulkanProbe& Out)
{
	const VkPhysicalDeviceProperties& Core = Supported.Core.properties;
	const VkPhysicalDeviceVulkan12Properties& Driver = Supported.Vulkan12;
	// Escaped here: they go into messages, reports and tables everywhere.
	snprintf(Out.Capabilities.DeviceName, sizeof(Out.Capabilities.DeviceName), "%s", FRTShown(Core.deviceName).Text);
	snprintf(Out.Capabilities.DriverName, sizeof(Out.Capabilities.DriverName), "%s %s", FRTShown(Driver.driverName).Text,
	    FRTShown(Driver.driverInfo).Text);
	Out.Capabilities.bIsCpu = Core.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
	Out.Type = Core.deviceType;
	Out.VendorId = Core.vendorID;
	Out.DeviceId = Core.deviceID;
	Out.DriverVersion = Core.driverVersion;
	memcpy(Out.PipelineCacheUuid, Core.pipelineCacheUUID, VK_UUID_SIZE);
	char Text[1024];
	Out.Quirks = FindQuirks(Driver.driverID, Core.driverVersion, Text, sizeof(Text));
	Out.QuirkText = Text;
}

} // namespace

void FVulkanFeatures::Link(const std::vector<const char*>& Extensions)
{
	Core.pNext = &Vulkan11;
	Vulkan11.pNext = &Vulkan12;
	Vulkan12.pNext = &Vulkan13;
	void** Tail = &Vulkan13.pNext;
	*Tail = nullptr;
	const auto Add = [&](const char* Extension, auto& Structure) {
		Structure.pNext = nullptr;
		if (Contains(Extensions, Extension))
		{
			*Tail = &Structure;
			Tail = &Structure.pNext;
		}
	};
	Add(VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME, Accel);
	Add(VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME, Pipeline);
	Add(VK_KHR_RAY_QUERY_EXTENSION_NAME, Query);
	Add(VK_KHR_RAY_TRACING_MAINTENANCE_1_EXTENSION_NAME, Maintenance1);
	Add(VK_NV_RAY_TRACING_INVOCATION_REORDER_EXTENSION_NAME, Reorder);
	Add(VK_EXT_OPACITY_MICROMAP_EXTENSION_NAME, Micromap);
#ifdef VK_KHR_ray_tracing_position_fetch
	Add(VK_KHR_RAY_TRACING_POSITION_FETCH_EXTENSION_NAME, PositionFetch);
#endif
}

void ProbeVulkanDevice(const FVulkanInstanceApi& Api, VkPhysicalDevice Physical, const FVulkanProbeDesc& Desc, FVulkanProbe* Out)
{
	*Out = {};
	VkPhysicalDeviceProperties Properties{};
	Api.GetPhysicalDeviceProperties(Physical, &Properties);
	Out->ApiVersion = Properties.apiVersion;
	if (Properties.apiVersion < VK_API_VERSION_1_3)
	{
		// Such a device must not be asked for structures of 1.2 and 1.3.
		snprintf(Out->Capabilities.DeviceName, sizeof(Out->Capabilities.DeviceName), "%s", FRTShown(Properties.deviceName).Text);
		Out->Type = Properties.deviceType;
		Out->Capabilities.bIsCpu = Properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
		Out->Missing = "Vulkan 1.3: nothing runs without it\n";
		return;
	}
	FSupported Supported;
	QuerySupported(Api, Physical, Supported);
	FillNames(Supported, *Out);
	const bool bBaseline = EnableBaseline(Supported, *Out);
	FLadder Ladder = FindLadder(Supported, Out->Missing);
	ApplyWishes(Desc, Ladder);
	EnableLadder(Supported, Ladder, *Out);
	FillLimits(Supported, *Out);
	FillQueueAndMemory(Api, Physical, *Out);
	if (Out->QueueFamily == FVulkanProbe::NoQueueFamily) { Out->Missing += "a queue for graphics and compute: nothing runs without it\n"; }
	Out->Capabilities.bLibraryOnlyPipelines =
	    Out->Capabilities.bPipelineLibraries && !HasQuirk(Out->Quirks, EVulkanQuirk::LinkedPushConstantsLost);
	Out->bUsable = bBaseline && Out->QueueFamily != FVulkanProbe::NoQueueFamily;
	Out->Features.Link(Out->Extensions);
}

} // namespace Lantern
