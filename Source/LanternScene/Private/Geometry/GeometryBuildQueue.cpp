// FGeometryBuildQueue: the order of builds and their limit of triangles.
#include "Geometry/GeometryBuildQueue.h"

#include <algorithm>
#include <cmath>
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
TRTConsoleVariable<int32_t> CVarStructures("r.RT.Build.StructuresPerFrame", 16,
    "Limits the new acceleration structures that a frame builds. Each costs the render thread the same, however small it is. "
    "At least one is built. 0: no limit. Offline pictures ignore the limit.",
    {0, 1'000'000});

// Heights of the picture that a geometry gains on newer ones in each frame in which it waits. After 200 frames only older
// geometries are ahead of it, so that none starves.
constexpr float AgingPerFrame = 0.005f;
} // namespace

FGeometryBuildQueue::FGeometryBuildQueue(FGeometrySlots& InSlots, const FGeometryStoreStats& InStats) : Slots(InSlots), Stats(InStats) {}

FGeometryBuildQueue::FPlace& FGeometryBuildQueue::GetPlace(uint32_t Slot)
{
	if (Slot >= Places.size()) { Places.resize(Slot + 1); }
	return Places[Slot];
}

FGeometryBuildQueue::FKey FGeometryBuildQueue::MakeKey(const FGeometryEntry& Entry, bool bSmallestFirst) const
{
	double Score = double(Entry.ScreenSize) - double(AgingPerFrame) * static_cast<double>(Entry.QueuedFrame);
	if (bSmallestFirst) { Score = -static_cast<double>(Entry.Sizes.StructureBytes); }
	if (Entry.bLost) { Score = std::numeric_limits<double>::max(); }
	return {Score, Entry.Age, Slots.MakeRef(Entry)};
}

void FGeometryBuildQueue::Insert(FGeometryEntry& Entry, bool bSmallestFirst)
{
	++Visited;
	FPlace& Place = GetPlace(Slots.GetSlot(Entry));
	Erase(Place);
	Place = {MakeKey(Entry, bSmallestFirst), true, Entry.ScreenSize};
	Order.insert(Place.Key);
}

void FGeometryBuildQueue::Erase(FPlace& Place)
{
	if (Place.bQueued) { Order.erase(Place.Key); }
	Place.bQueued = false;
}

void FGeometryBuildQueue::Add(FGeometryEntry& Entry)
{
	Entry.State = EGeometryState::Pending;
	if (!bRunning) { return Insert(Entry, false); }
	Erase(GetPlace(Slots.GetSlot(Entry))); // it may still have its place from before it was refused
	Added.push_back(Slots.MakeRef(Entry));
}

void FGeometryBuildQueue::Remove(uint32_t Slot)
{
	Erase(GetPlace(Slot));
	std::erase_if(Added, [=](FGeometrySlotRef Ref) { return Ref.Slot == Slot; });
}

void FGeometryBuildQueue::TakeRaised()
{
	// Smaller changes are not worth another place.
	constexpr float LeastChange = 0.1f;
	for (const uint32_t Slot : Priorities.TakeRaised())
	{
		const float Size = Priorities.Take(Slot);
		if (!(Size > 0.0f) || Slot >= Slots.GetCount()) { continue; }
		FGeometryEntry& Entry = Slots[Slot];
		Entry.ScreenSize = Size;
		const FPlace& Place = GetPlace(Slot);
		if (Place.bQueued && std::abs(Size - Place.KeyedSize) > LeastChange * Place.KeyedSize) { Insert(Entry, false); }
	}
}

void FGeometryBuildQueue::InsertAdded()
{
	for (const FGeometrySlotRef Ref : std::exchange(Added, {}))
	{
		FGeometryEntry* const Entry = Slots.Resolve(Ref);
		if (Entry && Entry->State == EGeometryState::Pending) { Insert(*Entry, false); }
	}
}

void FGeometryBuildQueue::OrderAll(bool bSmallestFirst)
{
	std::vector<FGeometrySlotRef> All;
	for (const FKey& Key : Order) { All.push_back(Key.Ref); }
	for (const FGeometrySlotRef Ref : All) { Insert(Slots[Ref.Slot], bSmallestFirst); }
}

FRTStatus FGeometryBuildQueue::RunInOrder(const FRound& Round, const FStart& Start)
{
	const uint64_t Limit = static_cast<uint64_t>(CVarTriangles.GetOnRenderThread());
	const auto MostBuilt = static_cast<uint32_t>(CVarStructures.GetOnRenderThread());
	bool bStop = false;
	FRTStatus Status = FRTStatus::Success();
	while (!Order.empty() && !bStop && Status)
	{
		const FGeometrySlotRef Ref = Order.begin()->Ref;
		FGeometryEntry* const Entry = Slots.Resolve(Ref);
		if (!Entry || Entry->State != EGeometryState::Pending)
		{
			Erase(GetPlace(Ref.Slot));
			continue;
		}
		const bool bMayWait = !Round.bAll && Stats.Built > 0 && !Entry->bLost; // what was in the picture stays there
		const bool bTooMany = MostBuilt > 0 && Stats.Built >= MostBuilt;
		if (bMayWait && (bTooMany || (Limit > 0 && Stats.TrianglesBuilt + Entry->Triangles > Limit))) { break; }
		++Visited;
		const size_t Left = Order.size();
		Erase(GetPlace(Ref.Slot));
		Status = Start(*Entry, Left, bStop);
		const bool bAddedAlready = std::any_of(Added.begin(), Added.end(), [=](FGeometrySlotRef Each) { return Each.Slot == Ref.Slot; });
		if (Entry->State == EGeometryState::Pending && !bAddedAlready) { Added.push_back(Ref); }
	}
	return Status;
}

FRTStatus FGeometryBuildQueue::Run(const FRound& Round, const FStart& Start)
{
	Visited = 0;
	TakeRaised();
	if (Order.empty()) { return FRTStatus::Success(); }
	if (Round.bSmallestFirst) { OrderAll(true); }
	bRunning = true;
	const FRTStatus Status = RunInOrder(Round, Start);
	bRunning = false;
	InsertAdded();
	if (Round.bSmallestFirst) { OrderAll(false); }
	return Status;
}

} // namespace Lantern
