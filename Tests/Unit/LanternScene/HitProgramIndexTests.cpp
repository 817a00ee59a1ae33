// FHitProgramIndex: numbers of hit programs, counted by the sections that use them.
#include <vector>

#include <gtest/gtest.h>

#include "LanternScene/ShaderTable/HitProgramIndex.h"

namespace Lantern
{
namespace
{

constexpr FHitProgram Stone{1, ERTHitClass::Opaque}, Leaf{2, ERTHitClass::Masked}, Cloud{3, ERTHitClass::Procedural};

TEST(FHitProgramIndexTest, SectionsOfOneProgramShareANumber)
{
	FHitProgramIndex Index;
	Index.Resize(3);
	EXPECT_EQ(Index.GetIndex(0), 0u) << "no program yet";
	EXPECT_TRUE(Index.Set(0, Leaf));
	EXPECT_TRUE(Index.Set(1, Leaf));
	EXPECT_TRUE(Index.Set(2, Stone));
	EXPECT_FALSE(Index.Set(1, Leaf)) << "the section has it already";
	EXPECT_EQ(Index.GetIndex(0), Index.GetIndex(1));
	EXPECT_NE(Index.GetIndex(0), Index.GetIndex(2));
	EXPECT_EQ(Index.GetProgram(1), Leaf);
	EXPECT_EQ(Index.GetProgramAt(Index.GetIndex(2)), Stone);
	EXPECT_EQ(Index.GetCount(), 3u) << "two programs, and number 0 for none";
}

TEST(FHitProgramIndexTest, NumberOfAProgramThatNobodyUsesIsGivenAgain)
{
	FHitProgramIndex Index;
	Index.Resize(3);
	Index.Set(0, Stone);
	Index.Set(1, Leaf);
	const uint32_t Freed = Index.GetIndex(1);
	const uint64_t Revision = Index.GetIndicesRevision();
	Index.Clear(1);
	EXPECT_EQ(Index.GetIndex(1), 0u);
	EXPECT_EQ(Index.GetIndicesRevision(), Revision) << "no number means another program so far";
	Index.Set(2, Cloud);
	EXPECT_EQ(Index.GetIndex(2), Freed);
	EXPECT_EQ(Index.GetProgramAt(Freed), Cloud);
	EXPECT_NE(Index.GetIndicesRevision(), Revision);
}

TEST(FHitProgramIndexTest, ProgramsInUseAreSorted)
{
	FHitProgramIndex Index;
	Index.Resize(4);
	Index.Set(0, Cloud);
	Index.Set(1, Stone);
	Index.Set(2, Leaf);
	Index.Set(3, Leaf);
	EXPECT_EQ(Index.GetInUse(), (std::vector<FHitProgram>{Stone, Leaf, Cloud}));
	Index.Clear(3);
	EXPECT_EQ(Index.GetInUse(), (std::vector<FHitProgram>{Stone, Leaf, Cloud})) << "section 2 still uses the leaf";
	Index.Set(2, Stone);
	EXPECT_EQ(Index.GetInUse(), (std::vector<FHitProgram>{Stone, Cloud}));
}

} // namespace
} // namespace Lantern
