// FLightStore: slots of lights, and the table that shaders read.
#include "LanternScene/Lights/LightStore.h"

#include <cassert>

#include "LanternCore/Text/Log.h"

namespace Lantern
{

FLightId FLightStore::Add(const FSceneLight& Light)
{
	const uint32_t Slot = Slots.Take(MaxLights);
	if (Slot == TSlots<FSceneLight>::None)
	{
		LogOnce(ERTLogLevel::Error, "the scene has 2^24 lights; reservoirs cannot name more, and further ones are left out");
		return {};
	}
	Slots[Slot] = Light;
	Extended += HasExtent(Light) ? 1 : 0;
	Table.Set(Slot, PackLight(Light));
	return {Slot, Slots.GetGeneration(Slot)};
}

void FLightStore::Set(FLightId Id, const FSceneLight& Light)
{
	assert(Slots.IsCurrent(Id.Index, Id.Generation));
	Extended -= HasExtent(Slots[Id.Index]) ? 1 : 0;
	Extended += HasExtent(Light) ? 1 : 0;
	Slots[Id.Index] = Light;
	Table.Set(Id.Index, PackLight(Light));
}

void FLightStore::Remove(FLightId Id)
{
	assert(Slots.IsCurrent(Id.Index, Id.Generation));
	Extended -= HasExtent(Slots[Id.Index]) ? 1 : 0;
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
