// For the tests of gathering: a store beside the table that the straightforward loop reads, and sets of instances.
#pragma once

#include <algorithm>
#include <cstring>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "LanternScene/Instances/GatherBaseline.h"

namespace Lantern
{

/// An array of FRTInstance, aligned as mapped memory is.
class FInstanceArray
{
public:
	explicit FInstanceArray(size_t Count) : Storage(Count + 1) {}
	FRTInstance* Get() { return Storage.data()->Items; }

private:
	struct alignas(64) FItem
	{
		FRTInstance Items[1];
	};
	std::vector<FItem> Storage;
};

inline std::vector<FRTInstance> SortByObject(const FRTInstance* First, uint32_t Count)
{
	std::vector<FRTInstance> Out(First, First + Count);
	std::sort(Out.begin(), Out.end(),
	    [](const FRTInstance& A, const FRTInstance& B) { return (A.CustomIndexAndMask & 0xffffff) < (B.CustomIndexAndMask & 0xffffff); });
	return Out;
}

class FGatherWorld
{
public:
	void Set(uint32_t Object, const FInstancePlacement& Placement)
	{
		Store.Set(Object, Placement);
		if (Object >= Table.Num()) { Table.Resize(Object + 1); }
		FObjectData& Data = Table[Object];
		// Its own arithmetic, not the store's.
		Data.Cell = FindCell(glm::dvec3(Placement.Transform[3]));
		glm::dmat4 Relative = Placement.Transform;
		Relative[3] -= glm::dvec4(CellCenter(Data.Cell), 0.0);
		for (int Row = 0; Row < 3; ++Row)
		{
			for (int Column = 0; Column < 4; ++Column) { Data.ObjectToWorld[Row][Column] = static_cast<float>(Relative[Column][Row]); }
		}
	}
	/// Gathers both ways; the same instances with the same 64 bytes.
	void ExpectSame(const FCullingRule& Rule, const glm::dvec3& Origin)
	{
		Store.Refresh();
		const uint32_t Count = Gather.Count(Store, Rule);
		FInstanceArray Fast(Count), Plain(Store.GetCount());
		Gather.Write(Store, Origin, Fast.Get());
		const uint32_t PlainCount = GatherStraightforward(Store, Table, Rule, Origin, Plain.Get());
		ASSERT_EQ(Count, PlainCount);
		Last = SortByObject(Fast.Get(), Count);
		const std::vector<FRTInstance> Expected = SortByObject(Plain.Get(), PlainCount);
		for (uint32_t I = 0; I < Count; ++I)
		{
			ASSERT_EQ(std::memcmp(&Last[I], &Expected[I], sizeof(FRTInstance)), 0)
			    << "object " << (Expected[I].CustomIndexAndMask & 0xffffff) << ", found " << (Last[I].CustomIndexAndMask & 0xffffff)
			    << ", masks " << (Last[I].CustomIndexAndMask >> 24) << " and " << (Expected[I].CustomIndexAndMask >> 24);
		}
	}

	FInstanceStore Store;
	FInstanceGather Gather;
	TPagedArray<FObjectData> Table;
	std::vector<FRTInstance> Last; ///< of the last ExpectSame, by object
};

inline FInstancePlacement PlaceAt(const glm::dvec3& At, double Radius, uint32_t Range = 0)
{
	FInstancePlacement Placement;
	Placement.Transform[3] = glm::dvec4(At, 1.0);
	Placement.Center = At;
	Placement.Radius = Radius;
	Placement.Range = Range;
	return Placement;
}

} // namespace Lantern
