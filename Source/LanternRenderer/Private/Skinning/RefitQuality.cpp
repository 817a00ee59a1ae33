#include "Skinning/RefitQuality.h"

#include <algorithm>

#include "PassTools.h"

namespace Lantern
{

uint32_t FRefitQuality::CountGroups(uint32_t Triangles) { return DivideUp(Triangles, REFIT_GROUP_TRIANGLES * REFIT_GROUP_SIZE); }

float FRefitQuality::ComputeLooseness(const FRefitQualitySum* Sums, uint32_t Count)
{
	double Boxes = 0.0, Triangles = 0.0;
	for (uint32_t I = 0; I < Count; ++I)
	{
		Boxes += Sums[I].BoxArea;
		Triangles += Sums[I].TriangleArea;
	}
	return Triangles > 0.0 ? static_cast<float>(Boxes / Triangles) : 0.0f;
}

void FRefitQuality::Take(FGeometryStore& Store)
{
	const FRTFence Completed = Device.GetCompletedFence();
	for (FBatch& Batch : InFlight)
	{
		if (Batch.Fence > Completed) { continue; }
		const auto* const Sums = static_cast<const FRefitQualitySum*>(Batch.Results->GetMapped());
		for (const FItem& Item : Batch.Items) { Take(Store, Item, Sums + Item.First); }
		Batch.Items.clear();
		Free.push_back(std::move(Batch));
	}
	std::erase_if(InFlight, [](const FBatch& Batch) { return !Batch.Results; });
}

void FRefitQuality::Take(FGeometryStore& Store, const FItem& Item, const FRefitQualitySum* Sums)
{
	const std::shared_ptr<FRTGeometry> Geometry = Item.Geometry.lock();
	// Measured before the last build: it says nothing of the structure that there is now.
	if (!Geometry || Item.Builds == 0 || Item.Builds != Store.GetBuildCount(Item.Slot)) { return; }
	const float Looseness = ComputeLooseness(Sums, Item.Count);
	Baselines.resize(std::max<size_t>(Baselines.size(), Item.Slot + 1));
	FBaseline& Baseline = Baselines[Item.Slot];
	if (Baseline.Geometry.lock() != Geometry || Baseline.Builds != Item.Builds) { Baseline = {Geometry, Item.Builds, Looseness}; }
	if (Baseline.Looseness > 0.0f) { Store.SetRefitQuality(Item.Slot, Looseness / Baseline.Looseness); }
}

bool FRefitQuality::ReserveResults(FBatch& Batch, uint64_t Bytes)
{
	if (Batch.Results && Batch.Results->GetDesc().Size >= Bytes) { return true; }
	const FRTBufferDesc Desc{std::max<uint64_t>(Bytes, 4096), ERTBufferUsage::Storage, ERTMemory::Readback, "RefitQuality"};
	return Device.CreateBuffer(Desc, Batch.Results.ReleaseAndGetAddress()).IsOk();
}

FRefitQuality::FWork FRefitQuality::Prepare(FGeometryStore& Store, const std::vector<FSkinningInputs>& Items)
{
	Take(Store);
	FWork Work;
	if (Items.empty() || !Store.WantsRefitQuality()) { return Work; }
	FBatch Batch;
	if (!Free.empty())
	{
		Batch = std::move(Free.back());
		Free.pop_back();
	}
	uint32_t Sums = 0;
	for (size_t I = 0; I < std::min(PerFrame, Items.size()); ++I)
	{
		const FRTGeometryRef& Geometry = Items[Next++ % Items.size()].Geometry;
		const FRTGeometryInfo& Info = Geometry->GetInfo();
		if (!Geometry->IsBuilt()) { continue; }
		FItem Item{Geometry, Geometry->GetSlot(), 0, Sums, 0};
		for (const FRTGeometryPart& Part : Geometry->GetParts())
		{
			if (Info.Sections[Part.Section].bProcedural) { continue; }
			FRefitQualityConstants C{};
			C.Positions = Info.Positions->GetDeviceAddress() + Info.PositionsOffset;
			C.Indices = Geometry->GetIndices()->GetDeviceAddress() + Geometry->GetIndicesOffset();
			C.Sums = Sums; // until the buffer is there
			C.FirstIndex = Part.FirstIndex;
			C.TriangleCount = Part.IndexCount / 3;
			C.Flags = Geometry->GetIndexType() == ERTIndexType::UInt16 ? REFIT_INDEX_16 : 0u;
			Work.Dispatches.push_back(C);
			Sums += CountGroups(C.TriangleCount);
		}
		Item.Count = Sums - Item.First;
		Batch.Items.push_back(std::move(Item));
	}
	if (Sums == 0 || !ReserveResults(Batch, Sums * sizeof(FRefitQualitySum))) { return {}; }
	for (FRefitQualityConstants& C : Work.Dispatches) { C.Sums = Batch.Results->GetDeviceAddress() + C.Sums * sizeof(FRefitQualitySum); }
	Work.Results = Batch.Results;
	Current = std::make_unique<FBatch>(std::move(Batch));
	return Work;
}

void FRefitQuality::EndFrame(const FGeometryStore& Store, FRTFence Fence)
{
	if (!Current) { return; }
	FBatch Batch = std::move(*Current);
	Current.reset();
	if (Fence == 0)
	{
		Batch.Items.clear();
		Free.push_back(std::move(Batch));
		return;
	}
	// With this frame's builds in it: a geometry that was rebuilt in it has its new baseline.
	for (FItem& Item : Batch.Items) { Item.Builds = Store.GetBuildCount(Item.Slot); }
	Batch.Fence = Fence;
	InFlight.push_back(std::move(Batch));
}

} // namespace Lantern
