// FSectionTable: ranges shared by geometry and material set.
#include <map>
#include <random>

#include "SceneTestTools.h"

namespace Lantern
{
namespace
{

class FSectionTableTest : public FSceneTest
{
protected:
	uint32_t Acquire(const FRTGeometryRef& Geometry, const std::vector<uint32_t>& Materials)
	{
		return Table.Acquire(Geometry.get(), Materials,
		                     [&](uint32_t Section)
		                     {
			                     ++Filled;
			                     FSectionData Data{};
			                     Data.Positions = reinterpret_cast<uintptr_t>(Geometry.get());
			                     Data.Material = Materials[Section];
			                     Data.Flags = Section;
			                     return Data;
		                     });
	}
	FSectionTable Table;
	uint32_t Filled = 0;
};

TEST_F(FSectionTableTest, SameGeometryAndMaterialsShareARange)
{
	const FRTGeometryRef Tree = MakeGeometry("Tree", 3);
	const uint32_t First = Acquire(Tree, {1, 2, 3});
	for (int I = 0; I < 1000; ++I)
	{
		EXPECT_EQ(Acquire(Tree, {1, 2, 3}), First);
	}
	EXPECT_EQ(Table.GetCapacity(), 3u);
	EXPECT_EQ(Table.GetRangeCount(), 1u);
	EXPECT_EQ(Filled, 3u);
	EXPECT_NE(Acquire(Tree, {1, 2, 4}), First);
	EXPECT_NE(Acquire(MakeGeometry("Bush", 3), {1, 2, 3}), First);
	EXPECT_EQ(Table.GetRangeCount(), 3u);
}

TEST_F(FSectionTableTest, RangeLivesUntilItsLastReference)
{
	const FRTGeometryRef Tree = MakeGeometry("Tree", 2);
	const uint32_t First = Acquire(Tree, {0, 1});
	Acquire(Tree, {0, 1});
	Table.Release(Tree.get(), {0, 1});
	EXPECT_EQ(Table.GetRangeCount(), 1u);
	EXPECT_NE(Acquire(Tree, {5, 5}), First) << "a range in use was given away";
	Table.Release(Tree.get(), {0, 1});
	EXPECT_EQ(Acquire(Tree, {6, 6}), First) << "a free range was not used again";
}

TEST_F(FSectionTableTest, NeighboursThatAreFreeBecomeOneRange)
{
	const FRTGeometryRef One = MakeGeometry("One", 1), Three = MakeGeometry("Three", 3);
	for (uint32_t Material = 0; Material < 4; ++Material)
	{
		EXPECT_EQ(Acquire(One, {Material}), Material);
	}
	// In an order that merges with the one before, the one behind, and both.
	Table.Release(One.get(), {0});
	Table.Release(One.get(), {2});
	EXPECT_EQ(Acquire(Three, {9, 9, 9}), 4u) << "two single holes are no range of three";
	Table.Release(One.get(), {1});
	EXPECT_EQ(Acquire(Three, {7, 7, 7}), 0u);
	EXPECT_EQ(Table.GetCapacity(), 7u);
}

TEST_F(FSectionTableTest, ChangesAreReportedOnceAndOnlyOnce)
{
	const FRTGeometryRef Tree = MakeGeometry("Tree", 2);
	Acquire(Tree, {0, 1});
	Acquire(Tree, {0, 1});
	EXPECT_EQ(Table.TakeChanged(), (std::vector<uint32_t>{0, 1}));
	EXPECT_TRUE(Table.TakeChanged().empty());
	const auto Update = [](uint32_t Flags)
	{
		return [=](const FRTGeometry&, uint32_t Section, uint32_t, FSectionData Data)
		{
			Data.Flags = Section == 1 ? Flags : Data.Flags;
			return Data;
		};
	};
	Table.ForEach(Update(1));
	EXPECT_TRUE(Table.TakeChanged().empty()) << "nothing was different";
	// Nobody takes the changes for a long time: the list must not grow with every write.
	for (uint32_t Flags = 100; Flags < 1100; ++Flags)
	{
		Table.ForEach(Update(Flags));
	}
	EXPECT_EQ(Table.TakeChanged(), (std::vector<uint32_t>{1}));
	EXPECT_EQ(Table.Get(1).Flags, 1099u);
}

/// Every section is a cell, taken or free: the lowest run of free cells that is long enough, else the end.
class FBruteForceSections
{
public:
	uint32_t Allocate(uint32_t Count)
	{
		uint32_t Run = 0;
		for (uint32_t Cell = 0; Cell < Taken.size(); ++Cell)
		{
			Run = Taken[Cell] ? 0 : Run + 1;
			if (Run == Count)
			{
				return Mark(Cell + 1 - Count, Count, true);
			}
		}
		return Mark(static_cast<uint32_t>(Taken.size()), Count, true);
	}
	uint32_t Mark(uint32_t First, uint32_t Count, bool bTaken)
	{
		Taken.resize(std::max<size_t>(Taken.size(), First + Count), false);
		for (uint32_t Cell = First; Cell < First + Count; ++Cell)
		{
			EXPECT_NE(Taken[Cell], bTaken);
			Taken[Cell] = bTaken;
		}
		return First;
	}
	std::vector<bool> Taken;
};

TEST_F(FSectionTableTest, AgreesWithBruteForceOverRandomSteps)
{
	struct FModelRange
	{
		uint32_t First = 0, References = 0;
	};
	std::vector<FRTGeometryRef> Geometries;
	for (uint32_t Sections : {1u, 1u, 2u, 3u, 5u, 8u})
	{
		Geometries.push_back(MakeGeometry("G" + std::to_string(Geometries.size()), Sections));
	}
	std::map<std::pair<uint32_t, std::vector<uint32_t>>, FModelRange> Model;
	FBruteForceSections Cells;
	std::mt19937 Random(1);
	const auto Below = [&](size_t Count) { return static_cast<uint32_t>(Random() % Count); };
	for (int Step = 0; Step < 20'000; ++Step)
	{
		// Waves, so that the table grows and empties many times.
		const uint32_t PercentAdd = Step / 500 % 2 ? 35 : 65;
		if (Model.empty() || Below(100) < PercentAdd)
		{
			const uint32_t Geometry = Below(Geometries.size());
			const uint32_t Count = Geometries[Geometry]->GetSectionCount();
			std::vector<uint32_t> Materials(Count);
			for (uint32_t& Material : Materials)
			{
				Material = Below(3);
			}
			FModelRange& Range = Model[{Geometry, Materials}];
			if (Range.References++ == 0)
			{
				Range.First = Cells.Allocate(Count);
			}
			ASSERT_EQ(Acquire(Geometries[Geometry], Materials), Range.First) << "step " << Step;
		}
		else
		{
			const auto It = std::next(Model.begin(), Below(Model.size()));
			const FRTGeometryRef& Geometry = Geometries[It->first.first];
			Table.Release(Geometry.get(), It->first.second);
			if (--It->second.References == 0)
			{
				Cells.Mark(It->second.First, Geometry->GetSectionCount(), false);
				Model.erase(It);
			}
		}
		ASSERT_EQ(Table.GetCapacity(), Cells.Taken.size());
		ASSERT_EQ(Table.GetRangeCount(), Model.size());
		if (Step % 100 != 0)
		{
			continue;
		}
		for (const auto& [Key, Range] : Model)
		{
			for (uint32_t Section = 0; Section < Key.second.size(); ++Section)
			{
				const FSectionData& Data = Table.Get(Range.First + Section);
				ASSERT_EQ(Data.Positions, reinterpret_cast<uintptr_t>(Geometries[Key.first].get()));
				ASSERT_EQ(Data.Material, Key.second[Section]);
				ASSERT_EQ(Data.Flags, Section);
			}
		}
	}
}

} // namespace
} // namespace Lantern
