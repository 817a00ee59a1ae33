// FSceneUpdate: facts, the origin, and which tables a frame records.
#include "Scene/SceneUpdate.h"
#include "ScenePartsTestTools.h"

namespace Lantern
{
namespace
{

class FSceneUpdateTest : public FScenePartsTest
{
protected:
	void SetUp() override
	{
		FScenePartsTest::SetUp();
		NoRays.bRays = false;
		Updater = std::make_unique<FSceneUpdate>(FSceneParts{*Device, *Geometries, Materials, Objects, Lights, Emissive});
	}
	/// A frame without rays. Returns the bytes that it copied to tables.
	uint64_t RunFrame(glm::dvec3 Camera = {}, bool bSubmit = true)
	{
		TRTRef<IRTCommandList> List;
		EXPECT_TRUE(Device->CreateCommandList("Frame", List.ReleaseAndGetAddress()));
		EXPECT_TRUE(List->Begin());
		EXPECT_TRUE(Updater->Begin(Camera, NoRays));
		EXPECT_FALSE(Updater->NeedsStructures());
		EXPECT_TRUE(Updater->RecordTables(*List, *Uploads));
		EXPECT_FALSE(Updater->AreTablesDirty());
		EXPECT_TRUE(List->End());
		FRTFence Fence = 0;
		IRTCommandList* const Lists[] = {List.Get()};
		if (bSubmit) { EXPECT_TRUE(Device->Submit(Lists, 1, &Fence)); }
		Uploads->EndFrame(Fence);
		Updater->EndFrame(bSubmit, Fence);
		return Updater->GetStats().BytesCopied;
	}
	FSceneUse NoRays;
	std::unique_ptr<FSceneUpdate> Updater;
};

TEST_F(FSceneUpdateTest, FactsFollowTheParts)
{
	EXPECT_EQ(Updater->RefreshFacts(), FSceneFacts{});
	const uint32_t Leaf = Materials.Add(MakeMaterial(MATERIAL_MASKED)), Lamp = Materials.Add(MakeMaterial(0, 1.0f));
	const FRTGeometryRef Tree = Create(1, {.bOpaque = false});
	Place(Tree, {Leaf});
	const FRTObjectId Bulb = Place(Tree, {Lamp});
	FSceneFacts Expected;
	Expected.Objects = 2;
	Expected.bMasked = Expected.bEmissive = true;
	EXPECT_EQ(Updater->RefreshFacts(), Expected);
	Materials.SetProgram(Leaf, 4);
	Expected.bOwnShapes = true; // an alpha test that only the program knows
	EXPECT_EQ(Updater->RefreshFacts(), Expected);
	Objects.Remove(Bulb);
	Expected.Objects = 1;
	Expected.bEmissive = false;
	EXPECT_EQ(Updater->RefreshFacts(), Expected);
}

TEST_F(FSceneUpdateTest, FactsOfLightsAreThereAtOnce)
{
	FSunLight Sun;
	Sun.Irradiance = 1.0f;
	Lights.SetSun(Sun);
	Lights.SetSky({1, 1, 1});
	for (int I = 0; I < 3; ++I) { Lights.GetStore().Add({}); }
	EXPECT_FALSE(Updater->GetFacts().bSun);
	Updater->RefreshLightFacts();
	EXPECT_TRUE(Updater->GetFacts().bSun);
	EXPECT_TRUE(Updater->GetFacts().bSky);
	EXPECT_EQ(Updater->GetFacts().Lights, 3u);
}

TEST_F(FSceneUpdateTest, TablesTravelOnceWithoutRays)
{
	Place(Create(1), {Materials.Add(MakeMaterial())});
	EXPECT_TRUE(Updater->NeedsUpdate({}, NoRays));
	EXPECT_EQ(RunFrame(), sizeof(FMaterialData) + sizeof(FObjectData) + sizeof(FSectionData));
	EXPECT_FALSE(Updater->NeedsUpdate({}, NoRays));
	EXPECT_EQ(RunFrame(), 0u);
	EXPECT_EQ(Updater->GetStructure().Get(), nullptr);
	EXPECT_TRUE(Updater->NeedsUpdate({}, {})) << "rays need acceleration structures";
}

TEST_F(FSceneUpdateTest, TablesOfAFrameThatNeverRanTravelAgain)
{
	Place(Create(1), {Materials.Add(MakeMaterial())});
	const uint64_t Bytes = RunFrame({}, false);
	EXPECT_TRUE(Updater->AreTablesDirty());
	EXPECT_EQ(RunFrame(), Bytes);
	EXPECT_EQ(RunFrame(), 0u);
}

TEST_F(FSceneUpdateTest, OriginFollowsTheCameraInSteps)
{
	FSceneLight Light{};
	Light.Position = {130, 0, 0};
	Lights.GetStore().Add(Light);
	RunFrame();
	EXPECT_FALSE(Updater->NeedsUpdate(glm::dvec3(48, 0, 0), NoRays));
	RunFrame({48, 0, 0});
	EXPECT_EQ(Updater->GetOrigin(), glm::dvec3(0));
	EXPECT_TRUE(Updater->NeedsUpdate(glm::dvec3(100, 0, 0), NoRays));
	EXPECT_EQ(RunFrame({100, 0, 0}), 0u) << "no table is relative to the origin";
	EXPECT_EQ(Updater->GetOrigin(), glm::dvec3(128, 0, 0));
}

} // namespace
} // namespace Lantern
