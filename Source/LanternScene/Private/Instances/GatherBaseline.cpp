// The plain gather, a baseline: every object is tested and written by itself.
#include "LanternScene/Instances/GatherBaseline.h"

#include <cstring>

namespace Lantern
{

uint32_t GatherStraightforward(const FInstanceStore& Store, const FObjectData* Objects, const FCullingRule& Rule, const glm::dvec3& Origin,
    FRTInstance* Out, const FMissingGeometrySink& Missing)
{
	const std::vector<FInstanceRecord>& Records = Store.GetRecords();
	uint32_t Written = 0;
	for (uint32_t Index = 0; Index < Records.size(); ++Index)
	{
		const FInstanceRecord& Record = Records[Index];
		if (!Record.bAlive) { continue; }
		const FInstanceGroup& Group = Store.GetGroups()[Record.Group];
		const uint8_t Bits = Record.Group > 0 ? Rule.Test(Group.Center, Group.Radius) : Rule.Test(Record.Center, Record.Radius);
		const uint8_t Mask = Record.Mask & Bits;
		if (Mask == 0) { continue; }
		const FInstanceBinding& Binding = Store.GetBinding(Record.Range);
		if (Binding.GeometryAddress == 0)
		{
			if (Missing && Binding.GeometrySlot != ~0u) { Missing(Binding.GeometrySlot, Rule.ScreenSize(Record.Center, Record.Radius)); }
			continue;
		}
		FRTInstance& Instance = Out[Written++];
		static_assert(sizeof(Instance.Transform) == sizeof(FObjectData::ObjectToWorld));
		std::memcpy(Instance.Transform, Objects[Index].ObjectToWorld, sizeof(Instance.Transform));
		const glm::vec3 Offset = CellOffset(Objects[Index].Cell, Origin);
		for (int Row = 0; Row < 3; ++Row) { Instance.Transform[4 * Row + 3] += Offset[Row]; }
		Instance.CustomIndexAndMask = Index | (uint32_t(Mask) << 24);
		Instance.TableOffsetAndFlags = Binding.TableOffsetAndFlags;
		Instance.GeometryAddress = Binding.GeometryAddress;
	}
	return Written;
}

} // namespace Lantern
