// FLightStore: slots of lights, and the table that shaders read.
#include "LanternScene/Lights/LightStore.h"

#include <cassert>

#include "LanternCore/Text/Log.h"

namespace Lantern
{

namespace
{
/// Moves are what lights do most. Before: of the same light in another place. Packed: Light before.
FLightData PackMoved(const FSceneLight& Before, const FSceneLight& Light, FLightData Packed, const FLightReach& Reach)
{
	FSceneLight Moved = Before;
	Moved.Position = Light.Position;
	if (ReachesEverywhere(Light) || !(Moved == Light)) { return PackLight(Light); }
	for (int Axis = 0; Axis < 3; ++Axis) { Packed.Position[Axis] = Reach.Position[Axis]; }
	return Packed;
}

FLightData NumberLight(FLightData Packed, FLightId Id)
{
	if (Packed.Number == 0) { Packed.Number = MakeLightNumber(Id); }
	return Packed;
}
} // namespace

/// Times: 1, or −1 modulo 2³².
void FLightStore::Count(const FSceneLight& Light, uint32_t Times)
{
	Extended += HasExtent(Light) ? Times : 0;
	Finite += ReachesEverywhere(Light) ? 0 : Times;
	InFog += Light.bLightsFog ? Times : 0;
	Profiled += Light.Profile != 0 ? Times : 0;
	OffChannel += (Light.Channels & CHANNELS_DEFAULT) == 0 ? Times : 0;
}

FLightId FLightStore::Add(const FSceneLight& Light)
{
	const uint32_t Slot = Slots.Take(MaxLights);
	if (Slot == TSlots<FSceneLight>::None)
	{
		LogOnce(ERTLogLevel::Error, "the scene has 2^24 lights; reservoirs cannot name more, and further ones are left out");
		return {};
	}
	Slots[Slot] = Light;
	++Changes;
	Count(Light, 1);
	Journal.Add(GetReach(Light));
	const FLightId Id{Slot, Slots.GetGeneration(Slot)};
	Table.Set(Slot, NumberLight(PackLight(Light), Id));
	return Id;
}

void FLightStore::Set(FLightId Id, const FSceneLight& Light)
{
	assert(Slots.IsCurrent(Id.Index, Id.Generation));
	++Changes;
	FSceneLight& Old = Slots[Id.Index];
	const FLightReach Reach = GetReach(Light);
	if (!ReachAlike(Old, Light))
	{
		Journal.Add(GetReach(Old));
		Journal.Add(Reach);
	}
	Count(Old, ~0u);
	Count(Light, 1);
	const FLightData Packed = NumberLight(PackMoved(Old, Light, Table[Id.Index], Reach), Id);
	Old = Light;
	Table.Set(Id.Index, Packed);
}

void FLightStore::Remove(FLightId Id)
{
	assert(Slots.IsCurrent(Id.Index, Id.Generation));
	++Changes;
	Count(Slots[Id.Index], ~0u);
	Journal.Add(GetReach(Slots[Id.Index]));
	Slots.Free(Id.Index);
	if (Id.Index < Slots.Num()) { Table.Set(Id.Index, FLightData{}); }
	Table.Truncate(Slots.Num());
}

const FSceneLight& FLightStore::Get(FLightId Id) const
{
	assert(Slots.IsCurrent(Id.Index, Id.Generation));
	return Slots[Id.Index];
}

} // namespace Lantern
