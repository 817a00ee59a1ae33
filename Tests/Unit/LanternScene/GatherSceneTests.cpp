// Gathering seen from the device: what FRTScene builds its acceleration structure from, and when.
#include <cmath>
#include <functional>
#include <map>
#include <random>

#include "LanternCore/Config/ConsoleVariables.h"
#include "Support/SceneTestTools.h"

namespace Lantern
{
namespace
{

class FGatherSceneTest : public FSceneTest
{
protected:
	void TearDown() override
	{
		FConsoleVariables::Get().ResetAll();
		FConsoleVariables::Get().BeginFrame();
		FSceneTest::TearDown();
	}
	static void SetVariable(const char* Name, const std::string& Value)
	{
		ASSERT_EQ(FConsoleVariables::Get().Set(Name, Value, ERTSetBy::Console, "test"), std::nullopt);
		FConsoleVariables::Get().BeginFrame();
	}
	FRTGeometryRef MakeSphere(const std::string& Name, float Radius, const FGeometryOptions& Options = {})
	{
		FRTGeometryInfo Info = MakeInfo(Name, 1, Options);
		Info.BoundsRadius = Radius;
		FRTGeometryRef Geometry;
		EXPECT_TRUE(Scene->CreateGeometry(std::move(Info), Geometry));
		return Geometry;
	}
	FRTObjectId AddGrouped(const FRTGeometryRef& Geometry, uint32_t Material, glm::dvec3 At, uint32_t Group)
	{
		FRTObjectInfo Info;
		Info.Geometry = Geometry;
		Info.Materials = {Material};
		Info.Transform[3] = glm::dvec4(At, 1.0);
		Info.Group = Group;
		return Scene->AddObject(std::move(Info));
	}
	/// A frame with a view of its own; false: it was not submitted.
	void ViewFrame(const FGatherView& View, const FSceneUse& Use = {}, bool bSubmit = true)
	{
		TRTRef<IRTCommandList> List;
		ASSERT_TRUE(Device->CreateCommandList("Frame", List.ReleaseAndGetAddress()));
		ASSERT_TRUE(List->Begin());
		const FRTStatus Status = Scene->Update(*List, *Uploads, View, Use);
		ASSERT_TRUE(Status) << Status.Message;
		ASSERT_TRUE(List->End());
		FRTFence Fence = 0;
		IRTCommandList* const Lists[] = {List.Get()};
		if (bSubmit) { ASSERT_TRUE(Device->Submit(Lists, 1, &Fence)); }
		Uploads->EndFrame(Fence);
		Scene->EndFrame(bSubmit, Fence);
	}
	/// Object → instance of the structure as rays see it now.
	std::map<uint32_t, FRTMockInstance> ByObject()
	{
		std::map<uint32_t, FRTMockInstance> Out;
		for (const FRTMockInstance& Item : GetInstances())
		{
			EXPECT_TRUE(Item.Geometry && Item.bBuilt && !Item.bDangling);
			EXPECT_TRUE(Out.emplace(Item.Instance.CustomIndexAndMask & 0xffffff, Item).second) << "twice";
		}
		return Out;
	}
	uint32_t MaskOf(FRTObjectId Id)
	{
		const auto Found = ByObject();
		const auto It = Found.find(Id.Index);
		return It == Found.end() ? 0 : It->second.Instance.CustomIndexAndMask >> 24;
	}
};

TEST_F(FGatherSceneTest, CullsByDistanceAndSizeOnEachSide)
{
	const uint32_t Material = Scene->AddMaterial(MakeMaterial());
	const FRTGeometryRef Bush = MakeSphere("Bush", 1), House = MakeSphere("House", 20);
	const FRTObjectId Near = Add(Bush, {Material}, {0, 0, -900}), Far = Add(Bush, {Material}, {0, 0, -1100});
	const FRTObjectId Behind = Add(Bush, {Material}, {0, 0, 900}), Large = Add(House, {Material}, {0, 0, -3000});
	const FRTObjectId Unknown = Add(MakeGeometry("Unknown", 1), {Material}, {0, 0, 30'000});
	ViewFrame({{0, 0, 0}, {0, 0, -1}, 1.0f, 720});
	EXPECT_NE(MaskOf(Near), 0u);
	EXPECT_EQ(MaskOf(Far), 0u);
	EXPECT_EQ(MaskOf(Behind), 0u);
	EXPECT_NE(MaskOf(Large), 0u);
	EXPECT_NE(MaskOf(Unknown), 0u);
	ViewFrame({{0, 0, 0}, {0, 0, 1}, 1.0f, 720});
	EXPECT_EQ(MaskOf(Near), 0u) << "behind now";
	EXPECT_NE(MaskOf(Behind), 0u);
	SetVariable("r.RT.Culling", "0");
	ViewFrame({{0, 0, 0}, {0, 0, -1}, 1.0f, 720});
	EXPECT_EQ(ByObject().size(), 5u);
	SetVariable("r.RT.Culling", "1");
	FSceneUse Reference;
	Reference.bCull = false;
	ViewFrame({{0, 0, 0}, {0, 0, -1}, 1.0f, 720}, Reference);
	EXPECT_EQ(ByObject().size(), 5u);
	ViewFrame({{0, 0, 0}, {0, 0, -1}, 1.0f, 720});
	EXPECT_EQ(ByObject().size(), 3u);
}

TEST_F(FGatherSceneTest, GroupsAreKeptOrLeftOutAsOne)
{
	const uint32_t Material = Scene->AddMaterial(MakeMaterial());
	const FRTGeometryRef Brick = MakeSphere("Brick", 0.5f);
	std::vector<FRTObjectId> House;
	for (int I = 0; I < 200; ++I)
	{
		House.push_back(AddGrouped(Brick, Material, {0.2 * (I - 100), 0, -2000}, 7)); // 40 m across
	}
	const FRTObjectId Single = Add(Brick, {Material}, {0, 0, -2000});
	ViewFrame({{0, 0, 0}, {0, 0, -1}, 1.0f, 720});
	EXPECT_EQ(ByObject().size(), 200u) << "the house is seen under half a degree";
	EXPECT_EQ(MaskOf(Single), 0u);
	SetVariable("r.RT.Culling.Angle", "1");
	ViewFrame({{0, 0, 0}, {0, 0, -1}, 1.0f, 720});
	EXPECT_EQ(ByObject().size(), 0u);
	Scene->SetTransform(House[0], glm::dmat4(1.0)); // one brick comes near: the house is 2 km across
	ViewFrame({{0, 0, 0}, {0, 0, -1}, 1.0f, 720});
	EXPECT_EQ(ByObject().size(), 200u);
	Scene->RemoveObject(House[0]);
	ViewFrame({{0, 0, 0}, {0, 0, -1}, 1.0f, 720});
	EXPECT_EQ(ByObject().size(), 0u);
}

TEST_F(FGatherSceneTest, SmallObjectsLoseMaskBitsAndGoWithTheLast)
{
	const uint32_t Material = Scene->AddMaterial(MakeMaterial());
	const FRTGeometryRef Pebble = MakeSphere("Pebble", 0.1f);
	const FRTObjectId Id = Add(Pebble, {Material}, {0, 0, -20}); // 6.6 pixels across
	const FGatherView View({0, 0, 0}, {0, 0, -1}, 1.0f, 720);
	FRTObjectInfo Info = Scene->GetObject(Id);
	Info.Mask = MASK_SUN;
	const FRTObjectId ShadowOnly = Scene->AddObject(Info);
	ViewFrame(View);
	constexpr uint32_t Opaque = MaskDefault & ~MASK_TRANSMISSIVE; // no light shines through it
	EXPECT_EQ(MaskOf(Id), Opaque);
	EXPECT_EQ(MaskOf(ShadowOnly), uint32_t(MASK_SUN));
	SetVariable("r.RT.Culling.Shadow.MinPixels", "24");
	ViewFrame(View);
	EXPECT_EQ(MaskOf(Id), Opaque & ~uint32_t(MaskCasters));
	EXPECT_EQ(ByObject().count(ShadowOnly.Index), 0u);
	SetVariable("r.RT.Culling.Visible.MinPixels", "24");
	ViewFrame(View);
	EXPECT_EQ(ByObject().size(), 0u);
	SetVariable("r.RT.Culling.Shadow.MinPixels", "2");
	ViewFrame(View);
	EXPECT_EQ(MaskOf(Id), uint32_t(MaskDefault & MaskCasters));
}

TEST_F(FGatherSceneTest, StillFramesDoNothingAndMovingOnesOnlyWhereTheSetChanges)
{
	const uint32_t Material = Scene->AddMaterial(MakeMaterial());
	const FRTGeometryRef Tree = MakeSphere("Tree", 2);
	for (int I = 0; I < 2000; ++I) { Add(Tree, {Material}, {10.0 * (I % 40), 0, -10.0 * (I / 40)}); }
	Settle();
	Mock().ClearCalls();
	for (const int Mode : {1, 0})
	{
		SetVariable("r.RT.Scene.Gather", std::to_string(Mode));
		Settle();
		Mock().ClearCalls();
		Frame();
		EXPECT_FALSE(bUpdated);
		EXPECT_EQ(Scene->GetStats().BytesCopied, 0u);
		for (const ERTMockCall Kind :
		    {ERTMockCall::CopyBuffer, ERTMockCall::BuildGeometry, ERTMockCall::BuildScene, ERTMockCall::CreateBuffer, ERTMockCall::Barrier})
		{
			EXPECT_EQ(Mock().CountCalls(Kind), 0u) << static_cast<int>(Kind);
		}
	}
	SetVariable("r.RT.Scene.Gather", "1");
	Settle();
	Mock().ClearCalls();
	ViewFrame({{0.001, 0, 0}, {0, 0, -1}, 1.0f, 0});
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::BuildScene), 0u) << "the same objects are kept";
	ViewFrame({{-900, 0, 0}, {0, 0, -1}, 1.0f, 0});
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::BuildScene), 1u);
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::CopyBuffer), 0u) << "another set of objects rewrites no table";
}

TEST_F(FGatherSceneTest, WhatMovesCostsWhatMoves)
{
	const uint32_t Material = Scene->AddMaterial(MakeMaterial());
	const FRTGeometryRef Tree = MakeSphere("Tree", 2);
	std::vector<FRTObjectId> Ids;
	for (int I = 0; I < 10'000; ++I) { Ids.push_back(Add(Tree, {Material}, {10.0 * (I % 100), 0, -10.0 * (I / 100)})); }
	FSceneUse All;
	All.bCull = false;
	Settle({}, All);
	for (int I = 0; I < 10'000; I += 100)
	{
		glm::dmat4 Transform = Scene->GetObject(Ids[I]).Transform;
		Transform[3].y = 3.0;
		Scene->SetTransform(Ids[I], Transform);
	}
	Frame({}, All);
	EXPECT_LE(Scene->GetStats().BytesCopied, 100 * FGpuTableBase::ChunkEntries * sizeof(FObjectData));
	EXPECT_LE(Scene->GetStats().BytesCopied, 10'000 * sizeof(FObjectData) / 10);
	const auto Instances = ByObject();
	ASSERT_EQ(Instances.size(), 10'000u);
	for (int I = 0; I < 10'000; ++I) { ASSERT_EQ(Instances.at(Ids[I].Index).Instance.Transform[7], I % 100 == 0 ? 3.0f : 0.0f); }
}

TEST_F(FGatherSceneTest, RefittedGeometryRebuildsTheStructureFromTheInstancesThatThereAre)
{
	const uint32_t Material = Scene->AddMaterial(MakeMaterial());
	const FRTGeometryRef Body = MakeGeometry("Body", 1, {.bDynamic = true});
	Add(Body, {Material});
	Settle();
	Mock().ClearCalls();
	for (int I = 0; I < 5; ++I)
	{
		Scene->MarkDeformed(Body);
		Frame();
	}
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::BuildScene), 5u);
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::CopyBuffer) + Mock().CountCalls(ERTMockCall::CreateBuffer), 0u);
	EXPECT_EQ(ByObject().size(), 1u);
}

TEST_F(FGatherSceneTest, ObjectsOfMissingProgramsAreLeftOutUntilTheyAreThere)
{
	const uint32_t Plain = Scene->AddMaterial(MakeMaterial()), Special = Scene->AddMaterial(MakeMaterial(), 5);
	const FRTGeometryRef Tree = MakeGeometry("Tree", 2);
	const FRTObjectId A = Add(Tree, {Plain, Plain}), B = Add(Tree, {Plain, Special});
	Settle();
	EXPECT_EQ(ByObject().size(), 2u);
	Scene->SetMissingPrograms({{5, ERTHitClass::Opaque}});
	Frame();
	EXPECT_NE(MaskOf(A), 0u);
	EXPECT_EQ(MaskOf(B), 0u);
	Scene->SetMaterialProgram(Plain, 5);
	Frame();
	EXPECT_EQ(ByObject().size(), 0u);
	Scene->SetMaterialProgram(Plain, StandardProgram);
	Scene->SetMaterials(B, {Plain, Plain});
	Frame();
	EXPECT_EQ(ByObject().size(), 2u);
	Scene->SetMaterials(B, {Special, Plain});
	Scene->SetMissingPrograms({});
	Frame();
	EXPECT_EQ(ByObject().size(), 2u);
	Scene->SetMissingPrograms({{5, ERTHitClass::Masked}});
	Settle();
	EXPECT_EQ(ByObject().size(), 2u) << "another class of the same program";
}

TEST_F(FGatherSceneTest, ObjectsWhoseMaterialsTakeOrLeaveAMissingProgramFollow)
{
	const uint32_t Leaves = Scene->AddMaterial(MakeMaterial(MATERIAL_MASKED));
	const uint32_t Special = Scene->AddMaterial(MakeMaterial(MATERIAL_MASKED), 5);
	const uint32_t Other = Scene->AddMaterial(MakeMaterial(MATERIAL_MASKED), 5);
	FGeometryOptions Options;
	Options.bOpaque = false;
	const FRTGeometryRef Tree = MakeGeometry("Tree", 2, Options);
	const FRTObjectId A = Add(Tree, {Leaves, Special}), B = Add(Tree, {Leaves, Other});
	Scene->SetMissingPrograms({{5, ERTHitClass::Masked}});
	Settle();
	EXPECT_EQ(ByObject().size(), 0u);
	// Its range is masked before and after, for the sake of its leaves; only the hit program changes.
	Scene->SetMaterial(Special, MakeMaterial());
	Frame();
	EXPECT_NE(MaskOf(A), 0u);
	EXPECT_EQ(MaskOf(B), 0u);
	Scene->SetMaterial(Special, MakeMaterial(MATERIAL_MASKED));
	Scene->SetMaterialProgram(Other, StandardProgram);
	Frame();
	EXPECT_EQ(MaskOf(A), 0u);
	EXPECT_NE(MaskOf(B), 0u);
}

TEST_F(FGatherSceneTest, GeometryThatWaitsForItsBuildIsLeftOutAndComesLargestFirst)
{
	SetVariable("r.RT.Build.TrianglesPerFrame", "1000");
	const uint32_t Material = Scene->AddMaterial(MakeMaterial());
	FSceneUse Budget;
	Budget.bBuildAll = false;
	std::vector<FRTObjectId> Ids;
	for (int I = 0; I < 10; ++I)
	{
		Ids.push_back(Add(MakeSphere("G" + std::to_string(I), 1, {.TrianglesPerSection = 1000}), {Material}, {0, 0, -500.0 + 40 * I}));
	}
	const FGatherView View({0, 0, 0}, {0, 0, -1}, 1.0f, 720);
	size_t Last = 0;
	bool bNearFirst = false;
	for (int I = 0; I < 40 && Last < 10; ++I)
	{
		ViewFrame(View, Budget);
		const auto Now = ByObject();
		EXPECT_GE(Now.size(), Last);
		EXPECT_LE(Now.size(), Last + 2);
		Last = Now.size();
		bNearFirst |= Last < 9 && Now.count(Ids[9].Index) > 0 && Now.count(Ids[1].Index) == 0;
	}
	EXPECT_EQ(Last, 10u);
	EXPECT_TRUE(bNearFirst) << "what is largest on the screen is built first";
}

TEST_F(FGatherSceneTest, FramesThatAreLostAreGatheredAgain)
{
	const uint32_t Material = Scene->AddMaterial(MakeMaterial());
	const FRTGeometryRef Tree = MakeSphere("Tree", 2);
	std::mt19937 Random(7);
	std::vector<FRTObjectId> Ids;
	for (int Step = 0; Step < 300; ++Step)
	{
		for (uint32_t I = Random() % 4; I > 0; --I)
		{
			Ids.push_back(Add(Tree, {Material}, {double(Random() % 2000), 0, -double(Random() % 2000)}));
		}
		if (!Ids.empty() && Random() % 3 == 0)
		{
			Scene->RemoveObject(Ids.back());
			Ids.pop_back();
		}
		const glm::dvec3 Eye(double(Random() % 1000), 0, 0);
		const bool bSubmit = Random() % 2 == 0;
		ASSERT_NO_FATAL_FAILURE(ViewFrame({Eye, {0, 0, -1}, 1.0f, 720}, {}, bSubmit));
		if (!bSubmit) { continue; }
		const FCullingRule Rule(FGatherView(Eye, {0, 0, -1}, 1.0f, 720), FCullingSettings::FromConsole());
		const auto Instances = ByObject();
		size_t Kept = 0;
		for (const FRTObjectId Id : Ids)
		{
			const glm::dvec3 At(Scene->GetObject(Id).Transform[3]);
			const bool bKept = Rule.Test(At, 2) != 0;
			Kept += bKept ? 1 : 0;
			ASSERT_EQ(Instances.count(Id.Index), bKept ? 1u : 0u) << "step " << Step;
			if (bKept)
			{
				const float* const T = Instances.at(Id.Index).Instance.Transform;
				ASSERT_NEAR(T[3] + Scene->GetOrigin().x, At.x, 1e-3);
			}
		}
		ASSERT_EQ(Instances.size(), Kept) << "step " << Step;
	}
}

TEST_F(FGatherSceneTest, FramesThatBeginAndAreNeverRecordedLoseNothing)
{
	const uint32_t Material = Scene->AddMaterial(MakeMaterial());
	const FRTGeometryRef Tree = MakeSphere("Tree", 2);
	Add(Tree, {Material});
	ASSERT_TRUE(Scene->BeginUpdate({}, {}));
	Scene->EndFrame(false);
	ASSERT_TRUE(Scene->BeginUpdate({}, {}));
	Add(Tree, {Material}, {5, 0, 0}); // the frame was given up without a word
	Frame();
	EXPECT_EQ(ByObject().size(), 2u);
	Scene->RemoveObject(Add(Tree, {Material}, {6, 0, 0}));
	ASSERT_TRUE(Scene->BeginUpdate({}, {}));
	Scene.reset(); // with tasks in flight
}

TEST_F(FGatherSceneTest, TogglingEveryVariableEveryFrameChangesNothingButWhatItSays)
{
	const uint32_t Material = Scene->AddMaterial(MakeMaterial());
	const FRTGeometryRef Tree = MakeSphere("Tree", 2);
	for (int I = 0; I < 3000; ++I) { Add(Tree, {Material}, {20.0 * (I % 100), 0, -60.0 * (I / 100)}); }
	std::mt19937 Random(3);
	const std::map<std::string, std::vector<std::string>> Values = {{"r.RT.Culling", {"0", "1", "1"}},
	    {"r.RT.Culling.Radius", {"100", "1000"}}, {"r.RT.Culling.RadiusBehind", {"0", "500"}}, {"r.RT.Culling.Angle", {"0.1", "5"}},
	    {"r.RT.Culling.AngleBehind", {"0", "1"}}, {"r.RT.Culling.Shadow.MinPixels", {"0", "24"}},
	    {"r.RT.Culling.Visible.MinPixels", {"0", "3"}}, {"r.RT.Scene.Gather", {"0", "1"}}, {"r.RT.Scene.Hoist", {"0", "1"}}};
	for (int Step = 0; Step < 200; ++Step)
	{
		for (const auto& [Name, Choices] : Values) { SetVariable(Name.c_str(), Choices[Random() % Choices.size()]); }
		FSceneUse Use;
		Use.bCull = Random() % 8 != 0;
		const FGatherView View({double(Random() % 2000), 2, -500}, {0.5f, 0, -1}, 1.0f, 720);
		ASSERT_NO_FATAL_FAILURE(ViewFrame(View, Use));
		FCullingSettings Settings = FCullingSettings::FromConsole();
		Settings.bEnabled &= Use.bCull;
		const FCullingRule Rule(View, Settings);
		size_t Kept = 0;
		const TPagedArray<FInstanceRecord>& Records = Scene->GetInstances().GetRecords();
		for (size_t Object = 0; Object < Records.Num(); ++Object)
		{
			const FInstanceRecord& Record = Records[Object];
			Kept += Rule.Test(Record.Center, Record.Radius) != 0 ? 1 : 0;
		}
		ASSERT_EQ(GetInstances().size(), Kept) << "step " << Step;
		ASSERT_EQ(Scene->GetInstanceCount(), Kept);
	}
}

TEST_F(FGatherSceneTest, MemoryFollowsTheSceneDown)
{
	SetVariable("r.RT.Culling", "0");
	const uint32_t Material = Scene->AddMaterial(MakeMaterial());
	const FRTGeometryRef Tree = MakeSphere("Tree", 2);
	std::vector<FRTObjectId> Ids;
	for (int I = 0; I < 50'000; ++I) { Ids.push_back(Add(Tree, {Material}, {20.0 * (I % 100), 0, -60.0 * (I / 100)})); }
	Settle();
	const FRTMemoryStats Large = Device->GetMemoryStats();
	for (size_t I = 100; I < Ids.size(); ++I) { Scene->RemoveObject(Ids[I]); }
	for (int I = 0; I < 1500; ++I)
	{
		glm::dmat4 Transform(1.0);
		Transform[3].y = I;
		Scene->SetTransform(Ids[0], Transform); // something to do in each frame
		Frame();
	}
	const FRTMemoryStats Small = Device->GetMemoryStats();
	EXPECT_LT(Small.Scene, Large.Scene / 100);
	EXPECT_LT(Small.Buffer, Large.Buffer / 4) << "of " << Large.Buffer << ": " << testing::PrintToString(Mock().GetLiveObjects());
}

TEST_F(FGatherSceneTest, WhatCannotShrinkForWantOfMemoryServesOn)
{
	SetVariable("r.RT.Culling", "0");
	const uint32_t Material = Scene->AddMaterial(MakeMaterial());
	const FRTGeometryRef Tree = MakeSphere("Tree", 2);
	std::vector<FRTObjectId> Ids;
	for (int I = 0; I < 2000; ++I) { Ids.push_back(Add(Tree, {Material}, {20.0 * I, 0, 0})); }
	Settle();
	for (size_t I = 10; I < Ids.size(); ++I) { Scene->RemoveObject(Ids[I]); }
	for (int I = 0; I < 600; ++I)
	{
		glm::dmat4 Transform(1.0);
		Transform[3].y = I;
		Scene->SetTransform(Ids[0], Transform);
		Mock().FailEveryAllocation(I > 10 && I < 550 ? 1 : 0);
		Frame();
		ASSERT_FALSE(HasFailure()) << "frame " << I;
	}
	EXPECT_EQ(ByObject().size(), 10u);
}

TEST_F(FGatherSceneTest, MoreInstancesThanTheDeviceAllowsAreAnErrorThatSaysSo)
{
	const uint32_t Material = Scene->AddMaterial(MakeMaterial());
	Add(MakeGeometry("Tree", 1), {Material});
	Scene->SetRayTypes(MaxInstanceIndex);
	Add(MakeGeometry("Bush", 3), {Material, Material, Material});
	const FRTStatus Status = Scene->BeginUpdate({}, {});
	EXPECT_EQ(Status.Code, ERTResult::Unsupported);
	EXPECT_NE(std::string(Status.Message).find("sections"), std::string::npos) << Status.Message;
	Scene->EndFrame(false);
	Scene->SetRayTypes(2);
	Frame();
	EXPECT_EQ(ByObject().size(), 2u);
}

} // namespace
} // namespace Lantern
