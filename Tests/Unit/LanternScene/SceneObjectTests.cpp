// FRTScene: objects, transforms, removal, builds, lights; seen from the device.
#include <cmath>
#include <functional>
#include <random>

#include "LanternCore/Config/ConsoleVariables.h"
#include "Support/SceneTestTools.h"

namespace Lantern
{
namespace
{

using FSceneObjectTest = FSceneTest;

uint32_t GetObjectIndex(const FRTMockInstance& Item) { return Item.Instance.CustomIndexAndMask & MaxInstanceIndex; }
uint32_t GetFlags(const FRTMockInstance& Item) { return Item.Instance.TableOffsetAndFlags >> 24; }

TEST_F(FSceneObjectTest, StaticSecondFrameDoesNothing)
{
	const uint32_t Material = Scene->AddMaterial(MakeMaterial());
	const FRTGeometryRef Tree = MakeGeometry("Tree", 1);
	for (int I = 0; I < 100; ++I) { Add(Tree, {Material}, {I, 0, 0}); }
	for (int I = 0; I < 3; ++I) { Scene->AddLight({}); }
	Frame();
	EXPECT_EQ(Scene->GetStats().GeometriesBuilt, 1u);
	EXPECT_EQ(Scene->GetStats().InstancesWritten, 100u);
	Settle();
	Mock().ClearCalls();
	Frame();
	EXPECT_FALSE(bUpdated);
	for (const ERTMockCall Kind :
	    {ERTMockCall::CopyBuffer, ERTMockCall::BuildGeometry, ERTMockCall::BuildScene, ERTMockCall::CreateBuffer, ERTMockCall::Barrier})
	{
		EXPECT_EQ(Mock().CountCalls(Kind), 0u) << static_cast<int>(Kind);
	}
	EXPECT_EQ(Scene->GetSections().GetCapacity(), 1u) << "100 trees of one material share a section";
}

TEST_F(FSceneObjectTest, MaterialThatChangesItsColourOnlyTravelsAlone)
{
	const uint32_t Material = Scene->AddMaterial(MakeMaterial());
	Add(MakeGeometry("Tree", 1), {Material});
	Settle();
	Mock().ClearCalls();
	FMaterialData Red = MakeMaterial();
	Red.BaseColor = glm::vec4(1, 0, 0, 1);
	Scene->SetMaterial(Material, Red);
	Frame();
	EXPECT_EQ(Scene->GetStats().BytesCopied, sizeof(FMaterialData));
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::BuildScene), 0u);
	EXPECT_EQ(Read<FMaterialData>(Scene->GetConstants().Materials, Material).BaseColor, Red.BaseColor);
}

TEST_F(FSceneObjectTest, BoundsOfDynamicGeometryReachAllItsObjects)
{
	const uint32_t Material = Scene->AddMaterial(MakeMaterial());
	const FRTGeometryRef Body = MakeGeometry("Body", 1, {.bDynamic = true});
	const FRTObjectId First = Add(Body, {Material}), Second = Add(Body, {Material}, {5, 0, 0}), Third = Add(Body, {Material});
	Scene->SetBounds(Body, {glm::vec3(1, 2, 3), 4.0f});
	const auto GetRecord = [&](FRTObjectId Id) { return Scene->GetInstances().GetRecord(Id.Index); };
	EXPECT_EQ(GetRecord(First).Center, glm::dvec3(1, 2, 3));
	EXPECT_EQ(GetRecord(Second).Center, glm::dvec3(6, 2, 3));
	EXPECT_EQ(GetRecord(Third).Radius, 4.0);
	Scene->RemoveObject(First); // another one takes its place in the list
	Scene->SetBounds(Body, {glm::vec3(0), 2.0f});
	EXPECT_EQ(GetRecord(Second).Radius, 2.0);
	EXPECT_EQ(GetRecord(Third).Radius, 2.0);
	Scene->RemoveObject(Second);
	Scene->RemoveObject(Third);
	Scene->SetBounds(Body, {glm::vec3(0), 1.0f});
	EXPECT_EQ(GetRecord(Add(Body, {Material})).Radius, 1.0);
}

TEST_F(FSceneObjectTest, WithoutRaysThereAreNoAccelerationStructures)
{
	const uint32_t Material = Scene->AddMaterial(MakeMaterial());
	const FRTObjectId Id = Add(MakeGeometry("Tree", 1), {Material});
	FSceneUse NoRays;
	NoRays.bRays = false;
	Frame({}, NoRays);
	Scene->SetTransform(Id, glm::dmat4(2.0));
	Frame({}, NoRays);
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::CreateGeometry) + Mock().CountCalls(ERTMockCall::CreateScene), 0u);
	EXPECT_EQ(Device->GetMemoryStats().Geometry + Device->GetMemoryStats().Scene, 0u);
	EXPECT_EQ(Scene->GetConstants().Tlas, ~0u);
	EXPECT_FALSE(Scene->NeedsUpdate({}, NoRays));
	EXPECT_TRUE(Scene->NeedsUpdate({}, {}));
	Frame();
	ASSERT_EQ(GetInstances().size(), 1u);
	EXPECT_TRUE(GetInstances()[0].bBuilt);
	EXPECT_NE(Scene->GetConstants().Tlas, ~0u);
}

TEST_F(FSceneObjectTest, ObjectsRemovedWhileNobodyTracedAreGoneWhenRaysReturn)
{
	const uint32_t Material = Scene->AddMaterial(MakeMaterial());
	Add(MakeGeometry("Stays", 1), {Material});
	const FRTObjectId Goes = Add(MakeGeometry("Goes", 1), {Material});
	Frame();
	Scene->RemoveObject(Goes);
	FSceneUse NoRays;
	NoRays.bRays = false;
	for (int I = 0; I < 4; ++I) { Frame({}, NoRays); }
	Frame();
	ASSERT_EQ(GetInstances().size(), 1u);
	EXPECT_EQ(GetInstances()[0].GeometryName, "Stays");
}

TEST_F(FSceneObjectTest, IdsOfRemovedObjectsAreStale)
{
	const uint32_t Material = Scene->AddMaterial(MakeMaterial());
	const FRTGeometryRef Tree = MakeGeometry("Tree", 1);
	const FRTObjectId Old = Add(Tree, {Material});
	Scene->RemoveObject(Old);
	const FRTObjectId New = Add(Tree, {Material}, {5, 0, 0});
	EXPECT_EQ(New.Index, Old.Index) << "the slot is used again";
	EXPECT_NE(New.Generation, Old.Generation);
	EXPECT_EQ(Scene->GetObject(New).Transform[3].x, 5.0);
#ifndef NDEBUG
	GTEST_FLAG_SET(death_test_style, "threadsafe");
	EXPECT_DEATH(Scene->SetTransform(Old, glm::dmat4(1.0)), "Generation");
#endif
}

TEST_F(FSceneObjectTest, TransformsAreRelativeToTheSnappedOrigin)
{
	const uint32_t Material = Scene->AddMaterial(MakeMaterial());
	const FRTGeometryRef Tree = MakeGeometry("Tree", 1);
	const glm::dvec3 Far(16'000.0, 120.0, -15'999.0);
	const std::vector<glm::dvec3> Positions = {Far + glm::dvec3(0.0001, 0, 0), Far + glm::dvec3(999.9, -3, 0.5), {0, 0, 0}};
	for (const glm::dvec3& Position : Positions) { Add(Tree, {Material}, Position); }
	Frame(Far);
	const glm::dvec3 Origin = Scene->GetOrigin();
	for (int Axis = 0; Axis < 3; ++Axis)
	{
		EXPECT_LE(std::abs(Origin[Axis] - Far[Axis]), 0.5 * FRTScene::OriginStep);
		EXPECT_EQ(std::remainder(Origin[Axis], FRTScene::OriginStep), 0.0);
	}
	for (const FRTMockInstance& Item : GetInstances())
	{
		const glm::dvec3& World = Positions[GetObjectIndex(Item)];
		const FObjectData Data = Read<FObjectData>(Scene->GetConstants().Objects, GetObjectIndex(Item));
		for (int Axis = 0; Axis < 3; ++Axis)
		{
			const double Error = Item.Instance.Transform[4 * Axis + 3] + Origin[Axis] - World[Axis];
			// A kilometre from the camera and nearer: a tenth of a millimetre.
			EXPECT_LE(std::abs(Error), glm::length(World - Far) < 1000.0 ? 1e-4 : 1e-2);
			// What raster adds up is what rays see.
			const glm::vec3 Cell = glm::vec3(Data.Cell - Scene->GetConstants().OriginCell) * CELL_SIZE - Scene->GetConstants().OriginInCell;
			EXPECT_EQ(Data.ObjectToWorld[Axis].w + Cell[Axis], Item.Instance.Transform[4 * Axis + 3]);
		}
	}
	Settle(Far);
	Mock().ClearCalls();
	Frame(Far + glm::dvec3(1, 0, 0));
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::BuildScene), 0u) << "a camera that moves within a step rewrites nothing";
	Frame(Far + glm::dvec3(1200, 0, 0));
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::BuildScene), 1u);
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::CopyBuffer), 0u) << "a moving origin rewrites no table";
	for (const FRTMockInstance& Item : GetInstances())
	{
		const double X = Item.Instance.Transform[3] + Scene->GetOrigin().x;
		EXPECT_NEAR(X, Positions[GetObjectIndex(Item)].x, 2e-3);
	}
}

TEST_F(FSceneObjectTest, FlagsAndMasksReachTheInstances)
{
	const uint32_t Opaque = Scene->AddMaterial(MakeMaterial());
	const uint32_t Leaves = Scene->AddMaterial(MakeMaterial(MATERIAL_MASKED));
	const FRTGeometryRef Tree = MakeGeometry("Tree", 2, {.bOpaque = false});
	FRTObjectInfo Info;
	Info.Geometry = Tree;
	Info.Materials = {Opaque, Leaves};
	Info.Mask = MaskVisible;
	Info.Transform = glm::dmat4(1.0);
	Info.Transform[0][0] = -1.0; // mirrored
	const FRTObjectId Masked = Scene->AddObject(Info);
	const FRTObjectId Solid = Add(Tree, {Opaque, Opaque});
	Frame();
	const auto Find = [&](FRTObjectId Id) {
		for (const FRTMockInstance& Item : GetInstances())
		{
			if (GetObjectIndex(Item) == Id.Index) { return Item; }
		}
		ADD_FAILURE() << "object " << Id.Index << " is not in the scene";
		return FRTMockInstance();
	};
	EXPECT_EQ(GetFlags(Find(Masked)), 0u);
	EXPECT_EQ(GetFlags(Find(Solid)), uint32_t(InstanceForceOpaque));
	EXPECT_EQ(Find(Masked).Instance.CustomIndexAndMask >> 24, uint32_t(MaskVisible));
	EXPECT_EQ(Find(Solid).Instance.CustomIndexAndMask >> 24, uint32_t(MaskDefault & ~MASK_TRANSMISSIVE));
	EXPECT_EQ(Read<FObjectData>(Scene->GetConstants().Objects, Masked.Index).Flags, OBJECT_MIRRORED);
	EXPECT_EQ(Read<FObjectData>(Scene->GetConstants().Objects, Solid.Index).Flags, 0u);
	// Each way of making the leaves solid, and back.
	const std::vector<std::pair<std::function<void()>, uint32_t>> Steps =
	    {
	        {[&] { Scene->SetAlphaTest(false); }, InstanceForceOpaque},
	        {[&] { Scene->SetAlphaTest(true); }, 0},
	        {[&] { Scene->SetMaterialOverride(2); }, InstanceForceOpaque},
	        {[&] { Scene->SetMaterialOverride(1); }, 0},
	        {[&] { Scene->SetMaterial(Leaves, MakeMaterial()); }, InstanceForceOpaque},
	        {[&] { Scene->SetMaterial(Leaves, MakeMaterial(MATERIAL_MASKED)); }, 0},
	        {[&] {
		Scene->SetMaterials(Masked, {Opaque, Opaque});
	         },
	            InstanceForceOpaque},
	};
	for (size_t Step = 0; Step < Steps.size(); ++Step)
	{
		Steps[Step].first();
		Frame();
		EXPECT_EQ(GetFlags(Find(Masked)), Steps[Step].second) << "step " << Step;
		EXPECT_EQ(Scene->GetFacts().bMasked, Steps[Step].second == 0) << "step " << Step;
	}
}

// Rays that look for glass cull what is opaque (MaterialRay.glsl): glass that was built as opaque would vanish.
TEST_F(FSceneObjectTest, GlassIsNeverCulledAsOpaque)
{
	FMaterialData Glass = MakeMaterial();
	Glass.Transmission = 1.0f;
	const uint32_t Pane = Scene->AddMaterial(Glass), Wall = Scene->AddMaterial(MakeMaterial());
	FRTObjectInfo Info;
	Info.Mask = MaskVisible | MASK_TRANSMISSIVE;
	Info.Materials = {Wall, Pane};
	Info.Geometry = MakeGeometry("House", 2, {.bOpaque = true});
	const FRTObjectId Solid = Scene->AddObject(Info);
	Info.Geometry = MakeGeometry("HouseOfGlass", 2, {.bOpaque = false});
	const FRTObjectId Open = Scene->AddObject(Info);
	const auto ExpectFlags = [&](uint32_t OfSolid, uint32_t OfOpen) {
		Settle();
		ASSERT_EQ(GetInstances().size(), 2u);
		for (const FRTMockInstance& Item : GetInstances())
		{
			const bool bSolid = GetObjectIndex(Item) == Solid.Index;
			EXPECT_TRUE(bSolid || GetObjectIndex(Item) == Open.Index);
			EXPECT_EQ(GetFlags(Item), bSolid ? OfSolid : OfOpen) << (bSolid ? "solid" : "open");
		}
	};
	ExpectFlags(InstanceForceNoOpaque, 0);
	Scene->SetMaterial(Pane, MakeMaterial());
	ExpectFlags(InstanceForceOpaque, InstanceForceOpaque);
	Scene->SetMaterial(Pane, Glass);
	ExpectFlags(InstanceForceNoOpaque, 0);
}

TEST_F(FSceneObjectTest, RemovalWhileFramesAreInFlightLeavesNothingDangling)
{
	Mock().SetManualFences(true);
	const uint32_t Material = Scene->AddMaterial(MakeMaterial());
	std::vector<FRTObjectId> Ids;
	std::mt19937 Random(4);
	uint32_t Name = 0;
	FRTFence Seen = 0;
	for (int Step = 0; Step < 400; ++Step)
	{
		for (uint32_t I = Random() % 3; I > 0 && !Ids.empty(); --I)
		{
			const size_t Which = Random() % Ids.size();
			Scene->RemoveObject(Ids[Which]); // its geometry has no other owner
			Ids.erase(Ids.begin() + Which);
		}
		for (uint32_t I = Random() % 3; I > 0; --I)
		{
			const uint32_t SectionCount = 1 + Random() % 3;
			const FRTGeometryRef Geometry = MakeGeometry("G" + std::to_string(Name++), SectionCount);
			Ids.push_back(Add(Geometry, std::vector<uint32_t>(SectionCount, Material)));
		}
		const FRTFence Fence = Frame();
		// The GPU is up to three frames behind.
		const FRTFence Done = Fence > 3 ? Fence - Random() % 4 : 0;
		while (Seen < Done)
		{
			Mock().CompleteUpTo(++Seen);
			for (const FRTMockInstance& Item : GetInstances())
			{
				ASSERT_FALSE(Item.bDangling) << "frame " << Seen << ": rays would reach destroyed " << Item.GeometryName;
				ASSERT_TRUE(Item.bBuilt);
			}
		}
	}
	Mock().SetManualFences(false);
	EXPECT_EQ(GetInstances().size(), Ids.size());
	for (const FRTObjectId Id : Ids) { Scene->RemoveObject(Id); }
	for (int I = 0; I < 5; ++I) { Frame(); }
	EXPECT_EQ(Device->GetMemoryStats().Geometry, 0u) << "geometry without objects is still there";
}

TEST_F(FSceneObjectTest, DeformedGeometryIsRefittedAndRebuiltEveryInterval)
{
	FConsoleVariables::Get().Set("r.RT.Skinning.RebuildInterval", "4", ERTSetBy::Console, "test");
	FConsoleVariables::Get().BeginFrame();
	const uint32_t Material = Scene->AddMaterial(MakeMaterial());
	const FRTGeometryRef Body = MakeGeometry("Body", 1, {.bDynamic = true});
	const FRTGeometryRef Wall = MakeGeometry("Wall", 1);
	Add(Body, {Material});
	Add(Wall, {Material});
	Scene->MarkDeformed(Body); // not built yet: its first build sees the new vertices
	std::string Work;
	for (int I = 0; I < 9; ++I)
	{
		Frame();
		Work += Scene->GetStats().GeometriesRefitted ? 'r' : Scene->GetStats().GeometriesBuilt ? 'B' : '-';
		Scene->MarkDeformed(Body);
		Scene->MarkDeformed(Body); // twice is once
	}
	EXPECT_EQ(Work, "BrrrBrrrB");
	EXPECT_EQ(Mock().GetGeometry(Body->GetStructure()).BuildCount, 3u);
	EXPECT_EQ(Mock().GetGeometry(Body->GetStructure()).UpdateCount, 6u);
	EXPECT_EQ(Mock().GetGeometry(Wall->GetStructure()).BuildCount, 1u);
	EXPECT_EQ(Scene->GetFacts().DynamicGeometries, 1u);
	FConsoleVariables::Get().ResetAll();
}

TEST_F(FSceneObjectTest, HundredsOfGeometriesAreBuiltInBatchesThatShareScratch)
{
	const uint32_t Material = Scene->AddMaterial(MakeMaterial());
	for (int I = 0; I < 300; ++I) { Add(MakeGeometry("G" + std::to_string(I), 1, {.TrianglesPerSection = 5000}), {Material}); }
	Frame();
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::BuildGeometry), 300u);
	EXPECT_EQ(GetInstances().size(), 300u);
	EXPECT_LE(Device->GetMemoryStats().Scratch, 33u << 20);
	// Within a batch no two builds share scratch: offsets ascend until a barrier.
	uint64_t Last = 0;
	bool bFirst = true;
	for (const FRTMockCall& Call : Mock().GetCalls())
	{
		if (Call.Kind == ERTMockCall::Barrier) { bFirst = true; }
		if (Call.Kind != ERTMockCall::BuildGeometry) { continue; }
		EXPECT_TRUE(bFirst || Call.Numbers[2] > Last);
		Last = Call.Numbers[2];
		bFirst = false;
	}
}

TEST_F(FSceneObjectTest, SceneGrowsAndEmpties)
{
	const uint32_t Material = Scene->AddMaterial(MakeMaterial());
	const FRTGeometryRef Tree = MakeGeometry("Tree", 1);
	Frame();
	EXPECT_EQ(GetInstances().size(), 0u) << "an empty scene can be traced";
	EXPECT_TRUE(Scene->GetStructure());
	std::vector<FRTObjectId> Ids;
	for (int I = 0; I < 1000; ++I) { Ids.push_back(Add(Tree, {Material})); }
	Frame();
	EXPECT_EQ(GetInstances().size(), 1000u);
	for (const FRTObjectId Id : Ids) { Scene->RemoveObject(Id); }
	Frame();
	EXPECT_EQ(GetInstances().size(), 0u);
	EXPECT_EQ(Scene->GetFacts().Objects, 0u);
	EXPECT_EQ(Scene->GetSections().GetRangeCount(), 0u);
}

TEST_F(FSceneObjectTest, LightsStayWhenTheOriginMoves)
{
	FSceneLight Light;
	Light.Position = {16'001.5, 2, 3};
	const FLightId Ids[] = {Scene->AddLight(Light), Scene->AddLight(Light)};
	Frame({16'000, 0, 0});
	const FSceneConstants Constants = Scene->GetConstants();
	EXPECT_EQ(Constants.LightCount, 2u);
	EXPECT_EQ(Read<FLightData>(Constants.Lights, 1).Position.x, static_cast<int32_t>(16'001.5 * LIGHT_POSITION_STEPS));
	Frame({0, 0, 0});
	EXPECT_EQ(Scene->GetOrigin(), glm::dvec3(0));
	EXPECT_EQ(Scene->GetStats().BytesCopied, 0u);
	for (const FLightId Id : Ids) { Scene->RemoveLight(Id); }
	Frame();
	EXPECT_EQ(Scene->GetConstants().LightCount, 0u);
	EXPECT_EQ(Scene->GetFacts().Lights, 0u);
}

TEST_F(FSceneObjectTest, EmissiveTrianglesAreListed)
{
	const uint32_t Dark = Scene->AddMaterial(MakeMaterial());
	const uint32_t Dim = Scene->AddMaterial(MakeMaterial(0, 1.0f));
	const uint32_t Bright = Scene->AddMaterial(MakeMaterial(0, 3.0f));
	const FRTGeometryRef Panel = MakeGeometry("Panel", 2, {.bCpuData = true, .TrianglesPerSection = 2});
	const FRTObjectId First = Add(Panel, {Dark, Dim}), Second = Add(Panel, {Bright, Dark}, {10, 0, 0});
	FSceneUse Use;
	Frame({}, Use);
	EXPECT_EQ(Scene->GetConstants().EmissiveTriangleCount, 0u) << "nobody samples lights";
	EXPECT_EQ(Scene->GetConstants().EmissiveTriangles, 0u);
	Use.bLightSampling = true;
	Frame({}, Use);
	const FSceneConstants C = Scene->GetConstants();
	ASSERT_EQ(C.EmissiveTriangleCount, 4u);
	EXPECT_EQ(Scene->GetFacts().EmissiveTriangles, 4u);
	EXPECT_NE(C.EmissiveTriangles, 0u);
	EXPECT_NE(C.EmissivePowers, 0u);
	ASSERT_EQ(C.EmissiveClusterCount, 2u);
	for (uint32_t I = 0; I < 2; ++I)
	{
		const FEmissiveCluster Cluster = Read<FEmissiveCluster>(C.EmissiveClusters, I);
		EXPECT_EQ(Cluster.First, 2 * I);
		EXPECT_EQ(Cluster.Count, 2u);
		EXPECT_EQ(Cluster.Object, (I == 0 ? First : Second).Index);
		EXPECT_EQ(Cluster.Range, I);
		const FEmissiveRange Range = Read<FEmissiveRange>(C.EmissiveRanges, I);
		EXPECT_EQ(Range.First, 2 * I);
		EXPECT_EQ(Range.Section, I == 0 ? Scene->GetFirstSection(First) + 1 : Scene->GetFirstSection(Second));
		EXPECT_EQ(Read<FSectionData>(C.Sections, Range.Section).Flags & SECTION_LIGHT, SECTION_LIGHT);
	}
	EXPECT_EQ(Read<FEmissiveRange>(C.EmissiveRanges, 2).First, 4u);
	Scene->SetMaterial(Bright, MakeMaterial());
	Frame({}, Use);
	EXPECT_EQ(Scene->GetConstants().EmissiveTriangleCount, 4u) << "it may shine again";
	Scene->RemoveObject(First);
	Frame(); // its shaders are being compiled, say
	EXPECT_EQ(Scene->GetConstants().EmissiveTriangleCount, 0u) << "sections and vertices are gone";
	EXPECT_EQ(Scene->GetFacts().EmissiveTriangles, 0u);
	EXPECT_EQ(Scene->GetFacts().EmissiveClusters, 0u);
	Frame({}, Use);
	EXPECT_EQ(Scene->GetConstants().EmissiveTriangleCount, 2u);
	EXPECT_EQ(Scene->GetFacts().EmissiveClusters, 1u);
	EXPECT_FALSE(Scene->GetFacts().bEmissive);
}

TEST_F(FSceneObjectTest, SecondEmissionIsAFact)
{
	FMaterialData Lamp = MakeMaterial(0, 1.0f);
	Lamp.Emissive = Lamp.LightEmissive = glm::vec3(1);
	const uint32_t Material = Scene->AddMaterial(Lamp);
	const FRTObjectId Id = Add(MakeGeometry("Lamp", 1), {Material});
	Frame();
	EXPECT_FALSE(Scene->GetFacts().bLightEmission);
	Lamp.LightEmissive = glm::vec3(510);
	Scene->SetMaterial(Material, Lamp);
	Frame();
	EXPECT_TRUE(Scene->GetFacts().bLightEmission);
	Lamp.EmissiveWeight = 0.0f;
	Lamp.LightEmissive = glm::vec3(0);
	Scene->SetMaterial(Material, Lamp);
	Frame();
	EXPECT_TRUE(Scene->GetFacts().bEmissive) << "rays see it, although it lights nothing";
	Scene->RemoveObject(Id);
	Frame();
	EXPECT_FALSE(Scene->GetFacts().bLightEmission);
}

TEST_F(FSceneObjectTest, LostFrameIsRecordedAgain)
{
	const uint32_t Material = Scene->AddMaterial(MakeMaterial(0, 1.0f));
	const FRTGeometryRef Body = MakeGeometry("Body", 1, {.bDynamic = true});
	const FRTObjectId Id = Add(Body, {Material});
	for (int I = 0; I < 2; ++I) { Scene->AddLight({}); }
	const auto LoseOne = [&] {
		TRTRef<IRTCommandList> List;
		ASSERT_TRUE(Device->CreateCommandList("Lost", List.ReleaseAndGetAddress()));
		ASSERT_TRUE(List->Begin());
		ASSERT_TRUE(Scene->Update(*List, *Uploads, {}, {}));
		ASSERT_TRUE(List->End());
		Uploads->EndFrame(0);
		Scene->EndFrame(false);
		EXPECT_TRUE(Scene->NeedsUpdate({}, {}));
	};
	LoseOne();
	Frame();
	ASSERT_EQ(GetInstances().size(), 1u);
	EXPECT_TRUE(GetInstances()[0].bBuilt);
	EXPECT_EQ(Read<FMaterialData>(Scene->GetConstants().Materials, Material).EmissiveWeight, 1.0f);
	Scene->SetTransform(Id, glm::dmat4(3.0));
	Scene->SetMaterial(Material, MakeMaterial(0, 2.0f));
	Scene->MarkDeformed(Body);
	LoseOne();
	Frame();
	EXPECT_EQ(GetInstances()[0].Instance.Transform[0], 3.0f);
	EXPECT_EQ(Read<FMaterialData>(Scene->GetConstants().Materials, Material).EmissiveWeight, 2.0f);
	const FRTMockGeometry Built = Mock().GetGeometry(Body->GetStructure());
	EXPECT_EQ(Built.BuildCount + Built.UpdateCount, 2u) << "the deformation that was lost";
	Frame();
	EXPECT_FALSE(bUpdated);
}

TEST_F(FSceneObjectTest, GeometryThatTheDeviceCannotHoldIsNamed)
{
	FRTGeometryInfo Info = MakeInfo("Monster", 1);
	Info.Sections[0].IndexCount = 0xfffffffcu;
	FRTGeometryRef Geometry;
	const FRTStatus Status = Scene->CreateGeometry(std::move(Info), Geometry);
	EXPECT_EQ(Status.Code, ERTResult::Unsupported);
	EXPECT_NE(std::string(Status.Message).find("Monster"), std::string::npos) << Status.Message;
	EXPECT_FALSE(Geometry);
}

} // namespace
} // namespace Lantern
