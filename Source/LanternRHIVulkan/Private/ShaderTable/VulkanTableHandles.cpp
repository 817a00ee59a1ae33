// FVulkanShaderTable: records whose handles alone are new. Four bytes travel for each, and a compute pass looks the handles up.
#include "ShaderTable/VulkanShaderTable.h"

#include <cstring>

namespace Lantern
{

void FVulkanShaderTable::TakeDirtyHandles(FBatch& Batch, uint64_t& InOutBytes)
{
	FHandlePart& Part = Batch.HitHandles;
	for (uint32_t Kind = 0; Kind < RecordKindCount; ++Kind)
	{
		std::vector<FRun> Runs;
		Records[Kind].TakeDirtyHandles(Runs);
		if (Kind == static_cast<uint32_t>(ERTRecordKind::Hit) && !bContentLost)
		{
			Part.Runs = std::move(Runs);
			Part.Count = static_cast<uint32_t>(FTableRecords::CountRecords(Part.Runs));
			continue;
		}
		for (const FRun& Run : Runs) { Records[Kind].MarkDirty(Run); }
	}
	if (Part.Count > 0)
	{
		Part.SlotOffset = InOutBytes;
		Part.HandleOffset = Part.SlotOffset + sizeof(uint32_t) * Part.Count;
		InOutBytes = Part.HandleOffset + Records.GetHandles().GetSizeBytes();
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
		Records[static_cast<uint32_t>(ERTRecordKind::Hit)].CopySlotsTo(Slot, Run);
		Slot += Run.Count;
	}
	memcpy(Begin + Part.HandleOffset, Records.GetHandles().GetHandles(), Records.GetHandles().GetSizeBytes());
}

void FVulkanShaderTable::AddHandles(const FBatch& Batch, FCopies& Out)
{
	const FHandlePart& Part = Batch.HitHandles;
	const uint32_t Hit = static_cast<uint32_t>(ERTRecordKind::Hit);
	const uint64_t Stride = Records[Hit].GetStride();
	const uint32_t HandleSize = Records.GetHandles().GetHandleSize();
	const VkDeviceAddress From = Batch.Source->Block.Address;
	const VkDeviceAddress To = Current.Buffer->Block.Address + Current.Layout.Offsets[Hit];
	VkDeviceAddress Slots = From + Part.SlotOffset;
	for (const FRun& Run : Part.Runs)
	{
		Out.Scatters.push_back({To + Stride * Run.First, From + Part.HandleOffset, Slots, HandleSize / uint32_t(sizeof(uint32_t)),
		    Run.Count, static_cast<uint32_t>(Stride / sizeof(uint32_t)), FVulkanScatter::EKind::Handles});
		Slots += sizeof(uint32_t) * Run.Count;
	}
	UpdatedBytes += sizeof(uint32_t) * uint64_t(Part.Count) + Records.GetHandles().GetSizeBytes();
}

} // namespace Lantern
