// FGeometryStore: the order of a frame, and changes of the opacity classification. Its parts do the work.
#include "LanternScene/Geometry/GeometryStore.h"

#include <cassert>
#include <utility>

#include "Geometry/GeometryAdmission.h"
#include "Geometry/GeometryBuilder.h"
#include "Geometry/GeometryCheck.h"
#include "Geometry/GeometryCoarsener.h"
#include "Geometry/GeometryCompactor.h"
#include "Geometry/GeometryContext.h"
#include "Geometry/GeometryRefits.h"
#include "Geometry/GeometryRefusals.h"

namespace Lantern
{

struct FGeometryStore::FImpl
{
	FImpl(IRTDevice& Device, std::vector<uint64_t>& Addresses) : Context(Device, Addresses) {}

	void FreeReleased();
	void ApplyOpacity(FGeometryEntry& Entry);
	FRTStatus ChooseWork(bool bBuildAll);
	FRTStatus ChooseRefits();
	FRTStatus ChooseBuilds(bool bBuildAll);
	void Submitted();
	void Lost();
	void UpdateStats();

	FGeometryContext Context;
	FGeometryCompactor Compactor{Context};
	FGeometryRefits Refits{Context};
	FGeometryRefusals Refusals{Context};
	FGeometryCoarsener Coarsener{Context, Refusals};
	FGeometryBuilder Builder{Context, Compactor, Refits};
	FGeometryAdmission Admission{Context, Builder, Compactor, Coarsener, Refusals};
	uint64_t Frame = 0;
	bool bUseOpacity = true;
};

FGeometryStore::FGeometryStore(IRTDevice& Device) : Impl(std::make_unique<FImpl>(Device, Addresses)) {}
FGeometryStore::~FGeometryStore() = default;

// ---------------------------------------------------------------------------------------------------- geometries

FRTStatus FGeometryStore::Create(FRTGeometryInfo Info, FRTGeometryRef& Out)
{
	FGeometryContext& Context = Impl->Context;
	if (FRTStatus S = Check(Info, Context.Device.GetCapabilities()); !S) { return S; }
	Impl->FreeReleased();
	FRTGeometryRef Geometry = Context.Slots.Create(std::move(Info));
	FGeometryEntry& Entry = Context.Slots[Geometry->GetSlot()];
	Entry.QueuedFrame = Impl->Frame;
	Context.Queue.ResetPriority(Geometry->GetSlot());
	Impl->ApplyOpacity(Entry);
	Entry.UpdateSizes(Context.Device);
	if (Geometry->GetInfo().bWaitsForData) { Entry.State = EGeometryState::Filling; }
	else { Context.Queue.Add(Entry); }
	Out = std::move(Geometry);
	return FRTStatus::Success();
}

FRTStatus FGeometryStore::Check(const FRTGeometryInfo& Info, const FRTCapabilities& Capabilities)
{
	return CheckGeometry(Info, Capabilities.MaxPrimitiveCount);
}

void FGeometryStore::MarkFilled(const FRTGeometryRef& Geometry)
{
	FGeometryContext& Context = Impl->Context;
	FGeometryEntry& Entry = Context.Slots[Geometry->GetSlot()];
	assert(Entry.State == EGeometryState::Filling);
	Context.Slots.NoteFilled(Entry);
	Entry.QueuedFrame = Impl->Frame;
	Context.Queue.Add(Entry);
}

void FGeometryStore::FImpl::FreeReleased()
{
	uint32_t Coarse = 0;
	const auto Leave = [this](uint32_t Slot) { Context.Queue.Remove(Slot); };
	if (Context.Slots.FreeReleased(Coarse, Leave) > 0) { Context.Memory.NoteRelease(); }
	Context.Stats.Coarse -= Coarse;
}

void FGeometryStore::FreeReleased()
{
	if (HasReleased()) { Impl->FreeReleased(); }
}

bool FGeometryStore::HasReleased() const { return Impl->Context.Slots.HasReleased(); }

void FGeometryStore::MarkDeformed(const FRTGeometryRef& Geometry)
{
	assert(Geometry->GetInfo().bDynamic);
	FGeometryEntry& Entry = Impl->Context.Slots[Geometry->GetSlot()];
	const bool bThere = Entry.State == EGeometryState::Built || Entry.State == EGeometryState::Building;
	if (bThere) { Impl->Refits.Add(Entry); } // otherwise the first build sees the new vertices
}

void FGeometryStore::SetRefitQuality(uint32_t Slot, float Ratio)
{
	if (Slot < GetSlotCount()) { Impl->Context.Slots[Slot].RefitRatio = Ratio; }
}

bool FGeometryStore::WantsRefitQuality() const { return FGeometryRefits::IsQualityWanted(); }

uint32_t FGeometryStore::GetBuildCount(uint32_t Slot) const { return Slot < GetSlotCount() ? Impl->Context.Slots[Slot].Builds : 0; }

void FGeometryStore::RaisePriority(uint32_t Slot, float ScreenSize) { Impl->Context.Queue.RaisePriority(Slot, ScreenSize); }

std::vector<uint32_t> FGeometryStore::TakeChanged() { return Impl->Context.Slots.TakeChanged(); }

const FRTGeometry* FGeometryStore::Get(uint32_t Slot) const { return Impl->Context.Slots.GetGeometry(Slot); }

uint32_t FGeometryStore::GetDynamicCount() const { return Impl->Context.Slots.GetDynamicCount(); }

const FGeometryStoreStats& FGeometryStore::GetStats() const { return Impl->Context.Stats; }

FRTStatus FGeometryStore::ReserveScratch(uint64_t Bytes, IRTBuffer*& Out) { return Impl->Context.Scratch.Reserve(Bytes, Out); }

// ---------------------------------------------------------------------------------------------------- opacity

void FGeometryStore::FImpl::ApplyOpacity(FGeometryEntry& Entry)
{
	const FRTGeometry& Geometry = *Entry.Geometry;
	const bool bClassified = bUseOpacity && !Entry.bRefuted;
	// Coarser levels are made from whole sections.
	const bool bCoarser = Geometry.IsCoarse() || Entry.State == EGeometryState::Coarsening;
	if (!Geometry.HasClassifiedSections() || Geometry.IsClassified() == bClassified || bCoarser) { return; }
	Entry.SetClassified(bClassified);
	const bool bThere = Entry.State == EGeometryState::Built || Entry.State == EGeometryState::Building;
	if (Geometry.GetStructure()) { Context.Memory.NoteRelease(); }
	Entry.SetStructure(nullptr);
	Entry.SetBuilt(false);
	Compactor.Forget(Entry);
	Context.Slots.SetAddress(Entry, 0);
	Entry.UpdateSizes(Context.Device);
	Context.Slots.MarkChanged(Entry);
	if (!bThere) { return; }
	Entry.bLost = true; // what was in the picture comes first
	Context.Queue.Add(Entry);
}

void FGeometryStore::SetOpacityUse(bool bUsed)
{
	if (std::exchange(Impl->bUseOpacity, bUsed) == bUsed) { return; }
	FGeometrySlots& Slots = Impl->Context.Slots;
	for (uint32_t Slot = 0; Slot < Slots.GetCount(); ++Slot)
	{
		if (Slots.GetGeometry(Slot)) { Impl->ApplyOpacity(Slots[Slot]); }
	}
}

bool FGeometryStore::IsOpacityUsed() const { return Impl->bUseOpacity; }

void FGeometryStore::RefuteOpacity(uint32_t Slot)
{
	FGeometrySlots& Slots = Impl->Context.Slots;
	Slots[Slot].bRefuted = true;
	if (Slots.GetGeometry(Slot)) { Impl->ApplyOpacity(Slots[Slot]); }
}

// ---------------------------------------------------------------------------------------------------- frame

bool FGeometryStore::NeedsUpdate() const
{
	const FGeometryContext& Context = Impl->Context;
	if (!Context.Queue.IsEmpty() || !Impl->Refits.IsEmpty() || Context.Slots.HasReleased()) { return true; }
	if (Context.Scratch.IsTooLarge() || Impl->Compactor.NeedsUpdate()) { return true; }
	return Impl->Refusals.IsAnyWorthAnotherTry() || Impl->Coarsener.IsAnyDone();
}

FRTStatus FGeometryStore::BeginFrame(bool bBuildAll)
{
	FGeometryContext& Context = Impl->Context;
	if (Impl->Builder.HasBuilds() || Impl->Compactor.HasCopies()) { Impl->Lost(); } // EndFrame was not called
	Context.Memory.BeginFrame(++Impl->Frame);
	FGeometryStoreStats& Stats = Context.Stats;
	Stats.TrianglesBuilt = 0;
	Stats.Built = Stats.Refitted = Stats.Rebuilt = Stats.Compacted = Stats.WaitingForMemory = 0;
	Impl->FreeReleased();
	Impl->Compactor.TakeCopies();
	Impl->Compactor.TakeSizes();
	Impl->Refusals.Reconsider();
	FRTStatus Status = Impl->ChooseWork(bBuildAll);
	if (!Status) { Impl->Lost(); }
	Impl->UpdateStats();
	return Status;
}

FRTStatus FGeometryStore::FImpl::ChooseWork(bool bBuildAll)
{
	if (FRTStatus S = ChooseRefits(); !S) { return S; }
	if (FRTStatus S = Compactor.Choose(); !S) { return S; }
	if (FRTStatus S = Coarsener.TakeDone(); !S) { return S; }
	if (FRTStatus S = ChooseBuilds(bBuildAll); !S) { return S; }
	return Builder.GrowForBatches();
}

FRTStatus FGeometryStore::FImpl::ChooseRefits()
{
	std::vector<FGeometryEntry*> Work;
	const FRTStatus Status = Refits.Choose(Work);
	for (FGeometryEntry* const Entry : Work) { Builder.AddRefit(*Entry); }
	return Status;
}

FRTStatus FGeometryStore::FImpl::ChooseBuilds(bool bBuildAll)
{
	const bool bLimited = Context.Memory.GetLimit() > 0;
	return Context.Queue.Run({Frame, bBuildAll, bBuildAll && bLimited}, [&](FGeometryEntry& Entry, size_t Left, bool& bOutStop) {
		// All at once, smallest first: each may take an equal share of the room, and large ones get what small ones leave.
		const uint64_t Share = bBuildAll ? Context.Memory.GetRoom() / Left : FGeometryMemoryBudget::Unlimited;
		return Admission.Admit(Entry, bBuildAll, Share, bOutStop);
	});
}

FRTStatus FGeometryStore::Record(IRTCommandList& List)
{
	FImpl& I = *Impl;
	if (!I.Builder.HasBuilds() && !I.Compactor.HasCommands()) { return FRTStatus::Success(); }
	I.Builder.RecordStaging(List);
	const FRTBarrier Before{nullptr, nullptr, ERTAccess::TraceRead | ERTAccess::BuildRead | ERTAccess::BuildWrite,
	    ERTAccess::BuildWrite | ERTAccess::BuildRead};
	List.Barriers(&Before, 1);
	I.Builder.RecordBuilds(List);
	I.Compactor.RecordCopies(List);
	const FRTStatus Status = I.Compactor.RecordQueries(List);
	const FRTBarrier After{nullptr, nullptr, ERTAccess::BuildWrite, ERTAccess::BuildWrite | ERTAccess::BuildRead | ERTAccess::TraceRead};
	List.Barriers(&After, 1);
	return Status;
}

void FGeometryStore::EndFrame(bool bSubmitted)
{
	if (bSubmitted) { Impl->Submitted(); }
	else { Impl->Lost(); }
	Impl->UpdateStats();
}

void FGeometryStore::FImpl::Submitted()
{
	Builder.Submitted();
	Compactor.Submitted();
	Context.Slots.DropHeld();
	Context.Scratch.EndFrame();
}

void FGeometryStore::FImpl::Lost()
{
	Builder.Lost();
	Compactor.Lost();
	Context.Slots.DropHeld();
}

void FGeometryStore::FImpl::UpdateStats()
{
	Context.Memory.UpdateStats();
	Context.Stats.Pending = Context.Queue.GetCount() + Coarsener.GetCount() + Context.Slots.GetFillingCount();
	Context.Stats.Refused = Refusals.GetCount();
}

} // namespace Lantern
