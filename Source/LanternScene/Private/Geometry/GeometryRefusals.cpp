// FGeometryRefusals: who is left out, and when it is tried again.
#include "Geometry/GeometryRefusals.h"

#include <algorithm>
#include <utility>

#include "Geometry/GeometryCoarsener.h"
#include "LanternCore/Text/Log.h"
#include "LanternCore/Text/Quote.h"

namespace Lantern
{

FGeometryRefusals::FGeometryRefusals(FGeometryContext& InContext) : Context(InContext) {}

void FGeometryRefusals::Refuse(FGeometryEntry& Entry, uint64_t Room)
{
	Entry.State = EGeometryState::Refused;
	Entry.RefusedRoom = Room;
	Entry.SetStructure(nullptr);
	Refused.push_back(Context.Slots.MakeRef(Entry));
	if (std::exchange(Entry.bReported, true)) { return; }
	LogOnce(ERTLogLevel::Warning,
	    fmt::format("Scene: geometry \"{}\" ({} triangles) is left out: {:.1f} MiB of acceleration structure do not fit, "
	                "r.RT.Build.MemoryMB {}, {:.1f} MiB in use",
	        EscapeText(Entry.Geometry->GetInfo().Name, MaxQuotedBytes), Entry.Triangles, ToMiB(Entry.Sizes.StructureBytes),
	        Context.Memory.GetLimit() >> 20, ToMiB(Context.Memory.GetUsed())));
}

bool FGeometryRefusals::IsWorthAnotherTry(const FGeometryEntry& Entry, uint64_t Room) const
{
	const bool bFits = Context.Scratch.GetBuildBytes(Entry.Sizes) <= Room;
	return bFits || (FGeometryCoarsener::CanCoarsen(Entry) && Room / 2 > std::max(Entry.RefusedRoom, FBuildScratch::Step));
}

bool FGeometryRefusals::IsAnyWorthAnotherTry() const
{
	if (Refused.empty()) { return false; }
	const uint64_t Room = Context.Memory.GetRoom();
	return std::any_of(Refused.begin(), Refused.end(), [&](FGeometrySlotRef Ref) {
		const FGeometryEntry* const Entry = Context.Slots.Resolve(Ref);
		return Entry && IsWorthAnotherTry(*Entry, Room);
	});
}

void FGeometryRefusals::Reconsider()
{
	if (Refused.empty()) { return; }
	const uint64_t Room = Context.Memory.GetRoom();
	std::erase_if(Refused, [&](FGeometrySlotRef Ref) {
		FGeometryEntry* const Entry = Context.Slots.Resolve(Ref);
		if (!Entry || Entry->State != EGeometryState::Refused) { return true; }
		if (!IsWorthAnotherTry(*Entry, Room)) { return false; }
		Context.Queue.Add(*Entry);
		return true;
	});
}

} // namespace Lantern
