// What a shader table does where handles alone are new: four bytes a record travel, and a compute pass looks the handles
// up.
#include "ShaderTable/VulkanShaderTable.h"

#include <cstring>

namespace Lantern
{

void FVulkanShaderTable::PruneHandles()
{
	std::vector<bool> Used(Handles.GetCount(), false);
	for (const FVulkanTableRecords& Kind : Records) { Kind.MarkUsed(Used); }
	const std::vector<uint32_t> NewOf = Handles.Prune(Used);
	for (FVulkanTableRecords& Kind : Records) { Kind.Renumber(NewOf); }
}

void FVulkanShaderTable::TakeDirtyHandles(FBatch& Batch, uint64_t& InOutBytes)
{
	for (FVulkanTableRecords& Kind : Records)
	{
		FHandlePart& Part = Batch.HitHandles;
		std::vector<FRun> Runs;
		Kind.TakeDirtyHandles(Runs);
		if (&Kind == &Of(ERTRecordKind::Hit) && !bContentLost)
		{
			Part.Runs = std::move(Runs);
			Part.Count = static_cast<uint32_t>(FVulkanTableRecords::CountRecords(Part.Runs));
			continue;
		}
		for (const FRun& Run : Runs) { Kind.MarkDirty(Run); }
	}
	FHandlePart& Part = Batch.HitHandles;
	if (Part.Count > 0)
	{
		Part.SlotOffset = InOutBytes;
		Part.HandleOffset = Part.SlotOffset + sizeof(uint32_t) * Part.Count;
		InOutBytes = Part.HandleOffset + uint64_t(Handles.GetCount()) * Device.GetCapabilities().ShaderGroupHandleSize;
	}
}

void FVulkanShaderTable::FillHandles(const FBatch& Batch) const
{
	const FHandlePart& Part = Batch.HitHandles;
	if (Part.Count == 0) { return; }
	uint8_t* Begin = static_cast<uint8_t*>(Batch.Source->Block.Allocation.Mapped);
	uint32_t* Slot = reinterpret_cast<uint32_t*>(Begin + Part.SlotOffset);
	for (const FRun& Run : Part.Runs)
	{
		Of(ERTRecordKind::Hit).CopySlotsTo(Slot, Run);
		Slot += Run.Count;
	}
	memcpy(Begin + Part.HandleOffset, Handles.GetHandles(), uint64_t(Handles.GetCount()) * Device.GetCapabilities().ShaderGroupHandleSize);
}

void FVulkanShaderTable::AddHandles(const FBatch& Batch, FCopies& Out)
{
	const FHandlePart& Part = Batch.HitHandles;
	const uint32_t Hit = static_cast<uint32_t>(ERTRecordKind::Hit);
	const uint64_t Stride = Records[Hit].GetStride();
	const uint32_t HandleSize = Device.GetCapabilities().ShaderGroupHandleSize;
	const VkDeviceAddress From = Batch.Source->Block.Address;
	const VkDeviceAddress To = Current.Buffer->Block.Address + Current.Offsets[Hit];
	VkDeviceAddress Slots = From + Part.SlotOffset;
	for (const FRun& Run : Part.Runs)
	{
		Out.Scatters.push_back({To + Stride * Run.First, From + Part.HandleOffset, Slots, HandleSize / uint32_t(sizeof(uint32_t)),
		    Run.Count, static_cast<uint32_t>(Stride / sizeof(uint32_t)), true});
		Slots += sizeof(uint32_t) * Run.Count;
	}
	UpdatedBytes += sizeof(uint32_t) * uint64_t(Part.Count) + uint64_t(Handles.GetCount()) * HandleSize;
}

} // namespace Lantern
