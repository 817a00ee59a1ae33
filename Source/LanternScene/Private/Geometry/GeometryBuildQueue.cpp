// FGeometryBuildQueue: the order of builds and their limit of triangles.
#include "Geometry/GeometryBuildQueue.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "LanternCore/Config/ConsoleVariables.h"

namespace Lantern
{

namespace
{
TRTConsoleVariable<int32_t> CVarTriangles("r.RT.Build.TrianglesPerFrame", 500000,
    "Limits the triangles of acceleration structures that a frame builds. Near and large geometries come first; at least one "
    "is built. 0: no limit. Offline pictures ignore the limit.",
    {0, 2'000'000'000});

// Heights of the picture that a geometry gains on newer ones in each frame in which it waits. After 200 frames only older
// geometries are ahead of it, so that none starves.
constexpr float AgingPerFrame = 0.005f;
} // namespace

FGeometryBuildQueue::FGeometryBuildQueue(FGeometrySlots& InSlots, const FGeometryStoreStats& InStats) : Slots(InSlots), Stats(InStats) {}

void FGeometryBuildQueue::Add(FGeometryEntry& Entry)
{
	Entry.State = EGeometryState::Pending;
	Pending.push_back(Slots.MakeRef(Entry));
}

void FGeometryBuildQueue::Remove(uint32_t Slot)
{
	std::erase_if(Pending, [=](FGeometrySlotRef Ref) { return Ref.Slot == Slot; });
}

void FGeometryBuildQueue::Order(const FRound& Round)
{
	std::erase_if(Pending, [&](FGeometrySlotRef Ref) {
		const FGeometryEntry* const Entry = Slots.Resolve(Ref);
		return !Entry || Entry->State != EGeometryState::Pending;
	});
	std::vector<std::pair<float, FGeometrySlotRef>> Scored;
	Scored.reserve(Pending.size());
	for (const FGeometrySlotRef Ref : Pending)
	{
		FGeometryEntry& Entry = Slots[Ref.Slot];
		if (const float Size = Priorities.Take(Ref.Slot); Size > 0.0f) { Entry.ScreenSize = Size; }
		float Score = Entry.ScreenSize + AgingPerFrame * static_cast<float>(Round.Frame - Entry.QueuedFrame);
		if (Round.bSmallestFirst) { Score = -static_cast<float>(Entry.Sizes.StructureBytes); }
		if (Entry.bLost) { Score = std::numeric_limits<float>::max(); }
		Scored.push_back({Score, Ref});
	}
	std::sort(Scored.begin(), Scored.end(), [&](const auto& A, const auto& B) {
		return A.first != B.first ? A.first > B.first : Slots[A.second.Slot].Age < Slots[B.second.Slot].Age;
	});
	for (size_t I = 0; I < Scored.size(); ++I) { Pending[I] = Scored[I].second; }
}

FRTStatus FGeometryBuildQueue::Run(const FRound& Round, const FStart& Start)
{
	if (Pending.empty()) { return FRTStatus::Success(); }
	Order(Round);
	const uint64_t Limit = static_cast<uint64_t>(CVarTriangles.GetOnRenderThread());
	const std::vector<FGeometrySlotRef> Waiting = std::exchange(Pending, {});
	bool bStop = false;
	size_t Next = 0;
	FRTStatus Status = FRTStatus::Success();
	for (; Next < Waiting.size() && !bStop && Status; ++Next)
	{
		FGeometryEntry& Entry = Slots[Waiting[Next].Slot];
		const bool bSpent = Limit > 0 && Stats.Built > 0 && !Entry.bLost; // what was in the picture stays there
		if (!Round.bAll && bSpent && Stats.TrianglesBuilt + Entry.Triangles > Limit) { break; }
		Status = Start(Entry, Waiting.size() - Next, bStop);
		if (Entry.State == EGeometryState::Pending) { Pending.push_back(Waiting[Next]); }
	}
	Pending.insert(Pending.end(), Waiting.begin() + static_cast<ptrdiff_t>(Next), Waiting.end());
	return Status;
}

} // namespace Lantern
