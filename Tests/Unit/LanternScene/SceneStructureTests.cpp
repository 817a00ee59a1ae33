// FSceneStructure: when instances are gathered, and when the acceleration structure over them is built.
#include "Scene/RangeBindings.h"
#include "Scene/SceneStructure.h"
#include "ScenePartsTestTools.h"

namespace Lantern
{
namespace
{

class FSceneStructureTest : public FScenePartsTest
{
protected:
	void SetUp() override
	{
		FScenePartsTest::SetUp();
		Structure = std::make_unique<FSceneStructure>(*Device, *Geometries, Objects);
		Material = Materials.Add(MakeMaterial());
		Tree = Create(1, {.bDynamic = true}); // never culled, for its bounds are unknown, and never compacted
	}
	/// Gathers for View, builds what is stale, and submits. Returns whether it built.
	bool Gather(const FGatherView& View, bool bCull = true, glm::dvec3 Origin = {}, bool bSubmit = true)
	{
		TRTRef<IRTCommandList> List;
		EXPECT_TRUE(Device->CreateCommandList("Frame", List.ReleaseAndGetAddress()));
		EXPECT_TRUE(List->Begin());
		EXPECT_TRUE(Geometries->BeginFrame(true));
		for (const uint32_t Slot : Geometries->TakeChanged()) { Materials.GetSections().GeometryChanged(*Geometries->Get(Slot)); }
		Bindings.Update(Materials.GetSections(), *Geometries, Objects.GetInstances());
		Objects.GetInstances().Refresh();
		Structure->StartGather(View, bCull, Origin);
		EXPECT_TRUE(Geometries->Record(*List));
		EXPECT_TRUE(Structure->FinishGather());
		EXPECT_FALSE(Structure->IsGathering());
		const bool bBuild = Structure->IsStale();
		if (bBuild) { EXPECT_TRUE(Structure->Build(*List)); }
		EXPECT_TRUE(List->End());
		FRTFence Fence = 0;
		IRTCommandList* const Lists[] = {List.Get()};
		if (bSubmit) { EXPECT_TRUE(Device->Submit(Lists, 1, &Fence)); }
		Structure->EndFrame(bSubmit, Fence);
		Geometries->EndFrame(bSubmit);
		return bBuild;
	}
	size_t CountBuilt() { return Mock().GetSceneInstances(Structure->Get()).size(); }

	FRangeBindings Bindings;
	std::unique_ptr<FSceneStructure> Structure;
	uint32_t Material = 0;
	FRTGeometryRef Tree;
};

const FGatherView Here(glm::dvec3(0)), There(glm::dvec3(5, 0, 0));

TEST_F(FSceneStructureTest, FirstGatherBuildsOverAllInstances)
{
	for (int I = 0; I < 3; ++I) { Place(Tree, {Material}, {I, 0, 0}); }
	EXPECT_TRUE(Structure->NeedsGather(Here, true, {}));
	EXPECT_EQ(Structure->Get(), nullptr);
	EXPECT_TRUE(Gather(Here));
	EXPECT_EQ(Structure->GetInstanceCount(), 3u);
	EXPECT_EQ(CountBuilt(), 3u);
}

TEST_F(FSceneStructureTest, AnEmptySceneHasAStructureToo)
{
	EXPECT_TRUE(Gather(Here));
	ASSERT_NE(Structure->Get(), nullptr);
	EXPECT_EQ(CountBuilt(), 0u);
}

TEST_F(FSceneStructureTest, NothingIsBuiltWhereNothingChanged)
{
	Place(Tree, {Material});
	Gather(Here);
	EXPECT_FALSE(Structure->NeedsGather(Here, true, {}));
	EXPECT_FALSE(Gather(Here));
	EXPECT_TRUE(Structure->NeedsGather(There, true, {})) << "culling depends on the view";
	EXPECT_FALSE(Gather(There)) << "but the instances are the same";
	EXPECT_TRUE(Structure->NeedsGather(There, true, {64, 0, 0}));
	EXPECT_TRUE(Gather(There, true, {64, 0, 0})) << "instances are relative to the origin";
}

TEST_F(FSceneStructureTest, WithoutCullingTheViewDoesNotMatter)
{
	Place(Tree, {Material});
	Gather(Here, false);
	EXPECT_FALSE(Structure->NeedsGather(There, false, {}));
	EXPECT_TRUE(Structure->NeedsGather(There, true, {}));
}

TEST_F(FSceneStructureTest, ObjectsThatComeAndGoAreGatheredAnew)
{
	const FRTObjectId Id = Place(Tree, {Material});
	Gather(Here);
	Place(Tree, {Material}, {3, 0, 0});
	EXPECT_TRUE(Structure->NeedsGather(Here, true, {}));
	EXPECT_TRUE(Gather(Here));
	EXPECT_EQ(CountBuilt(), 2u);
	Objects.Remove(Id);
	EXPECT_TRUE(Gather(Here));
	EXPECT_EQ(CountBuilt(), 1u);
}

TEST_F(FSceneStructureTest, AFrameThatNeverRanIsBuiltAgain)
{
	Place(Tree, {Material});
	EXPECT_TRUE(Gather(Here, true, {}, false));
	EXPECT_TRUE(Structure->IsStale());
	EXPECT_TRUE(Structure->NeedsGather(Here, true, {}));
	EXPECT_TRUE(Gather(Here));
	EXPECT_FALSE(Structure->IsStale());
	EXPECT_EQ(CountBuilt(), 1u);
}

} // namespace
} // namespace Lantern
