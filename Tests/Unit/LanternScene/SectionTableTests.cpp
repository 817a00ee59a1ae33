// FSectionTable: ranges shared by geometry and material set, what they hold, and which hit programs they need.
#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "Support/SceneTestTools.h"

namespace Lantern
{
namespace
{

class FSectionTableTest : public FSceneTest
{
protected:
	void SetUp() override
	{
		FSceneTest::SetUp();
		for (int I = 0; I < 10; ++I) { Materials.Add(MakeMaterial()); }
	}
	FRTGeometryRef MakeTree(const std::string& Name, uint32_t Sections)
	{
		FGeometryOptions Options;
		Options.bOpaque = false; // alpha tests are allowed
		return MakeGeometry(Name, Sections, Options);
	}
	uint32_t Acquire(const FRTGeometryRef& Geometry, const std::vector<uint32_t>& OfSections)
	{
		return Table.Acquire(*Geometry, OfSections);
	}
	uint32_t FirstOf(FSectionRangeId Id) const { return Table.GetRange(Id).First; }
	void Edit(uint32_t Material, const FMaterialData& Data)
	{
		Materials.Set(Material, Data);
		Table.MaterialChanged(Material);
	}
	std::vector<uint32_t> TakeSorted()
	{
		std::vector<uint32_t> Changed = Table.TakeChanged(Seen);
		std::sort(Changed.begin(), Changed.end());
		return Changed;
	}

	TGpuTable<FMaterialData> Materials{"Materials"};
	std::vector<uint32_t> Programs;
	FSectionContext Context{Materials, Programs};
	FSectionTable Table{Context};
	FChangeCursor Seen = 0;
};

TEST_F(FSectionTableTest, SameGeometryAndMaterialsShareARange)
{
	const FRTGeometryRef Tree = MakeTree("Tree", 3);
	const FSectionRangeId Id = Acquire(Tree, {1, 2, 3});
	for (int I = 0; I < 100'000; ++I) { ASSERT_EQ(Acquire(Tree, {1, 2, 3}), Id); }
	EXPECT_EQ(Table.GetCapacity(), 3u);
	EXPECT_EQ(Table.GetRangeCount(), 1u);
	EXPECT_EQ(Table.TakeChanged(Seen).size(), 3u) << "100,000 instances of one tree have the records of one";
	EXPECT_EQ(Table.GetRange(Id).References, 100'001u);
	EXPECT_NE(Acquire(Tree, {1, 2, 4}), Id);
	EXPECT_NE(Acquire(Tree, {2, 1, 3}), Id) << "the order of materials matters";
	const FRTGeometryRef Bush = MakeTree("Bush", 3);
	EXPECT_NE(Acquire(Bush, {1, 2, 3}), Id);
	EXPECT_EQ(Table.GetRangeCount(), 4u);
}

TEST_F(FSectionTableTest, RangeLivesUntilItsLastReference)
{
	const FRTGeometryRef Tree = MakeTree("Tree", 2);
	const FSectionRangeId Id = Acquire(Tree, {0, 1});
	const uint32_t First = FirstOf(Id);
	Acquire(Tree, {0, 1});
	Table.Release(Id);
	EXPECT_EQ(Table.GetRangeCount(), 1u);
	EXPECT_NE(FirstOf(Acquire(Tree, {5, 5})), First) << "a range in use was given away";
	Table.Release(Id);
	EXPECT_EQ(FirstOf(Acquire(Tree, {6, 6})), First) << "a free range was not used again";
}

TEST_F(FSectionTableTest, RangesAreFoundHoweverManyThereAre)
{
	const FRTGeometryRef Tree = MakeTree("Tree", 4);
	std::map<std::vector<uint32_t>, FSectionRangeId> Ids;
	for (uint32_t I = 0; I < 10'000; ++I)
	{
		const std::vector<uint32_t> Set = {I % 10, I / 10 % 10, I / 100 % 10, I / 1000};
		Ids[Set] = Acquire(Tree, Set);
	}
	EXPECT_EQ(Table.GetRangeCount(), 10'000u);
	for (const auto& [Set, Id] : Ids)
	{
		ASSERT_EQ(Acquire(Tree, Set), Id);
		ASSERT_EQ(Table.GetRange(Id).Materials, Set);
	}
}

TEST_F(FSectionTableTest, ChangesAreReportedOnceAndOnlyOnce)
{
	const FRTGeometryRef Tree = MakeTree("Tree", 2);
	const FSectionRangeId Id = Acquire(Tree, {0, 1});
	Acquire(Tree, {0, 1});
	EXPECT_EQ(TakeSorted(), (std::vector<uint32_t>{0, 1}));
	EXPECT_EQ(Table.TakeChangedRanges(), (std::vector<FSectionRangeId>{Id}));
	EXPECT_FALSE(Table.HasChanged(Seen));
	EXPECT_TRUE(Table.TakeChanged(Seen).empty());
	EXPECT_TRUE(Table.TakeChangedRanges().empty());
	Edit(0, MakeMaterial());
	Table.RefillAll();
	EXPECT_FALSE(Table.HasChanged(Seen)) << "nothing was different";
	// Nobody takes the changes for a long time: the list must not grow with every write.
	for (uint32_t I = 0; I < 1001; ++I) { Edit(1, MakeMaterial(I % 2 ? 0 : MATERIAL_MASKED)); }
	EXPECT_EQ(Table.TakeChanged(Seen), (std::vector<uint32_t>{1}));
	EXPECT_EQ(Table.TakeChangedRanges(), (std::vector<FSectionRangeId>{Id}));
	EXPECT_TRUE(Table.GetRange(Id).bMasked);
}

TEST_F(FSectionTableTest, RangeThatComesBackIsWrittenAgain)
{
	const FRTGeometryRef Tree = MakeTree("Tree", 1);
	Table.TakeChanged(Seen);
	const FSectionRangeId Id = Acquire(Tree, {0});
	Table.TakeChanged(Seen);
	Table.Release(Id);
	// Whoever keeps records may have pointed the free one elsewhere.
	Acquire(Tree, {0});
	EXPECT_EQ(Table.TakeChanged(Seen), (std::vector<uint32_t>{0}));
}

TEST_F(FSectionTableTest, MaterialReachesOnlyTheSectionsThatUseIt)
{
	const FRTGeometryRef Tree = MakeTree("Tree", 2), Bush = MakeTree("Bush", 3);
	const FSectionRangeId First = Acquire(Tree, {0, 1}), Second = Acquire(Bush, {2, 1, 1}), Third = Acquire(Tree, {3, 3});
	Table.TakeChanged(Seen);
	Table.TakeChangedRanges();
	Edit(1, MakeMaterial(MATERIAL_MASKED));
	EXPECT_EQ(TakeSorted(), (std::vector<uint32_t>{FirstOf(First) + 1, FirstOf(Second) + 1, FirstOf(Second) + 2}));
	EXPECT_EQ(Table.GetMaskedRangeCount(), 2u);
	EXPECT_FALSE(Table.GetRange(Third).bMasked);
	Table.Release(First);
	EXPECT_EQ(Table.GetMaskedRangeCount(), 1u);
	Edit(1, MakeMaterial(MATERIAL_DOUBLE_SIDED));
	EXPECT_EQ(TakeSorted(), (std::vector<uint32_t>{FirstOf(Second) + 1, FirstOf(Second) + 2}));
	EXPECT_EQ(Table.GetMaskedRangeCount(), 0u);
	EXPECT_FALSE(Table.GetRange(Second).bDoubleSided) << "one material of three is not";
	Edit(3, MakeMaterial(MATERIAL_DOUBLE_SIDED, 2.0f));
	EXPECT_TRUE(Table.GetRange(Third).bDoubleSided);
	EXPECT_EQ(Table.GetEmissiveRangeCount(), 1u);
}

TEST_F(FSectionTableTest, AnimatedColourAffectsNoSection)
{
	FMaterialData Old = MakeMaterial(), New = Old;
	New.BaseColor = glm::vec4(0.5f, 0.5f, 0.5f, Old.BaseColor.a);
	New.Roughness = 0.1f;
	EXPECT_FALSE(FSectionTable::AffectsSections(Old, New));
	New.UVOffset[TEXTURE_BASE_COLOR].x = 1.0f;
	EXPECT_TRUE(FSectionTable::AffectsSections(Old, New));
}

TEST_F(FSectionTableTest, HitProgramsInUseAreCounted)
{
	using EClass = ERTHitClass;
	Programs = {0, 0, 7, 7};
	const FRTGeometryRef Tree = MakeTree("Tree", 2);
	EXPECT_TRUE(Table.GetHitPrograms().empty());
	const FSectionRangeId Id = Acquire(Tree, {0, 2});
	EXPECT_EQ(Table.GetHitPrograms(), (std::vector<FHitProgram>{{0, EClass::Opaque}, {7, EClass::Opaque}}));
	EXPECT_EQ(Table.GetHitProgram(FirstOf(Id) + 1), (FHitProgram{7, EClass::Opaque}));
	const FSectionRangeId Other = Acquire(Tree, {1, 3});
	Table.Release(Id);
	EXPECT_EQ(Table.GetHitPrograms(), (std::vector<FHitProgram>{{0, EClass::Opaque}, {7, EClass::Opaque}})) << "others use them";
	Edit(3, MakeMaterial(MATERIAL_MASKED));
	EXPECT_EQ(Table.GetHitPrograms(), (std::vector<FHitProgram>{{0, EClass::Opaque}, {7, EClass::Masked}}));
	Programs[3] = 9;
	Table.MaterialChanged(3);
	EXPECT_EQ(Table.GetHitProgram(FirstOf(Other) + 1), (FHitProgram{9, EClass::Masked}));
	Table.Release(Other);
	EXPECT_TRUE(Table.GetHitPrograms().empty());
}

TEST_F(FSectionTableTest, AlphaTestsOffMakeEverythingOpaque)
{
	Materials.Set(0, MakeMaterial(MATERIAL_MASKED));
	const FRTGeometryRef Tree = MakeTree("Tree", 1);
	const FSectionRangeId Id = Acquire(Tree, {0});
	EXPECT_EQ(Table.GetHitProgram(FirstOf(Id)).Class, ERTHitClass::Masked);
	for (const bool bByOverride : {false, true})
	{
		Context.bAlphaTest = bByOverride;
		Context.Override = bByOverride ? 2 : 0;
		Table.RefillAll();
		EXPECT_EQ(Table.GetHitProgram(FirstOf(Id)).Class, ERTHitClass::Opaque);
		EXPECT_EQ(Table.Get(FirstOf(Id)).Flags & SECTION_MASKED, 0u);
		EXPECT_FALSE(Table.GetRange(Id).bMasked);
	}
}

/// A plain section has the shorter any-hit shader; whatever that shader leaves out takes the section to the general one.
TEST_F(FSectionTableTest, PlainAlphaTestHasAHitGroupOfItsOwn)
{
	FGeometryOptions Options;
	Options.bOpaque = false;
	Options.bOpaqueVertices = true;
	const auto GetClass = [&](FSectionRangeId Id) { return Table.GetHitProgram(FirstOf(Id)).Class; };
	FMaterialData Plain = MakeMaterial(MATERIAL_MASKED);
	Plain.UVTransform[TEXTURE_BASE_COLOR] = glm::vec4(1, 0, 0, 1);
	Edit(0, Plain);
	const FRTGeometryRef Leaf = MakeGeometry("Leaf", 1, Options);
	const FSectionRangeId Id = Acquire(Leaf, {0});
	EXPECT_EQ(GetClass(Id), ERTHitClass::MaskedPlain);
	EXPECT_NE(Table.Get(FirstOf(Id)).Flags & SECTION_MASKED, 0u);
	EXPECT_TRUE(Table.GetRange(Id).bMasked);
	FMaterialData Moved = Plain;
	Moved.UVOffset[TEXTURE_BASE_COLOR] = {0.5f, 0};
	Edit(0, Moved);
	EXPECT_EQ(GetClass(Id), ERTHitClass::Masked) << "the texture is moved";
	Programs.assign(10, 3);
	Edit(0, Plain);
	EXPECT_EQ(Table.GetHitProgram(FirstOf(Id)), (FHitProgram{3, ERTHitClass::Masked})) << "another program";
	Programs.assign(10, StandardProgram);
	Edit(0, MakeMaterial());
	EXPECT_EQ(GetClass(Id), ERTHitClass::Opaque);
	Edit(0, Plain);
	Options.bOpaqueVertices = false;
	EXPECT_EQ(GetClass(Acquire(MakeGeometry("Fading leaf", 1, Options), {0})), ERTHitClass::Masked) << "alpha of vertices";
	Options.bOpaqueVertices = true;
	Options.bStreams = true;
	EXPECT_EQ(GetClass(Acquire(MakeGeometry("Host's leaf", 1, Options), {0})), ERTHitClass::Masked) << "vertices of a host";
}

TEST_F(FSectionTableTest, ClassifiedSectionHasARecordForItsOpaqueTriangles)
{
	FGeometryOptions Options;
	Options.bOpaque = false;
	Options.TrianglesPerSection = 4;
	FRTGeometryInfo Info = MakeInfo("Leaves", 2, Options);
	Info.Sections[0].OpaqueIndexCount = 6; // triangles: mixed, opaque, opaque, transparent
	Info.Sections[0].TransparentIndexCount = 3;
	Info.Sections[1].OpaqueIndexCount = 12; // all opaque
	FRTGeometryRef Leaves;
	ASSERT_TRUE(Scene->CreateGeometry(std::move(Info), Leaves));
	Materials.Set(0, MakeMaterial(MATERIAL_MASKED));
	const FSectionRangeId Id = Acquire(Leaves, {0, 0});
	const uint32_t First = FirstOf(Id);
	ASSERT_GE(Table.GetRange(Id).Count, 3u);
	EXPECT_EQ(Table.GetHitProgram(First).Class, ERTHitClass::Masked);
	EXPECT_EQ(Table.GetHitProgram(First + 1).Class, ERTHitClass::Opaque);
	EXPECT_EQ(Table.GetHitProgram(First + 2).Class, ERTHitClass::Opaque);
	EXPECT_EQ(Table.Get(First + 2).Indices, Table.Get(First).Indices + 3 * 4);
	EXPECT_EQ(Table.Get(First + 2).Flags & SECTION_MASKED, 0u);
	EXPECT_EQ(Table.Get(First + 2).Material, 0u);
	Table.TakeChanged(Seen);
	Edit(0, MakeMaterial(MATERIAL_DOUBLE_SIDED));
	EXPECT_EQ(TakeSorted(), (std::vector<uint32_t>{First, First + 1, First + 2})) << "all parts of the material's sections";
}

TEST_F(FSectionTableTest, ProceduralSectionPointsAtItsBoxes)
{
	FRTGeometryInfo Info = MakeInfo("Spheres", 2);
	Info.Aabbs = MakeBuffer("Boxes", 240);
	Info.AabbsOffset = 24;
	Info.Sections[1] = {2, 5, true, true};
	FRTGeometryRef Spheres;
	ASSERT_TRUE(Scene->CreateGeometry(std::move(Info), Spheres));
	const uint32_t First = FirstOf(Acquire(Spheres, {0, 1}));
	EXPECT_EQ(Table.GetHitProgram(First).Class, ERTHitClass::Opaque);
	EXPECT_EQ(Table.GetHitProgram(First + 1).Class, ERTHitClass::Procedural);
	EXPECT_EQ(Table.Get(First + 1).Positions, Spheres->GetInfo().Aabbs->GetDeviceAddress() + 24 + 2 * 24);
}

/// Everything that can change, against what a table made anew would say.
class FSectionTableWalk : public FSectionTableTest
{
protected:
	uint32_t Below(size_t Count) { return static_cast<uint32_t>(Random() % Count); }
	void Step()
	{
		// Waves, so that the table grows and empties many times.
		const uint32_t Choice = Below(100), PercentAdd = Steps / 500 % 2 ? 35 : 55;
		if (References.empty() || Choice < PercentAdd)
		{
			const FRTGeometryRef& Geometry = Geometries[Below(Geometries.size())];
			std::vector<uint32_t> Set(Geometry->GetSectionCount());
			for (uint32_t& Material : Set) { Material = Below(4); }
			const FSectionRangeId Id = Acquire(Geometry, Set);
			const auto [Known, bNew] = Model.try_emplace({Geometry.get(), Set}, Id);
			ASSERT_EQ(Known->second, Id);
			References.push_back(Id);
		}
		else if (Choice < 90)
		{
			std::swap(References[Below(References.size())], References.back());
			const FSectionRangeId Id = References.back();
			References.pop_back();
			if (Table.GetRange(Id).References == 1) { Model.erase({Table.GetRange(Id).Geometry, Table.GetRange(Id).Materials}); }
			Table.Release(Id);
		}
		else
		{
			Programs.resize(4);
			const uint32_t Material = Below(4);
			Programs[Material] = Below(3);
			Edit(Material, MakeMaterial(Below(4), float(Below(2))));
		}
		++Steps;
	}
	void Check()
	{
		std::vector<uint32_t> Taken(Table.GetCapacity(), 0);
		std::set<FHitProgram> InUse;
		for (const auto& [Key, Id] : Model)
		{
			const FSectionRange& Range = Table.GetRange(Id);
			ASSERT_EQ(Range.Geometry, Key.first);
			ASSERT_EQ(Range.Materials, Key.second);
			ASSERT_EQ(Range.References, std::count(References.begin(), References.end(), Id));
			bool bMasked = false;
			for (uint32_t Section = 0; Section < Range.Count; ++Section)
			{
				const uint32_t Material = Key.second[Section], Number = Range.First + Section;
				ASSERT_EQ(Taken[Number]++, 0u) << "two ranges share section " << Number;
				const bool bOne = Materials[Material].Flags & MATERIAL_MASKED;
				bMasked |= bOne;
				const FHitProgram Program{
				    Material < Programs.size() ? Programs[Material] : 0, bOne ? ERTHitClass::Masked : ERTHitClass::Opaque};
				InUse.insert(Program);
				ASSERT_EQ(Table.GetHitProgram(Number), Program);
				ASSERT_EQ(Table.Get(Number).Material, Material);
				ASSERT_EQ((Table.Get(Number).Flags & SECTION_MASKED) != 0, bOne);
				ASSERT_EQ(Table.Get(Number).Indices, Table.Get(Range.First).Indices + 12 * Section);
			}
			ASSERT_EQ(Range.bMasked, bMasked);
		}
		ASSERT_EQ(Table.GetRangeCount(), Model.size());
		ASSERT_EQ(Table.GetHitPrograms(), std::vector<FHitProgram>(InUse.begin(), InUse.end()));
	}

	std::mt19937 Random{1};
	std::vector<FRTGeometryRef> Geometries;
	std::map<std::pair<const FRTGeometry*, std::vector<uint32_t>>, FSectionRangeId> Model;
	std::vector<FSectionRangeId> References;
	int Steps = 0;
};

TEST_F(FSectionTableWalk, AgreesWithBruteForceOverRandomSteps)
{
	for (uint32_t Sections : {1u, 1u, 2u, 3u, 5u, 8u})
	{
		Geometries.push_back(MakeTree("G" + std::to_string(Geometries.size()), Sections));
	}
	for (int I = 0; I < 20'000; ++I)
	{
		ASSERT_NO_FATAL_FAILURE(Step()) << "step " << I;
		if (I % 100 == 0) { ASSERT_NO_FATAL_FAILURE(Check()) << "step " << I; }
	}
}

} // namespace
} // namespace Lantern
