// Geometry whose triangles are, or are no longer, told apart by their opacity.
#include "LanternScene/Geometry/GeometryStore.h"

namespace Lantern
{

void FGeometryStore::ForgetStructure(FEntry& Entry)
{
	if (Entry.Geometry->Structure) { LastReleaseFrame = Frame; }
	Entry.Geometry->Structure = nullptr;
	Entry.Geometry->bBuilt = false;
	Entry.Compaction = ECompaction::None;
	Entry.Compacted = nullptr;
	// Sizes that were asked for are those of the structure that is gone.
	const uint32_t Slot = MakeRef(Entry).Slot;
	for (FSizeBatch& Batch : Batches)
	{
		for (FSlotRef& Item : Batch.Items) { Item.Generation = Item.Slot == Slot ? ~Entry.Generation : Item.Generation; }
	}
	SetAddress(Entry, 0);
}

void FGeometryStore::ApplyOpacity(FEntry& Entry)
{
	FRTGeometry& Geometry = *Entry.Geometry;
	const bool bClassified = bUseOpacity && !Entry.bRefuted;
	// Coarser levels are made from whole sections.
	const bool bCoarser = Geometry.bCoarse || Entry.State == EState::Coarsening;
	if (!Geometry.HasClassifiedSections() || Geometry.bClassified == bClassified || bCoarser) { return; }
	Geometry.bClassified = bClassified;
	Geometry.Parts = MakeGeometryParts(Geometry.Info, bClassified);
	const bool bThere = Entry.State == EState::Built || Entry.State == EState::Building;
	ForgetStructure(Entry);
	UpdateSizes(Entry);
	MarkChanged(Entry);
	if (bThere)
	{
		Entry.bLost = true; // what was in the picture comes first
		Queue(Entry);
	}
}

void FGeometryStore::SetOpacityUse(bool bUsed)
{
	if (bUseOpacity == bUsed) { return; }
	bUseOpacity = bUsed;
	for (FEntry& Entry : Entries)
	{
		if (!Entry.Owner.expired()) { ApplyOpacity(Entry); }
	}
}

void FGeometryStore::RefuteOpacity(uint32_t Slot)
{
	FEntry& Entry = Entries[Slot];
	Entry.bRefuted = true;
	if (!Entry.Owner.expired()) { ApplyOpacity(Entry); }
}

} // namespace Lantern
