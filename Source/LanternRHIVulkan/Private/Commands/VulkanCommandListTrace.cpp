// FVulkanCommandList: rays, shader tables and acceleration structures.
#include "Commands/VulkanCommandList.h"

#include <cassert>

namespace Lantern
{

void FVulkanCommandList::UpdateShaderTable(IRTShaderTable* Table)
{
	Keep(Table);
	FVulkanShaderTable::FUpdate Update;
	FRTStatus Status = static_cast<FVulkanShaderTable*>(Table)->TakeUpdate(Update);
	if (!Status)
	{
		Error = Error ? Status : Error;
		return;
	}
	if (Update.IsEmpty()) { return; }
	// Rays of earlier frames may still read the table, and an earlier update may still write it.
	const FVulkanAccess Trace = GetAccess(ERTAccess::TraceRead);
	FVulkanAccess Write = GetAccess(ERTAccess::CopyWrite | ERTAccess::CopyRead);
	Write.Stages |= ScatterAccess.Stages;
	Write.Access |= ScatterAccess.Access;
	Barrier({Trace.Stages | Write.Stages, Write.Access}, Write);
	Keep(Update.Dest);
	for (const FVulkanShaderTable::FFill& Zeros : Update.Zeros)
	{
		Device.Api.CmdFillBuffer(Handle, Update.Dest->Block.Handle, Zeros.Offset, Zeros.Size, 0);
	}
	if (Update.Moved.Source) { CopyRecords(Update.Moved, Update.Dest->Block.Handle); }
	bool bWritten = !Update.Zeros.empty() || Update.Moved.Source;
	for (const FVulkanShaderTable::FCopies& Item : Update.Copies)
	{
		if (bWritten)
		{
			Barrier(Write, Write); // the same records may come twice
		}
		CopyRecords(Item, Update.Dest->Block.Handle);
		bWritten = true;
	}
	Barrier(Write, Trace);
}

void FVulkanCommandList::CopyRecords(const FVulkanShaderTable::FCopies& Item, VkBuffer Dest)
{
	Keep(Item.Source.Get());
	if (!Item.Regions.empty())
	{
		Device.Api.CmdCopyBuffer(Handle, Item.Source->Block.Handle, Dest, static_cast<uint32_t>(Item.Regions.size()), Item.Regions.data());
	}
	for (const FVulkanScatter::FPush& Scatter : Item.Scatters) { Device.Scatter.Record(Device, Handle, Scatter); }
	if (!Item.Scatters.empty()) { RestoreAfterScatter(); }
}

FVulkanCommandList::FTraceRegions FVulkanCommandList::UseTable(IRTShaderTable* Table, uint32_t RayGen)
{
	Keep(Table);
	const FVulkanShaderTable* Native = static_cast<const FVulkanShaderTable*>(Table);
	Keep(Native->GetBuffer());
	assert(Bound && Bound->GetGroupCount() > 0 && "SetPipeline with a ray-tracing pipeline first");
	return {Native->GetRegion(ERTRecordKind::RayGen, RayGen), Native->GetRegion(ERTRecordKind::Miss, 0),
	    Native->GetRegion(ERTRecordKind::Hit, 0), Native->GetRegion(ERTRecordKind::Callable, 0)};
}

void FVulkanCommandList::TraceRays(IRTShaderTable* Table, uint32_t RayGen, uint32_t Width, uint32_t Height, uint32_t Depth)
{
	const FTraceRegions Of = UseTable(Table, RayGen);
	Device.Api.CmdTraceRaysKHR(Handle, &Of.Generate, &Of.Miss, &Of.Hit, &Of.Callable, Width, Height, Depth);
}

void FVulkanCommandList::TraceRaysIndirect(IRTShaderTable* Table, uint32_t RayGen, IRTBuffer* Arguments, uint64_t Offset)
{
	assert(Device.GetCapabilities().bIndirectTrace && Offset % 4 == 0);
	Keep(Arguments);
	const FTraceRegions Of = UseTable(Table, RayGen);
	const VkDeviceAddress Address = Arguments->GetDeviceAddress() + Offset;
	Device.Api.CmdTraceRaysIndirectKHR(Handle, &Of.Generate, &Of.Miss, &Of.Hit, &Of.Callable, Address);
}

void FVulkanCommandList::BuildGeometries(const FRTGeometryBuild* Builds, uint32_t Count)
{
	if (Count == 0) { return; }
	std::vector<FVulkanSections> Sections(Count);
	std::vector<VkAccelerationStructureBuildGeometryInfoKHR> Infos(Count);
	std::vector<const VkAccelerationStructureBuildRangeInfoKHR*> Ranges(Count);
	for (uint32_t Index = 0; Index < Count; ++Index)
	{
		const FRTGeometryBuild& Build = Builds[Index];
		const FVulkanGeometry* Geometry = static_cast<const FVulkanGeometry*>(Build.Geometry);
		assert(Build.SectionCount == Geometry->GetSectionCount());
		assert(Build.ScratchOffset % Device.GetCapabilities().ScratchAlignment == 0);
		Keep(Build.Geometry);
		Keep(Build.Scratch);
		for (uint32_t Section = 0; Section < Build.SectionCount; ++Section)
		{
			Keep(Build.Sections[Section].Vertices);
			Keep(Build.Sections[Section].Indices);
		}
		Sections[Index].Assign(Build.Sections, Build.SectionCount);
		Ranges[Index] = Sections[Index].Ranges.data();
		VkAccelerationStructureBuildGeometryInfoKHR& Info = Infos[Index];
		Info = {VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_GEOMETRY_INFO_KHR};
		Info.type = VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR;
		Info.flags = Geometry->Flags;
		Info.mode = Build.bUpdate ? VK_BUILD_ACCELERATION_STRUCTURE_MODE_UPDATE_KHR : VK_BUILD_ACCELERATION_STRUCTURE_MODE_BUILD_KHR;
		Info.srcAccelerationStructure = Build.bUpdate ? Geometry->Handle : VK_NULL_HANDLE;
		Info.dstAccelerationStructure = Geometry->Handle;
		Info.geometryCount = Build.SectionCount;
		Info.pGeometries = Sections[Index].Geometries.data();
		Info.scratchData.deviceAddress = Build.Scratch ? Build.Scratch->GetDeviceAddress() + Build.ScratchOffset : 0;
	}
	Device.Api.CmdBuildAccelerationStructuresKHR(Handle, Count, Infos.data(), Ranges.data());
}

void FVulkanCommandList::WriteCompactedSize(IRTQueryPool* Queries, uint32_t Index, IRTGeometry* Geometry)
{
	FVulkanQueryPool* Native = static_cast<FVulkanQueryPool*>(Queries);
	assert(Native->GetKind() == ERTQuery::CompactedSize && Index < Native->GetCount());
	Keep(Queries);
	Keep(Geometry);
	QueriesWritten.push_back({Native, Index});
	Device.Api.CmdWriteAccelerationStructuresPropertiesKHR(Handle, 1, &static_cast<const FVulkanGeometry*>(Geometry)->Handle,
	    VK_QUERY_TYPE_ACCELERATION_STRUCTURE_COMPACTED_SIZE_KHR, Native->Handle, Index);
}

void FVulkanCommandList::CompactGeometry(IRTGeometry* Dest, IRTGeometry* Source)
{
	Keep(Dest);
	Keep(Source);
	VkCopyAccelerationStructureInfoKHR Info{VK_STRUCTURE_TYPE_COPY_ACCELERATION_STRUCTURE_INFO_KHR};
	Info.src = static_cast<const FVulkanGeometry*>(Source)->Handle;
	Info.dst = static_cast<const FVulkanGeometry*>(Dest)->Handle;
	Info.mode = VK_COPY_ACCELERATION_STRUCTURE_MODE_COMPACT_KHR;
	Device.Api.CmdCopyAccelerationStructureKHR(Handle, &Info);
}

void FVulkanCommandList::BuildScene(
    IRTScene* Scene, IRTBuffer* Instances, uint64_t InstanceOffset, uint32_t Count, IRTBuffer* Scratch, uint64_t ScratchOffset)
{
	static_assert(sizeof(FRTInstance) == sizeof(VkAccelerationStructureInstanceKHR));
	assert(InstanceOffset % 16 == 0 && (Instances || Count == 0));
	assert(ScratchOffset % Device.GetCapabilities().ScratchAlignment == 0);
	Keep(Scene);
	Keep(Instances);
	Keep(Scratch);
	const FVulkanScene* Native = static_cast<const FVulkanScene*>(Scene);
	assert(Count <= Native->GetMaxInstances());
	const VkAccelerationStructureGeometryKHR Geometry =
	    FVulkanScene::MakeInstances(Instances ? Instances->GetDeviceAddress() + InstanceOffset : 0);
	VkAccelerationStructureBuildGeometryInfoKHR Info{VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_GEOMETRY_INFO_KHR};
	Info.type = VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR;
	Info.flags = Native->Flags;
	Info.mode = VK_BUILD_ACCELERATION_STRUCTURE_MODE_BUILD_KHR;
	Info.dstAccelerationStructure = Native->Handle;
	Info.geometryCount = 1;
	Info.pGeometries = &Geometry;
	Info.scratchData.deviceAddress = Scratch ? Scratch->GetDeviceAddress() + ScratchOffset : 0;
	VkAccelerationStructureBuildRangeInfoKHR Range{};
	Range.primitiveCount = Count;
	const VkAccelerationStructureBuildRangeInfoKHR* Ranges = &Range;
	Device.Api.CmdBuildAccelerationStructuresKHR(Handle, 1, &Info, &Ranges);
}

} // namespace Lantern
