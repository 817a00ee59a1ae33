// FSceneMaterials: indices, and which changes reach the sections and the emissive triangles.
#include "ScenePartsTestTools.h"

namespace Lantern
{
namespace
{

class FSceneMaterialsTest : public FScenePartsTest
{
protected:
	FSectionTable& Sections() { return Materials.GetSections(); }
	/// A range of one section that alpha tests may run on.
	FSectionRangeId Acquire(uint32_t Material)
	{
		Geometry = Create(1, {.bOpaque = false});
		return Sections().Acquire(*Geometry, {Material});
	}
	FHitProgram GetProgram(FSectionRangeId Range) { return Sections().GetHitProgram(Sections().GetRange(Range).First); }
	FRTGeometryRef Geometry;
	FChangeCursor Seen = 0;
};

TEST_F(FSceneMaterialsTest, IndexOfARemovedMaterialIsUsedAgain)
{
	const uint32_t First = Materials.Add(MakeMaterial(), 3);
	const uint32_t Second = Materials.Add(MakeMaterial());
	EXPECT_NE(First, Second);
	Materials.Remove(First);
	EXPECT_EQ(Materials.Add(MakeMaterial(MATERIAL_DOUBLE_SIDED), 5), First);
	EXPECT_EQ(Materials.GetProgram(First), 5u);
	EXPECT_EQ(Materials.GetTable()[First].Flags, MATERIAL_DOUBLE_SIDED);
	EXPECT_EQ(Materials.GetTable().Num(), 2u);
}

TEST_F(FSceneMaterialsTest, OnlyWhatSectionsDependOnReachesThem)
{
	const uint32_t Material = Materials.Add(MakeMaterial());
	const FSectionRangeId Range = Acquire(Material);
	Sections().TakeChanged(Seen);
	FMaterialData Rough = MakeMaterial();
	Rough.Roughness = 0.5f;
	Materials.Set(Material, Rough);
	EXPECT_EQ(Materials.GetTable()[Material].Roughness, 0.5f);
	EXPECT_FALSE(Sections().HasChanged(Seen));
	Materials.Set(Material, MakeMaterial(MATERIAL_DOUBLE_SIDED));
	EXPECT_TRUE(Sections().HasChanged(Seen));
	EXPECT_TRUE(Sections().GetRange(Range).bDoubleSided);
}

TEST_F(FSceneMaterialsTest, ProgramOfAMaterialIsThatOfItsSections)
{
	const uint32_t Material = Materials.Add(MakeMaterial(), 2);
	const FSectionRangeId Range = Acquire(Material);
	EXPECT_EQ(GetProgram(Range).Program, 2u);
	Materials.SetProgram(Material, 7);
	EXPECT_EQ(Materials.GetProgram(Material), 7u);
	EXPECT_EQ(GetProgram(Range).Program, 7u);
	Sections().TakeChanged(Seen);
	Materials.SetProgram(Material, 7);
	EXPECT_FALSE(Sections().HasChanged(Seen)) << "the program did not change";
}

TEST_F(FSceneMaterialsTest, AlphaTestsCanBeSwitchedOffForAll)
{
	const FSectionRangeId Range = Acquire(Materials.Add(MakeMaterial(MATERIAL_MASKED)));
	EXPECT_EQ(GetProgram(Range).Class, ERTHitClass::Masked);
	Materials.SetAlphaTest(false);
	EXPECT_EQ(GetProgram(Range).Class, ERTHitClass::Opaque);
	Materials.SetAlphaTest(true);
	EXPECT_EQ(GetProgram(Range).Class, ERTHitClass::Masked);
	Materials.SetOverride(2);
	EXPECT_EQ(GetProgram(Range).Class, ERTHitClass::Opaque) << "an override of 2 tests no alpha";
	Materials.SetOverride(1);
	EXPECT_EQ(GetProgram(Range).Class, ERTHitClass::Masked);
	EXPECT_EQ(Materials.GetContext().Override, 1u);
}

TEST_F(FSceneMaterialsTest, EmissionThatChangesMarksTheEmissiveTriangles)
{
	const uint32_t Material = Materials.Add(MakeMaterial(0, 1.0f));
	UpdateEmissive();
	FMaterialData Green = MakeMaterial(0, 1.0f);
	Green.BaseColor = glm::vec4(0, 1, 0, 1);
	Materials.Set(Material, Green);
	EXPECT_FALSE(Emissive.NeedsUpdate());
	Materials.Set(Material, MakeMaterial(0, 2.0f));
	EXPECT_TRUE(Emissive.NeedsUpdate());
	UpdateEmissive();
	Materials.Set(Material, MakeMaterial(MATERIAL_DOUBLE_SIDED, 2.0f));
	EXPECT_TRUE(Emissive.NeedsUpdate()) << "clusters know to which side they shine";
}

} // namespace
} // namespace Lantern
