// Styles of objects, by slots that shaders look up by object or by an engine's number.
#include "LanternScene/Scene/ToonStyles.h"

namespace Lantern
{

namespace
{
FToonData ToData(uint32_t Object, const FToonStyle& Style)
{
	FToonData Data{};
	Data.Center = Style.Center;
	Data.Object = Object;
	Data.SphereWeight = Style.SphereWeight;
	Data.Bend = Style.Bend;
	Data.MaxSaturation = Style.MaxSaturation;
	Data.MaxValue = Style.MaxValue;
	Data.Occlusion = Style.Occlusion;
	Data.Tint = Style.Tint;
	return Data;
}
} // namespace

void FToonStyles::Set(uint32_t Object, const FToonStyle* Style, uint32_t SlotCount)
{
	const auto Found = OfObject.find(Object);
	if (!Style)
	{
		if (Found != OfObject.end()) { Drop(Object); }
		return Cover(SlotCount);
	}
	const bool bNew = Found == OfObject.end();
	const uint32_t Slot = bNew ? Styles.Take(TSlots<FToonStyle>::None) : Found->second;
	if (!bNew && Styles[Slot] == *Style) { return GiveNumber(Slot, Style->Number); } // engines may set all styles in each frame
	Take(Object, Slot, *Style);
	Cover(SlotCount);
}

/// Shaders look up any object once there is a style.
void FToonStyles::Cover(uint32_t SlotCount)
{
	if (!OfObject.empty() && ObjectTable.Num() < SlotCount) { ObjectTable.Set(SlotCount - 1, 0); }
}

void FToonStyles::Take(uint32_t Object, uint32_t Slot, const FToonStyle& Style)
{
	OfObject[Object] = Slot;
	Occluded += (Style.Occlusion > 0.0f ? 1u : 0u) - (Styles[Slot].Occlusion > 0.0f ? 1u : 0u);
	if (Styles[Slot].Number != Style.Number) { LoseNumber(Slot); }
	Styles[Slot] = Style;
	StyleTable.Set(Slot, ToData(Object, Style));
	ObjectTable.Set(Object, Slot + 1);
	GiveNumber(Slot, Style.Number);
}

void FToonStyles::Drop(uint32_t Object)
{
	const uint32_t Slot = OfObject[Object];
	LoseNumber(Slot);
	Occluded -= Styles[Slot].Occlusion > 0.0f ? 1u : 0u;
	ObjectTable.Set(Object, 0);
	Styles.Free(Slot);
	StyleTable.Truncate(Styles.Num());
	OfObject.erase(Object);
}

/// The table begins with the first number.
void FToonStyles::WriteNumber(uint8_t Number)
{
	if (NumberTable.Num() == 0) { NumberTable.Set(static_cast<uint32_t>(Holders.size()) - 1, 0); }
	NumberTable.Set(Number, Holders[Number].empty() ? 0 : Holders[Number].back() + 1);
}

void FToonStyles::GiveNumber(uint32_t Slot, uint8_t Number)
{
	std::vector<uint32_t>& Of = Holders[Number];
	if (Number == 0 || (!Of.empty() && Of.back() == Slot)) { return; }
	std::erase(Of, Slot);
	Of.push_back(Slot);
	WriteNumber(Number);
}

void FToonStyles::LoseNumber(uint32_t Slot)
{
	const uint8_t Number = Styles[Slot].Number;
	if (Number == 0) { return; }
	std::erase(Holders[Number], Slot);
	WriteNumber(Number);
}

void FToonStyles::FillConstants(FSceneConstants& Out) const
{
	if (OfObject.empty()) { return; }
	Out.ToonStyles = StyleTable.GetAddress();
	Out.ObjectToons = ObjectTable.GetAddress();
	Out.ToonNumbers = NumberTable.GetAddress();
}

} // namespace Lantern
