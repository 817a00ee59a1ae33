// FLightProfiles: numbers, and places in the table of texels.
#include "LanternScene/Lights/LightProfiles.h"

#include <cassert>

#include "LanternCore/Text/Log.h"

namespace Lantern
{

uint32_t FLightProfiles::Add(const FProfileGrid& Grid)
{
	assert(Grid.Rows > 0 && Grid.Texels.size() == size_t(Grid.Rows) * Grid.Columns);
	uint32_t Slot = Slots.Take(LIGHT_PROFILES_MOST);
	if (Slot == TSlots<FRange>::None)
	{
		FreeBefore(~0ull);
		Slot = Slots.Take(LIGHT_PROFILES_MOST);
	}
	if (Slot == TSlots<FRange>::None)
	{
		LogOnce(ERTLogLevel::Error, "the scene has 65,535 profiles of lights; further lights shine without theirs");
		return 0;
	}
	FRange& Range = Slots[Slot];
	Range.Count = static_cast<uint32_t>((Grid.Texels.size() + 1) / 2);
	Range.First = Words.Allocate(Range.Count);
	for (uint32_t Word = 0; Word < Range.Count; ++Word)
	{
		const size_t Low = 2 * size_t(Word);
		const uint32_t High = Low + 1 < Grid.Texels.size() ? Grid.Texels[Low + 1] : 0u;
		Texels.Set(Range.First + Word, Grid.Texels[Low] | (High << 16));
	}
	Headers.Set(Slot, {2 * Range.First, Grid.Rows, Grid.Columns, Grid.FirstAngle, Grid.RowsPerDegree, Grid.ColumnsPerDegree});
	return Slot + 1;
}

void FLightProfiles::Remove(uint32_t Number)
{
	assert(Slots.IsAlive(Number - 1));
	Retired.push_back({Number - 1, Frames});
}

void FLightProfiles::FreeBefore(uint64_t Frame)
{
	for (; !Retired.empty() && Retired.front().Frame < Frame; Retired.pop_front())
	{
		const uint32_t Slot = Retired.front().Slot;
		Words.Free(Slots[Slot].First, Slots[Slot].Count);
		Slots.Free(Slot);
		Headers.Set(Slot, FLightProfile{}); // it shines nowhere
	}
}

void FLightProfiles::EndFrame(bool bSubmitted)
{
	if (!bSubmitted) { return; }
	++Frames;
	if (Frames >= KeptFrames) { FreeBefore(Frames - KeptFrames + 1); }
}

} // namespace Lantern
