// FVulkanGeometry and FVulkanScene: sizes, storage and creation of acceleration structures.
#include "Resources/VulkanAccel.h"

#include <cassert>

#include "LanternRHI/RTText.h"

namespace Lantern
{

namespace
{

VkIndexType IndexTypeOf(ERTIndexType Type)
{
	switch (Type)
	{
	case ERTIndexType::None: return VK_INDEX_TYPE_NONE_KHR;
	case ERTIndexType::UInt16: return VK_INDEX_TYPE_UINT16;
	case ERTIndexType::UInt32: return VK_INDEX_TYPE_UINT32;
	}
	return VK_INDEX_TYPE_NONE_KHR;
}

VkFormat FormatOf(ERTVertexFormat Format)
{
	switch (Format)
	{
	case ERTVertexFormat::Float3: return VK_FORMAT_R32G32B32_SFLOAT;
	case ERTVertexFormat::Half4: return VK_FORMAT_R16G16B16A16_SFLOAT;
	case ERTVertexFormat::Snorm16x4: return VK_FORMAT_R16G16B16A16_SNORM;
	}
	return VK_FORMAT_UNDEFINED;
}

VkDeviceAddress AddressIn(IRTBuffer* Buffer, uint64_t Offset) { return Buffer ? Buffer->GetDeviceAddress() + Offset : 0; }

VkAccelerationStructureGeometryKHR MakeGeometry(const FRTGeometrySection& Section)
{
	VkAccelerationStructureGeometryKHR Geometry{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR};
	// Any-hit shaders add up what surfaces let through: a second call for one triangle would count it twice.
	Geometry.flags = Section.bOpaque ? VK_GEOMETRY_OPAQUE_BIT_KHR : VK_GEOMETRY_NO_DUPLICATE_ANY_HIT_INVOCATION_BIT_KHR;
	if (Section.bProcedural)
	{
		Geometry.geometryType = VK_GEOMETRY_TYPE_AABBS_KHR;
		auto& Boxes = Geometry.geometry.aabbs;
		Boxes = {VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_AABBS_DATA_KHR};
		Boxes.data.deviceAddress = AddressIn(Section.Vertices, Section.VertexOffset);
		Boxes.stride = Section.VertexStride;
		return Geometry;
	}
	Geometry.geometryType = VK_GEOMETRY_TYPE_TRIANGLES_KHR;
	auto& Triangles = Geometry.geometry.triangles;
	Triangles = {VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_TRIANGLES_DATA_KHR};
	Triangles.vertexFormat = FormatOf(Section.VertexFormat);
	Triangles.vertexData.deviceAddress = AddressIn(Section.Vertices, Section.VertexOffset);
	Triangles.vertexStride = Section.VertexStride;
	Triangles.maxVertex = Section.VertexCount - 1;
	Triangles.indexType = IndexTypeOf(Section.IndexType);
	Triangles.indexData.deviceAddress = Section.IndexType == ERTIndexType::None ? 0 : AddressIn(Section.Indices, Section.IndexOffset);
	return Geometry;
}

/// Creates the structure that Info's sizes ask for, in a block of its own.
FRTStatus CreateStructure(FVulkanDevice& Device, VkAccelerationStructureTypeKHR Type, uint64_t Size, EVulkanMemoryKind Kind,
    const char* Name, FVulkanBlock& Block, VkAccelerationStructureKHR* Out)
{
	FRTStatus Status =
	    Block.Create(Device, Size, VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR, ERTMemory::Device, 256, Kind, Name);
	if (!Status) { return Status; }
	VkAccelerationStructureCreateInfoKHR Info{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_CREATE_INFO_KHR};
	Info.buffer = Block.Handle;
	Info.size = Size;
	Info.type = Type;
	const VkResult Result = Device.Check(Device.Api.CreateAccelerationStructureKHR(Device.Handle, &Info, nullptr, Out));
	if (Result != VK_SUCCESS)
	{
		*Out = VK_NULL_HANDLE;
		return MakeStatus(Result, "Creating acceleration structure", Name);
	}
	Device.SetName(VK_OBJECT_TYPE_ACCELERATION_STRUCTURE_KHR, ToNative(*Out), Name);
	return {};
}

FRTBuildSizes QuerySizes(FVulkanDevice& Device, const VkAccelerationStructureBuildGeometryInfoKHR& Info, const uint32_t* PrimitiveCounts)
{
	VkAccelerationStructureBuildSizesInfoKHR Native{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_SIZES_INFO_KHR};
	Device.Api.GetAccelerationStructureBuildSizesKHR(
	    Device.Handle, VK_ACCELERATION_STRUCTURE_BUILD_TYPE_DEVICE_KHR, &Info, PrimitiveCounts, &Native);
	FRTBuildSizes Sizes;
	Sizes.StructureBytes = Native.accelerationStructureSize;
	Sizes.BuildScratchBytes = Native.buildScratchSize;
	const bool bUpdate = Info.flags & VK_BUILD_ACCELERATION_STRUCTURE_ALLOW_UPDATE_BIT_KHR;
	Sizes.UpdateScratchBytes = bUpdate ? Native.updateScratchSize : 0;
	return Sizes;
}

FRTStatus NoRayTracing(const char* Name)
{
	return FRTStatus::Error(ERTResult::Unsupported, "'%s': the device has no acceleration structures", FRTShown(Name).Text);
}

uint64_t CountPrimitives(const FRTGeometryDesc& Desc)
{
	uint64_t Total = 0;
	for (uint32_t Index = 0; Index < Desc.SectionCount; ++Index)
	{
		Total += Desc.Sections[Index].bProcedural ? Desc.Sections[Index].VertexCount : Desc.Sections[Index].TriangleCount;
	}
	return Total;
}

VkBuildAccelerationStructureFlagsKHR FlagsOf(const FRTGeometryDesc& Desc)
{
	VkBuildAccelerationStructureFlagsKHR Flags = Desc.bFastBuild ? VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_BUILD_BIT_KHR
	                                                             : VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_TRACE_BIT_KHR;
	Flags |= Desc.bAllowUpdate ? VK_BUILD_ACCELERATION_STRUCTURE_ALLOW_UPDATE_BIT_KHR : 0;
	Flags |= Desc.bAllowCompaction ? VK_BUILD_ACCELERATION_STRUCTURE_ALLOW_COMPACTION_BIT_KHR : 0;
	return Flags;
}

} // namespace

void FVulkanSections::Assign(const FRTGeometrySection* Sections, uint32_t Count)
{
	Geometries.resize(Count);
	Ranges.resize(Count);
	for (uint32_t Index = 0; Index < Count; ++Index)
	{
		Geometries[Index] = MakeGeometry(Sections[Index]);
		// The addresses have the offsets in them.
		Ranges[Index] = {};
		Ranges[Index].primitiveCount = Sections[Index].bProcedural ? Sections[Index].VertexCount : Sections[Index].TriangleCount;
	}
}

FRTBuildSizes QueryGeometrySizes(FVulkanDevice& Device, const FRTGeometryDesc& Desc)
{
	if (CountPrimitives(Desc) > Device.GetCapabilities().MaxPrimitiveCount) { return {}; } // CreateGeometry says so
	FVulkanSections Sections;
	Sections.Assign(Desc.Sections, Desc.SectionCount);
	std::vector<uint32_t> Counts;
	for (const VkAccelerationStructureBuildRangeInfoKHR& Range : Sections.Ranges) { Counts.push_back(Range.primitiveCount); }
	VkAccelerationStructureBuildGeometryInfoKHR Info{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_GEOMETRY_INFO_KHR};
	Info.type = VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR;
	Info.flags = FlagsOf(Desc);
	Info.geometryCount = Desc.SectionCount;
	Info.pGeometries = Sections.Geometries.data();
	return QuerySizes(Device, Info, Counts.data());
}

FRTStatus FVulkanGeometry::Initialise(const FRTGeometryDesc& Desc)
{
	if (!Device.Bits.bAccel) { return NoRayTracing(Desc.Name); }
	assert(Desc.SectionCount > 0);
	SectionCount = Desc.SectionCount;
	Flags = FlagsOf(Desc);
	const uint64_t Total = CountPrimitives(Desc);
	if (Total > Device.GetCapabilities().MaxPrimitiveCount)
	{
		return FRTStatus::Error(ERTResult::Unsupported, "Geometry '%s' has %llu primitives; the limit is %llu", FRTShown(Desc.Name).Text,
		    static_cast<unsigned long long>(Total), static_cast<unsigned long long>(Device.GetCapabilities().MaxPrimitiveCount));
	}
	Sizes = QueryGeometrySizes(Device, Desc);
	if (Desc.CompactedBytes > 0) { Sizes.StructureBytes = Desc.CompactedBytes; }
	FRTStatus Status = CreateStructure(Device, VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR, Sizes.StructureBytes,
	    EVulkanMemoryKind::Geometry, Desc.Name, Block, &Handle);
	if (!Status) { return Status; }
	VkAccelerationStructureDeviceAddressInfoKHR AddressInfo{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_DEVICE_ADDRESS_INFO_KHR};
	AddressInfo.accelerationStructure = Handle;
	Address = Device.Api.GetAccelerationStructureDeviceAddressKHR(Device.Handle, &AddressInfo);
	return {};
}

FVulkanGeometry::~FVulkanGeometry()
{
	if (Handle) { Device.Api.DestroyAccelerationStructureKHR(Device.Handle, Handle, nullptr); }
}

uint64_t FVulkanGeometry::GetNative(ERTNative Kind) const
{
	switch (Kind)
	{
	case ERTNative::AccelerationStructure: return ToNative(Handle);
	case ERTNative::Buffer: return ToNative(Block.Handle);
	default: return 0;
	}
}

VkAccelerationStructureGeometryKHR FVulkanScene::MakeInstances(VkDeviceAddress Instances)
{
	VkAccelerationStructureGeometryKHR Geometry{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR};
	Geometry.geometryType = VK_GEOMETRY_TYPE_INSTANCES_KHR;
	Geometry.geometry.instances = {VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_INSTANCES_DATA_KHR};
	Geometry.geometry.instances.data.deviceAddress = Instances;
	return Geometry;
}

FRTStatus FVulkanScene::Initialise(const FRTSceneDesc& Desc)
{
	if (!Device.Bits.bAccel) { return NoRayTracing(Desc.Name); }
	MaxInstances = Desc.MaxInstances;
	if (MaxInstances > Device.GetCapabilities().MaxInstanceCount)
	{
		return FRTStatus::Error(ERTResult::Unsupported, "Scene '%s' of %u instances; the device's limit is %llu", FRTShown(Desc.Name).Text,
		    MaxInstances, static_cast<unsigned long long>(Device.GetCapabilities().MaxInstanceCount));
	}
	Flags = Desc.bFastBuild ? VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_BUILD_BIT_KHR
	                        : VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_TRACE_BIT_KHR;
	const VkAccelerationStructureGeometryKHR Geometry = MakeInstances(0);
	VkAccelerationStructureBuildGeometryInfoKHR Info{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_GEOMETRY_INFO_KHR};
	Info.type = VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR;
	Info.flags = Flags;
	Info.geometryCount = 1;
	Info.pGeometries = &Geometry;
	Sizes = QuerySizes(Device, Info, &MaxInstances);
	FRTStatus Status = CreateStructure(Device, Info.type, Sizes.StructureBytes, EVulkanMemoryKind::Scene, Desc.Name, Block, &Handle);
	if (!Status) { return Status; }
	Index = Device.Bindless.AddScene(Handle);
	if (Index == NoBindlessIndex)
	{
		return FRTStatus::Error(
		    ERTResult::OutOfDescriptors, "Scene '%s': all %u indices are in use", FRTShown(Desc.Name).Text, Device.Probe.MaxBindlessScenes);
	}
	return {};
}

FVulkanScene::~FVulkanScene()
{
	Device.Bindless.Remove(FVulkanBindless::Scene, Index);
	if (Handle) { Device.Api.DestroyAccelerationStructureKHR(Device.Handle, Handle, nullptr); }
}

uint64_t FVulkanScene::GetNative(ERTNative Kind) const
{
	switch (Kind)
	{
	case ERTNative::AccelerationStructure: return ToNative(Handle);
	case ERTNative::Buffer: return ToNative(Block.Handle);
	default: return 0;
	}
}

} // namespace Lantern
