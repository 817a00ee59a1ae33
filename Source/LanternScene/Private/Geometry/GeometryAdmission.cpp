// FGeometryAdmission: what becomes of a build, by the memory that it needs.
#include "Geometry/GeometryAdmission.h"

#include <algorithm>

namespace Lantern
{

FGeometryAdmission::FGeometryAdmission(FGeometryContext& InContext, FGeometryBuilder& InBuilder, FGeometryCompactor& InCompactor,
    FGeometryCoarsener& InCoarsener, FGeometryRefusals& InRefusals)
    : Context(InContext),
      Builder(InBuilder),
      Compactor(InCompactor),
      Coarsener(InCoarsener),
      Refusals(InRefusals)
{}

FRTStatus FGeometryAdmission::Admit(FGeometryEntry& Entry, bool bBuildAll, uint64_t Share, bool& bOutStop)
{
	const uint64_t Room = Context.Memory.GetRoom();
	const uint64_t Structure = Entry.Geometry->GetStructure() ? 0 : Entry.Sizes.StructureBytes;
	const uint64_t Need = Structure + Context.Scratch.GetGrowth(Entry.Sizes.BuildScratchBytes);
	// Compaction needs room for the structure and its copy.
	const bool bCompacts = FGeometryCompactor::IsOn() && !Entry.Geometry->GetInfo().bDynamic;
	const bool bOverlap = !bBuildAll && Entry.Misfits < PatienceFrames && bCompacts;
	const uint64_t Overlap = bOverlap ? static_cast<uint64_t>(static_cast<double>(Structure) * Compactor.GetExpectedShare()) : 0;
	if (Room != FGeometryMemoryBudget::Unlimited && Need + Overlap > std::min(Room, Share))
	{
		++Context.Stats.WaitingForMemory;
		if (!bBuildAll && Need <= Context.Memory.GetLimit() && IsMemoryComing() && ++Entry.Waits <= MostWaitFrames)
		{
			bOutStop = true;
			return FRTStatus::Success();
		}
		return OnMisfit(Entry, bBuildAll, std::min(Room, Share));
	}
	const FRTStatus Status = Builder.AddBuild(Entry);
	if (Status.Code != ERTResult::OutOfDeviceMemory || bBuildAll) { return Status; }
	// The device has less than the budget.
	++Context.Stats.WaitingForMemory;
	return OnMisfit(Entry, bBuildAll, Entry.Sizes.StructureBytes / 2);
}

FRTStatus FGeometryAdmission::OnMisfit(FGeometryEntry& Entry, bool bBuildAll, uint64_t Room)
{
	if (!bBuildAll && ++Entry.Misfits <= PatienceFrames) { return FRTStatus::Success(); }
	if (!Coarsener.Start(Entry, Room))
	{
		Refusals.Refuse(Entry, Room);
		return FRTStatus::Success();
	}
	if (!bBuildAll) { return FRTStatus::Success(); }
	if (FRTStatus S = Coarsener.Finish(Entry); !S) { return S; }
	Context.Queue.Remove(Context.Slots.GetSlot(Entry));
	if (Entry.State != EGeometryState::Pending) { return FRTStatus::Success(); }
	if (Context.Scratch.GetBuildBytes(Entry.Sizes) <= Context.Memory.GetRoom()) { return Builder.AddBuild(Entry); }
	Refusals.Refuse(Entry, Room);
	return FRTStatus::Success();
}

} // namespace Lantern
