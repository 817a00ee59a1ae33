// Acceleration structures: geometries (BLAS) and scenes (TLAS).
#pragma once

#include "Resources/VulkanBuffer.h"

namespace Lantern
{

/// The native form of a build's sections. The address is 0 if a section names no buffer, as in size queries.
struct FVulkanSections
{
	std::vector<VkAccelerationStructureGeometryKHR> Geometries;
	std::vector<VkAccelerationStructureBuildRangeInfoKHR> Ranges;

	void Assign(const FRTGeometrySection* Sections, uint32_t Count);
};

/// Returns the sizes of a geometry as Desc has it. Desc.CompactedBytes is ignored.
FRTBuildSizes QueryGeometrySizes(FVulkanDevice& Device, const FRTGeometryDesc& Desc);

class FVulkanGeometry final : public TVulkanObject<IRTGeometry>
{
public:
	using TVulkanObject::TVulkanObject;
	FRTStatus Initialise(const FRTGeometryDesc& Desc);

	uint64_t GetDeviceAddress() const override { return Address; }
	FRTBuildSizes GetBuildSizes() const override { return Sizes; }
	uint32_t GetSectionCount() const override { return SectionCount; }
	uint64_t GetNative(ERTNative Kind) const override;

	VkAccelerationStructureKHR Handle = VK_NULL_HANDLE;
	VkBuildAccelerationStructureFlagsKHR Flags = 0;

private:
	~FVulkanGeometry() override;
	FVulkanBlock Block;
	VkDeviceAddress Address = 0;
	FRTBuildSizes Sizes;
	uint32_t SectionCount = 0;
};

class FVulkanScene final : public TVulkanObject<IRTScene>
{
public:
	using TVulkanObject::TVulkanObject;
	FRTStatus Initialise(const FRTSceneDesc& Desc);

	uint32_t GetIndex() const override { return Index; }
	uint32_t GetMaxInstances() const override { return MaxInstances; }
	FRTBuildSizes GetBuildSizes() const override { return Sizes; }
	uint64_t GetNative(ERTNative Kind) const override;

	/// Returns the one geometry of a TLAS. Instances may be 0 for size queries and empty builds.
	static VkAccelerationStructureGeometryKHR MakeInstances(VkDeviceAddress Instances);

	VkAccelerationStructureKHR Handle = VK_NULL_HANDLE;
	VkBuildAccelerationStructureFlagsKHR Flags = 0;

private:
	~FVulkanScene() override;
	FVulkanBlock Block;
	FRTBuildSizes Sizes;
	uint32_t MaxInstances = 0;
	uint32_t Index = NoBindlessIndex;
};

} // namespace Lantern
