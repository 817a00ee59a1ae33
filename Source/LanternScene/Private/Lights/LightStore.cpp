// FLightStore: slots of lights, and the table that shaders read.
#include "LanternScene/Lights/LightStore.h"

#include <cassert>
#include <utility>

#include "LanternCore/Text/Log.h"

namespace Lantern
{

FLightData FLightStore::Pack(const FSceneLight& Light) const
{
	FLightData Packed = PackLight(Light);
	if ((CastingKinds & (1u << uint32_t(GetLightKind(Light)))) == 0) { Packed.Flags &= ~LIGHT_CASTS_SHADOW; }
	return Packed;
}

/// Moves are what lights do most. Before: of the same light in another place. Packed: Light before.
FLightData FLightStore::PackMoved(const FSceneLight& Before, const FSceneLight& Light, FLightData Packed, const FLightReach& Reach) const
{
	FSceneLight Moved = Before;
	Moved.Position = Light.Position;
	if (ReachesEverywhere(Light) || !(Moved == Light)) { return Pack(Light); }
	for (int Axis = 0; Axis < 3; ++Axis) { Packed.Position[Axis] = Reach.Position[Axis]; }
	return Packed;
}

namespace
{
FSceneLight MakeDark(FSceneLight Light)
{
	Light.Color = glm::vec3(0);
	return Light;
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
	Casters[size_t(GetLightKind(Light))] += Light.bCastsShadow ? Times : 0;
}

uint32_t FLightStore::GetShadowedCount() const
{
	uint32_t Shadowed = 0;
	for (uint32_t Kind = 0; Kind < Casters.size(); ++Kind) { Shadowed += (CastingKinds & (1u << Kind)) != 0 ? Casters[Kind] : 0; }
	return Shadowed;
}

void FLightStore::SetCastingKinds(uint32_t Kinds)
{
	if (std::exchange(CastingKinds, Kinds) == Kinds) { return; }
	++Changes;
	for (uint32_t Slot = 0; Slot < Slots.Num(); ++Slot)
	{
		if (Slots.IsAlive(Slot)) { Table.Set(Slot, NumberLight(Pack(Slots[Slot]), {Slot, Slots.GetGeneration(Slot)})); }
	}
}

FLightId FLightStore::Add(const FSceneLight& Light)
{
	const uint32_t Slot = Slots.Take(MaxLights);
	if (Slot == TSlots<FSceneLight>::None)
	{
		LogOnce(ERTLogLevel::Error, "the scene has 2^23 lights; shaders cannot name more, and further ones are left out");
		return {};
	}
	Slots[Slot] = Light;
	++Changes;
	Count(Light, 1);
	Journal.Add(GetReach(Light));
	Strengths.Add(CompareLights(Slot, MakeDark(Light), Light));
	const FLightId Id{Slot, Slots.GetGeneration(Slot)};
	Table.Set(Slot, NumberLight(Pack(Light), Id));
	return Id;
}

void FLightStore::NoteStrength(uint32_t Slot, const FSceneLight& Before, const FSceneLight& After)
{
	constexpr double FarAway = 1.0; // metres: it is gone from one place, and has come to another
	const bool bDirectional = After.Type == LIGHT_DIRECTIONAL;
	const bool bOtherPlace = !bDirectional && glm::length(After.Position - Before.Position) > FarAway;
	if (bOtherPlace || bDirectional != (Before.Type == LIGHT_DIRECTIONAL))
	{
		Strengths.Add(CompareLights(Slot, Before, MakeDark(Before)));
		return Strengths.Add(CompareLights(Slot, MakeDark(After), After));
	}
	const FLightChange Change = CompareLights(Slot, Before, After);
	if (Change.Strength > 0.0 || Change.Moved > 0.0) { Strengths.Add(Change); }
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
	NoteStrength(Id.Index, Old, Light);
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
	Strengths.Add(CompareLights(Id.Index, Slots[Id.Index], MakeDark(Slots[Id.Index])));
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
