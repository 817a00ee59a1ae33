// How loose refitted acceleration structures have become: what is measured, and what it says.
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

void FRefitQuality::BeginFrame(uint32_t FlightIndex, FGeometryStore& Store)
{
	Ring.BeginFrame(FlightIndex, [&](const FRing::FEntry& Old) {
		const auto* const Sums = static_cast<const FRefitQualitySum*>(Old.Buffer->GetMapped());
		for (const FItem& Item : Old.Notes)
		{
			Waiting.push_back({Item.Geometry, Item.Builds, ComputeLooseness(Sums + Item.First, Item.Count)});
		}
	});
	std::erase_if(Waiting, [&](const FMeasure& Measure) { return Deliver(Store, Measure); });
}

bool FRefitQuality::Deliver(FGeometryStore& Store, const FMeasure& Measure)
{
	const std::shared_ptr<FRTGeometry> Geometry = Measure.Geometry.lock();
	if (!Geometry) { return true; }
	const uint32_t Slot = Geometry->GetSlot();
	if (Store.Get(Slot) != Geometry.get()) { return false; }
	// Measured before the last build: it says nothing of the structure that there is now.
	if (Measure.Builds == 0 || Measure.Builds != Store.GetBuildCount(Slot)) { return true; }
	if (Baselines.size() >= MostBaselines) { DropExpired(); }
	FMeasure& Baseline = Baselines[Geometry.get()];
	if (Baseline.Geometry.lock() != Geometry || Baseline.Builds != Measure.Builds) { Baseline = Measure; }
	if (Baseline.Looseness > 0.0f) { Store.SetRefitQuality(Slot, Measure.Looseness / Baseline.Looseness); }
	return true;
}

void FRefitQuality::DropExpired()
{
	std::erase_if(Baselines, [](const auto& Entry) { return Entry.second.Geometry.expired(); });
	MostBaselines = std::max<size_t>(64, 2 * Baselines.size());
}

FRefitQuality::FWork FRefitQuality::Prepare(FGeometryStore& Store, const std::vector<FSkinningInputs>& Items)
{
	FWork Work;
	if (Items.empty() || !Store.WantsRefitQuality()) { return Work; }
	std::vector<FItem> Measured;
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
		Measured.push_back(std::move(Item));
	}
	if (Sums == 0) { return {}; }
	FRTStatus Status;
	FRing::FEntry* const Entry = Ring.Write(std::max<uint64_t>(Sums * sizeof(FRefitQualitySum), 4096), Status);
	if (!Entry) { return {}; }
	for (FRefitQualityConstants& C : Work.Dispatches) { C.Sums = Entry->Buffer->GetDeviceAddress() + C.Sums * sizeof(FRefitQualitySum); }
	Work.Results = Entry->Buffer;
	Entry->Notes = std::move(Measured);
	return Work;
}

void FRefitQuality::EndFrame(const FGeometryStore& Store, bool bSubmitted)
{
	Ring.EndFrame(bSubmitted);
	FRing::FEntry* const Entry = Ring.GetCurrent();
	if (!Entry) { return; }
	// With this frame's builds in it: a geometry that was rebuilt in it has its new baseline.
	for (FItem& Item : Entry->Notes) { Item.Builds = Store.GetBuildCount(Item.Slot); }
}

} // namespace Lantern
