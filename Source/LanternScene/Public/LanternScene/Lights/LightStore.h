// FLightStore keeps the lights of a scene in slots. A light keeps its slot while it lives, so that histories may name it.
#pragma once

#include <array>

#include "LanternScene/Lights/Light.h"
#include "LanternScene/Lights/LightJournal.h"
#include "LanternScene/Memory/GpuTable.h"
#include "LanternScene/Memory/Slots.h"

namespace Lantern
{

/// Threads: one at a time. A change costs one entry of the table, whatever the number of lights. Positions in the table do not
/// depend on the scene's origin.
class FLightStore
{
public:
	static constexpr uint32_t MaxLights = 1u << (LIGHT_INDEX_BITS - 1); ///< the bit above says triangle

	/// Returns an invalid id, and logs that once, if there are MaxLights.
	FLightId Add(const FSceneLight& Light);
	void Set(FLightId Id, const FSceneLight& Light);
	void Remove(FLightId Id);
	const FSceneLight& Get(FLightId Id) const;
	/// Slots to visit in a walk over all lights. Find returns null for the free ones.
	uint32_t GetSlotCount() const { return Slots.Num(); }
	const FSceneLight* Find(uint32_t Slot) const { return Slots.IsAlive(Slot) ? &Slots[Slot] : nullptr; }
	uint32_t GetCount() const { return Slots.GetAliveCount(); }
	/// Lights with an extent: see HasExtent.
	uint32_t GetExtendedCount() const { return Extended; }
	/// Lights of finite range: see ReachesEverywhere.
	uint32_t GetFiniteCount() const { return Finite; }
	/// Lights with a profile.
	uint32_t GetProfiledCount() const { return Profiled; }
	/// Lights that are not of channel 0.
	uint32_t GetOffChannelCount() const { return OffChannel; }
	/// Lights that fog scatters.
	uint32_t GetFogCount() const { return InFog; }
	/// Lights that cast shadows, and whose kind does: see SetCastingKinds.
	uint32_t GetShadowedCount() const;
	/// Says which kinds of lights cast shadows, as bits 1 << ELightKind; others shine through everything. A change of it costs all
	/// lights, and counts as one of theirs.
	void SetCastingKinds(uint32_t Kinds);
	/// Counts all changes of lights, of whatever kind.
	uint64_t GetChangeCount() const { return Changes; }
	/// What lights reached before and reach after each change of it.
	const FLightJournal& GetJournal() const { return Journal; }
	/// By how much lights brought more or less with each change.
	const FLightChanges& GetStrengthChanges() const { return Strengths; }
	TGpuTable<FLightData>& GetTable() { return Table; }
	const TGpuTable<FLightData>& GetTable() const { return Table; }

private:
	TSlots<FSceneLight> Slots;
	void Count(const FSceneLight& Light, uint32_t Times);
	FLightData Pack(const FSceneLight& Light) const;
	FLightData PackMoved(const FSceneLight& Before, const FSceneLight& Light, FLightData Packed, const FLightReach& Reach) const;
	void NoteStrength(uint32_t Slot, const FSceneLight& Before, const FSceneLight& After);
	uint32_t Extended = 0, Finite = 0, InFog = 0, Profiled = 0, OffChannel = 0;
	std::array<uint32_t, size_t(ELightKind::Count)> Casters{};
	uint32_t CastingKinds = ~0u;
	uint64_t Changes = 0;
	FLightJournal Journal;
	FLightChanges Strengths;
	TGpuTable<FLightData> Table{"Lights"};
};

} // namespace Lantern
