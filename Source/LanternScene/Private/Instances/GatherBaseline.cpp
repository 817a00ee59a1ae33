// The plain gather, a baseline: every object is tested and written by itself.
#include "LanternScene/Instances/GatherBaseline.h"

#include <cstring>

namespace Lantern
{

namespace
{
/// One object, whose number in the scene is Index. Returns whether it wrote an instance.
bool GatherOne(const FInstanceStore& Store, const FInstanceRecord& Record, const FObjectData& Object, uint32_t Index,
    const FCullingRule& Rule, const glm::dvec3& Origin, FRTInstance& Out, const FMissingGeometrySink& Missing)
{
	if (!Record.bAlive) { return false; }
	const FInstanceGroup& Group = Store.GetGroups()[Record.Group];
	const uint8_t Bits = Record.Group > 0 ? Rule.Test(Group.Center, Group.Radius) : Rule.Test(Record.Center, Record.Radius);
	const uint8_t Mask = Record.Mask & Bits;
	if (Mask == 0) { return false; }
	const FInstanceBinding& Binding = Store.GetBinding(Record.Range);
	if (Binding.GeometryAddress == 0)
	{
		if (Missing && Binding.GeometrySlot != ~0u) { Missing(Binding.GeometrySlot, Rule.ScreenSize(Record.Center, Record.Radius)); }
		return false;
	}
	static_assert(sizeof(Out.Transform) == sizeof(FObjectData::ObjectToWorld));
	std::memcpy(Out.Transform, Object.ObjectToWorld, sizeof(Out.Transform));
	const glm::vec3 Offset = CellOffset(Object.Cell, Origin);
	for (int Row = 0; Row < 3; ++Row) { Out.Transform[4 * Row + 3] += Offset[Row]; }
	Out.CustomIndexAndMask = (Index | (uint32_t(Mask) << 24)) & Binding.MaskBits;
	Out.TableOffsetAndFlags = Binding.TableOffsetAndFlags;
	Out.GeometryAddress = Binding.GeometryAddress;
	return true;
}
} // namespace

uint32_t GatherStraightforward(const FInstanceStore& Store, const TPagedArray<FObjectData>& Objects, const FCullingRule& Rule,
    const glm::dvec3& Origin, FRTInstance* Out, const FMissingGeometrySink& Missing)
{
	const TPagedArray<FInstanceRecord>& Records = Store.GetRecords();
	uint32_t Written = 0;
	for (size_t Page = 0; Page < Records.GetPageCount(); ++Page)
	{
		const std::span<const FInstanceRecord> Here = Records.GetPage(Page);
		const std::span<const FObjectData> Data = Objects.GetPage(Page);
		const auto First = static_cast<uint32_t>(Page * TPagedArray<FInstanceRecord>::PageEntries);
		for (uint32_t I = 0; I < Here.size(); ++I)
		{
			Written += GatherOne(Store, Here[I], Data.data()[I], First + I, Rule, Origin, Out[Written], Missing) ? 1 : 0;
		}
	}
	return Written;
}

} // namespace Lantern
