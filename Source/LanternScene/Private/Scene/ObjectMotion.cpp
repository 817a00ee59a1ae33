// FObjectMotions: moves are noted as they happen, and entries are made of them once a frame.
#include "LanternScene/Scene/ObjectMotion.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <utility>

namespace Lantern
{

namespace
{
/// A table of more entries than this is freed at once when nothing moves any more.
constexpr uint32_t LargeTable = 4096;

template <class T>
void SwapRemove(std::vector<T>& Values, uint32_t Place)
{
	if (Place + 1 < Values.size()) { Values[Place] = std::move(Values.back()); }
	Values.pop_back();
}

bool IsEqual(const FObjectMotion& A, const FObjectMotion& B) { return std::memcmp(&A, &B, sizeof(A)) == 0; }
} // namespace

// ---------------------------------------------------------------------------------------------------- objects

void FObjectMotions::Add(uint32_t Object, const FRTGeometry& Geometry)
{
	if (Object >= States.size()) { States.resize(Object + 1); }
	FState& State = States[Object];
	assert(State.Entry == NO_MOTION && !State.Deformable);
	State.Born = Frame;
	JoinDeformable(Object, Geometry);
}

void FObjectMotions::SetGeometry(uint32_t Object, const FRTGeometry& Geometry)
{
	LeaveDeformable(Object);
	JoinDeformable(Object, Geometry);
}

void FObjectMotions::JoinDeformable(uint32_t Object, const FRTGeometry& Geometry)
{
	if (!Geometry.GetInfo().PreviousPositions) { return; }
	FState& State = States[Object];
	FDeformable& Deformable = Deformables[&Geometry];
	Deformable.Geometry = &Geometry;
	State.Deformable = &Deformable;
	State.Member = static_cast<uint32_t>(Deformable.Objects.size());
	Deformable.Objects.push_back(Object);
}

void FObjectMotions::LeaveDeformable(uint32_t Object)
{
	FState& State = States[Object];
	FDeformable* const Deformable = std::exchange(State.Deformable, nullptr);
	if (!Deformable) { return; }
	States[Deformable->Objects.back()].Member = State.Member;
	SwapRemove(Deformable->Objects, State.Member);
	State.Member = None;
	const FRTGeometry* const Geometry = Deformable->Geometry;
	if (Deformable->Objects.empty()) { Deformables.erase(Geometry); }
}

void FObjectMotions::Remove(uint32_t Object)
{
	for (FViewer& Viewer : Viewers) { Viewer.Forget(Object); }
	LeaveDeformable(Object);
	if (States[Object].Entry != NO_MOTION) { RemoveEntry(States[Object].Entry); }
	States[Object] = {};
}

void FObjectMotions::Truncate(uint32_t Count)
{
	if (Count >= States.size()) { return; }
	States.resize(Count);
	for (FViewer& Viewer : Viewers) { Viewer.Places.resize(std::min<size_t>(Count, Viewer.Places.size())); }
}

// ---------------------------------------------------------------------------------------------------- viewers

void FObjectMotions::FViewer::Add(uint32_t Object, const FObjectMotion& Before)
{
	if (Object >= Places.size()) { Places.resize(Object + 1, None); }
	Places[Object] = static_cast<uint32_t>(Moves.size());
	Moves.push_back({Object, Before});
}

void FObjectMotions::FViewer::Forget(uint32_t Object)
{
	const uint32_t Place = FindPlace(Object);
	if (Place == None) { return; }
	Places[Moves.back().Object] = Place;
	Places[Object] = None;
	SwapRemove(Moves, Place);
}

void FObjectMotions::FViewer::Clear()
{
	for (const FMove& Move : Moves) { Places[Move.Object] = None; }
	const bool bTooLarge = Moves.capacity() > LargeTable && Moves.size() < Moves.capacity() / 16;
	Moves.clear();
	if (bTooLarge) { Moves.shrink_to_fit(); }
}

bool FObjectMotions::SetViewer(uint64_t Id)
{
	const auto Found = std::find_if(Viewers.begin(), Viewers.end(), [&](const FViewer& Viewer) { return Viewer.Id == Id; });
	Current = static_cast<size_t>(Found - Viewers.begin());
	if (Found == Viewers.end()) { Viewers.emplace_back().Id = Id; }
	const FViewer& Viewer = GetViewer();
	return Viewer.LastFrame != 0 && LastDeformed <= Viewer.LastFrame;
}

// ---------------------------------------------------------------------------------------------------- changes

FObjectMotion FObjectMotions::MakeMotion(const FObjectData& Data)
{
	FObjectMotion Motion{};
	static_assert(sizeof(Motion.PreviousObjectToWorld) == sizeof(Data.ObjectToWorld));
	std::memcpy(Motion.PreviousObjectToWorld, Data.ObjectToWorld, sizeof(Data.ObjectToWorld));
	Motion.PreviousCell = Data.Cell;
	Motion.PreviousFlags = Data.Flags;
	return Motion;
}

void FObjectMotions::BeforeMove(uint32_t Object)
{
	for (FViewer& Viewer : Viewers)
	{
		if (Viewer.FindPlace(Object) == None && HasPast(States[Object], Viewer)) { Viewer.Add(Object, MakeMotion(Objects[Object])); }
	}
}

void FObjectMotions::MarkDeformed(const FRTGeometryRef& Geometry)
{
	if (!Geometry->GetInfo().PreviousPositions || std::exchange(Geometry->bMotionMarked, true)) { return; }
	Deformed.push_back(Geometry);
}

// ---------------------------------------------------------------------------------------------------- a frame

uint64_t FObjectMotions::FindPreviousPositions(const FState& State)
{
	const FRTGeometry* const Geometry = State.Deformable ? State.Deformable->Geometry : nullptr;
	// A geometry that was never shown deformed has no previous positions.
	if (!Geometry || !Geometry->bMotionMarked || !Geometry->bWasDeformed) { return 0; }
	return Geometry->GetInfo().PreviousPositions->GetDeviceAddress();
}

void FObjectMotions::SetEntry(uint32_t Object, uint32_t Entry)
{
	States[Object].Entry = Entry;
	FObjectData Data = Objects[Object];
	Data.Motion = Entry;
	Objects.Set(Object, Data);
}

void FObjectMotions::Write(uint32_t Object, FObjectMotion Motion)
{
	Motion.PreviousPositions = FindPreviousPositions(States[Object]);
	uint32_t Entry = States[Object].Entry;
	if (Entry == NO_MOTION)
	{
		Entry = Table.Add(Motion);
		Owners.push_back({Object, UpdateNumber});
		SetEntry(Object, Entry);
		return;
	}
	Owners[Entry].Update = UpdateNumber;
	if (!IsEqual(Table[Entry], Motion)) { Table.Set(Entry, Motion); }
}

/// Moves the last entry to the place of the removed one.
void FObjectMotions::RemoveEntry(uint32_t Entry)
{
	const uint32_t Last = Table.Num() - 1;
	const uint32_t Object = Owners[Entry].Object;
	if (Entry != Last)
	{
		Table.Set(Entry, Table[Last]);
		SetEntry(Owners[Last].Object, Entry);
	}
	SetEntry(Object, NO_MOTION);
	SwapRemove(Owners, Entry);
	Table.Truncate(Last);
}

void FObjectMotions::Update(bool bWanted)
{
	++UpdateNumber;
	if (bWanted)
	{
		for (const FMove& Move : GetMoves())
		{
			// An object that came back, or was set to where it is, did not move.
			if (!IsEqual(MakeMotion(Objects[Move.Object]), Move.Before)) { Write(Move.Object, Move.Before); }
		}
		for (const FRTGeometryRef& Geometry : Deformed)
		{
			const auto Found = Deformables.find(Geometry.get());
			if (Found == Deformables.end() || !Geometry->bWasDeformed) { continue; }
			for (const uint32_t Object : Found->second.Objects)
			{
				const FState& State = States[Object];
				const bool bWritten = State.Entry != NO_MOTION && Owners[State.Entry].Update == UpdateNumber;
				if (!bWritten && HasPast(State, GetViewer())) { Write(Object, MakeMotion(Objects[Object])); }
			}
		}
	}
	// From the end: the entry that takes the place of a removed one has been looked at already.
	MostEntries = std::max(MostEntries, Table.Num());
	for (uint32_t Entry = Table.Num(); Entry-- > 0;)
	{
		if (Owners[Entry].Update != UpdateNumber) { RemoveEntry(Entry); }
	}
	if (Table.Num() == 0 && std::exchange(MostEntries, 0) > LargeTable)
	{
		Table = TGpuTable<FObjectMotion>("ObjectMotions");
		Owners = {};
	}
}

void FObjectMotions::EndFrame(bool bSubmitted)
{
	const bool bDeformed = !Deformed.empty();
	for (const FRTGeometryRef& Geometry : Deformed)
	{
		Geometry->bMotionMarked = false;
		Geometry->bWasDeformed |= bSubmitted;
	}
	Deformed.clear();
	if (!bSubmitted) { return; }
	++Frame;
	if (bDeformed) { LastDeformed = Frame; }
	const uint64_t Id = GetViewer().Id;
	GetViewer().LastFrame = Frame;
	GetViewer().Clear();
	for (FViewer& Viewer : Viewers) { Viewer.IdleFrames = Viewer.Id == Id ? 0 : Viewer.IdleFrames + 1; }
	std::erase_if(Viewers, [](const FViewer& Viewer) { return Viewer.IdleFrames >= KeptFrames || Viewer.LastFrame == 0; });
	(void)SetViewer(Id);
}

} // namespace Lantern
