// FRangeBindings: what the instances of a section range are told, and when it is written.
#include "Scene/RangeBindings.h"
#include "ScenePartsTestTools.h"

namespace Lantern
{
namespace
{

class FRangeBindingsTest : public FScenePartsTest
{
protected:
	FSectionTable& Sections() { return Materials.GetSections(); }
	FSectionRangeId Acquire(const FRTGeometryRef& Geometry, uint32_t Flags = 0)
	{
		return Sections().Acquire(*Geometry, {Materials.Add(MakeMaterial(Flags))});
	}
	void Update()
	{
		Bindings.Update(Sections(), *Geometries, Instances);
		EXPECT_FALSE(Bindings.NeedsUpdate(Sections()));
	}
	uint32_t GetFirstRecord(FSectionRangeId Id) const { return Instances.GetBinding(Id).TableOffsetAndFlags & 0xffffffu; }
	uint32_t GetFlags(FSectionRangeId Id) const { return Instances.GetBinding(Id).TableOffsetAndFlags >> 24; }

	FRangeBindings Bindings;
	FInstanceStore Instances;
};

TEST_F(FRangeBindingsTest, AddressArrivesWithTheStructure)
{
	const FRTGeometryRef Geometry = Create(1);
	const FSectionRangeId Id = Acquire(Geometry);
	EXPECT_TRUE(Bindings.NeedsUpdate(Sections()));
	Update();
	EXPECT_EQ(Instances.GetBinding(Id).GeometryAddress, 0u);
	EXPECT_EQ(Instances.GetBinding(Id).GeometrySlot, Geometry->GetSlot());
	ASSERT_TRUE(Geometries->BeginFrame(true));
	for (const uint32_t Slot : Geometries->TakeChanged()) { Sections().GeometryChanged(*Geometries->Get(Slot)); }
	EXPECT_TRUE(Bindings.NeedsUpdate(Sections()));
	Update();
	EXPECT_NE(Instances.GetBinding(Id).GeometryAddress, 0u);
	EXPECT_EQ(Instances.GetBinding(Id).GeometryAddress, Geometries->GetAddress(Geometry->GetSlot()));
	Geometries->EndFrame(false);
}

TEST_F(FRangeBindingsTest, FirstRecordCountsRayTypes)
{
	const FRTGeometryRef Geometry = Create(1);
	const FSectionRangeId First = Acquire(Geometry), Second = Acquire(Geometry);
	ASSERT_NE(Sections().GetRange(First).First, Sections().GetRange(Second).First);
	Bindings.SetRayTypes(3);
	Update();
	EXPECT_EQ(GetFirstRecord(First), 3 * Sections().GetRange(First).First);
	EXPECT_EQ(GetFirstRecord(Second), 3 * Sections().GetRange(Second).First);
	Bindings.SetRayTypes(3);
	EXPECT_FALSE(Bindings.NeedsUpdate(Sections())) << "the number did not change";
	Bindings.SetRayTypes(2);
	EXPECT_TRUE(Bindings.NeedsUpdate(Sections()));
	Update();
	EXPECT_EQ(GetFirstRecord(Second), 2 * Sections().GetRange(Second).First);
}

TEST_F(FRangeBindingsTest, FlagsFollowTheMaterials)
{
	const FRTGeometryRef Geometry = Create(1, {.bOpaque = false});
	const FSectionRangeId Plain = Acquire(Geometry), Masked = Acquire(Geometry, MATERIAL_MASKED);
	const FSectionRangeId Leaf = Acquire(Geometry, MATERIAL_MASKED | MATERIAL_DOUBLE_SIDED);
	Update();
	EXPECT_EQ(GetFlags(Plain), static_cast<uint32_t>(InstanceForceOpaque));
	EXPECT_EQ(GetFlags(Masked), 0u);
	EXPECT_EQ(GetFlags(Leaf), static_cast<uint32_t>(InstanceCullDisable));
}

TEST_F(FRangeBindingsTest, RangesWithAMissingProgramHaveNoBinding)
{
	const FRTGeometryRef Geometry = Create(1, {.bOpaque = false});
	const FSectionRangeId Opaque = Acquire(Geometry), Masked = Acquire(Geometry, MATERIAL_MASKED);
	Update();
	Bindings.SetMissingPrograms({{7, ERTHitClass::Opaque}, {StandardProgram, ERTHitClass::Masked}});
	Update();
	EXPECT_EQ(Instances.GetBinding(Masked), FInstanceBinding{});
	EXPECT_EQ(Instances.GetBinding(Opaque).GeometrySlot, Geometry->GetSlot());
	Bindings.SetMissingPrograms({{StandardProgram, ERTHitClass::Masked}, {7, ERTHitClass::Opaque}});
	EXPECT_FALSE(Bindings.NeedsUpdate(Sections())) << "the order does not matter";
	Bindings.SetMissingPrograms({});
	Update();
	EXPECT_EQ(Instances.GetBinding(Masked).GeometrySlot, Geometry->GetSlot());
}

TEST_F(FRangeBindingsTest, RecordsThatAnInstanceCannotNameAreRefused)
{
	const FRTGeometryRef Geometry = Create(1);
	Bindings.SetRayTypes(MaxInstanceIndex + 1);
	EXPECT_TRUE(Bindings.CheckLimits(Sections())) << "there is no section";
	Acquire(Geometry);
	EXPECT_EQ(Bindings.CheckLimits(Sections()).Code, ERTResult::Unsupported);
	Bindings.SetRayTypes(MaxInstanceIndex);
	EXPECT_TRUE(Bindings.CheckLimits(Sections()));
}

} // namespace
} // namespace Lantern
