// A lost device: said once, and the scene goes on on another one as it was.
#include <atomic>
#include <deque>
#include <map>
#include <set>
#include <sstream>
#include <thread>

#include "ModuleTestTools.h"

namespace Lantern
{
namespace
{

using ::testing::HasSubstr;

class FModuleDeviceLossTest : public FModuleTest
{
protected:
	/// A device, and what an engine has on it.
	struct FSide
	{
		FSide() = default;
		FSide(const FSide&) = delete;
		~FSide() { Release(); }
		/// What lives on the device goes first.
		void Release()
		{
			List.Reset();
			Spare.Reset();
			Normals.Reset();
			Depth.Reset();
			Device.Reset();
			Inner.Reset();
		}
		TRTRef<IRTDevice> Inner, Device;
		TRTRef<IRTTexture> Depth, Normals;
		TRTRef<IRTCommandList> List, Spare; ///< Spare was imported before the device could be lost
	};
	void SetUp() override
	{
		FModuleTest::SetUp();
		SetVariable("r.RT.Shadow.Path", "1"); // hit records are used
		Meshes["Wall"] = DescribeTriangle();
		Meshes["Wall"].Sections = &OpaqueSection;
		Meshes["Wall"].SectionCount = 1;
		Meshes["Cloth"] = DescribeTriangle();
		Meshes["Cloth"].bDeformable = true;
		Meshes["Leaf"] = DescribeTriangle();
		for (auto& [Name, Mesh] : Meshes)
		{
			Mesh.Name = Name.c_str();
			Names[AddMesh(Mesh)] = Name;
		}
		ASSERT_OK(SetSun(-1.0));
		Place("Wall", Solid, 1.0);
		Place("Cloth", Solid, 2.0);
		Place("Leaf", Masked, 3.0);
		ASSERT_OK(Renderer->SetObjectCastsShadow(Objects[1], false));
		First.Inner = Inner;
		First.Device = Device;
		First.Depth = Depth;
		First.Normals = Normals;
		ASSERT_OK(First.Device->ImportCommandList(++LastNative, First.Spare.ReleaseAndGetAddress()));
		MakeSide(Second);
	}
	void TearDown() override
	{
		Renderer.Reset();
		for (FSide* Side : {&First, &Second})
		{
			const TRTRef<IRTDevice> Kept = Side->Inner;
			Side->Release();
			if (Kept != Inner) { EXPECT_EQ(GetMock(Kept.Get()).GetErrors(), std::vector<std::string>()); }
		}
		FModuleTest::TearDown();
	}
	void MakeSide(FSide& Side)
	{
		ASSERT_OK(CreateMockDevice(DescribeMock(), Side.Inner.ReleaseAndGetAddress()));
		const auto OnMessage = [](void* User, const char* Text) { static_cast<FModuleDeviceLossTest*>(User)->Messages.emplace_back(Text); };
		ASSERT_OK(WrapWithValidation(Side.Inner.Get(), OnMessage, this, Side.Device.ReleaseAndGetAddress()));
		ASSERT_OK(Side.Device->ImportCommandList(++LastNative, Side.Spare.ReleaseAndGetAddress()));
		const auto Import = [&](ERTFormat Format, TRTRef<IRTTexture>& Out) {
			FRTTextureDesc Desc;
			Desc.Width = Desc.Height = 64;
			Desc.Format = Format;
			Desc.Usage = ERTTextureUsage::Sampled;
			ASSERT_OK(Side.Device->ImportTexture(Desc, ++LastNative, Out.ReleaseAndGetAddress()));
		};
		Import(ERTFormat::D32_FLOAT, Side.Depth);
		Import(ERTFormat::RGBA16_SNORM, Side.Normals);
	}
	void Place(const char* Mesh, ERTMaterialHandle Material, double X)
	{
		FRTModuleObject Desc;
		Desc.Mesh = Find(Mesh);
		Desc.Materials = &Material;
		Desc.MaterialCount = 1;
		Desc.Transform[3] = X;
		Objects.emplace_back();
		ASSERT_OK(Renderer->AddObject(Desc, &Objects.back()));
	}
	ERTMeshHandle Find(const std::string& Name)
	{
		for (const auto& [Handle, Mine] : Names)
		{
			if (Mine == Name) { return Handle; }
		}
		return ERTMeshHandle::None;
	}
	FRTStatus RenderOn(FSide& Side)
	{
		TRTRef<IRTCommandList> New; // a lost device gives none
		const bool bImported = Side.Device->ImportCommandList(++LastNative, New.ReleaseAndGetAddress()).IsOk();
		Side.List = bImported ? New : Side.Spare;
		FRTModuleFrame Frame;
		Frame.Commands = Side.List.Get();
		Frame.Depth = Side.Depth.Get();
		Frame.Normals = Side.Normals.Get();
		Frame.View = MakeView();
		const FRTStatus Status = Renderer->RenderFrame(Frame, &Outputs);
		return Status ? Renderer->EndFrame(nullptr) : Status;
	}
	void RenderUntilComplete(FSide& Side)
	{
		Outputs = {};
		ASSERT_TRUE(WaitUntil(
		    "a complete frame", [&] { return Outputs.bComplete; },
		    [&] {
			ASSERT_OK(RenderOn(Side));
			GiveWay();
		    }));
		ASSERT_NE(Outputs.Get(ESignal::SunShadow), nullptr);
	}
	/// What rays meet: each instance's geometry, place, mask, and the shaders of its first hit record.
	std::multiset<std::string> Describe(FSide& Side)
	{
		FRTMock& MockOf = GetMock(Side.Inner.Get());
		std::multiset<std::string> Out;
		for (IRTScene* const Scene : MockOf.FindLiveScenes())
		{
			for (const FRTMockInstance& Item : MockOf.GetSceneInstances(Scene))
			{
				std::string Text = Item.GeometryName + (Item.bDangling || !Item.bBuilt ? " dangling" : "");
				for (const int Index : {3, 7, 11}) { Text += " " + std::to_string(Item.Instance.Transform[Index]); }
				Text += " mask " + std::to_string(Item.Instance.CustomIndexAndMask >> 24);
				for (IRTShaderTable* const Table : MockOf.FindLiveTables())
				{
					const FRTMockRecord Record = MockOf.ResolveHit(Table, Item.Instance, 0, 0, 1);
					Text += " " + Record.ClosestHit + "|" + Record.AnyHit + "|" + Record.Error;
				}
				Out.insert(Text);
			}
		}
		return Out;
	}
	/// The engine's assets. Lost ones are not given again.
	FRTModuleMeshSource GetSource()
	{
		return {[](void* User, ERTMeshHandle Mesh, FRTModuleMesh* Out) {
			auto& Self = *static_cast<FModuleDeviceLossTest*>(User);
			++Self.AskedFor;
			const auto Found = Self.Meshes.find(Self.Names[Mesh]);
			if (Found != Self.Meshes.end()) { *Out = Found->second; }
			return Found != Self.Meshes.end();
		        },
		    this};
	}
	void Lose() { GetMock(First.Inner.Get()).LoseDevice(); }

	const FRTModuleSection OpaqueSection{0, 3, false};
	std::map<std::string, FRTModuleMesh> Meshes;
	std::map<ERTMeshHandle, std::string> Names;
	std::vector<ERTObjectHandle> Objects;
	FSide First, Second;
	uint32_t AskedFor = 0;
};

TEST_F(FModuleDeviceLossTest, TheSceneGoesOnOnAnotherDevice)
{
	RenderUntilComplete(First);
	const std::multiset<std::string> Before = Describe(First);
	ASSERT_EQ(Before.size(), 3u);
	Lose();
	EXPECT_EQ(RenderOn(First).Code, ERTResult::DeviceLost);
	ASSERT_OK(Renderer->Recreate(Second.Device.Get(), GetSource()));
	EXPECT_EQ(AskedFor, 3u);
	RenderUntilComplete(Second);
	EXPECT_EQ(Describe(Second), Before);
	// Handles are what they were.
	const double Far[12] = {1, 0, 0, 9, 0, 1, 0, 0, 0, 0, 1, 0};
	ASSERT_OK(Renderer->SetObjectTransform(Objects[0], Far));
	ASSERT_OK(Renderer->UpdateMeshVertices(Find("Cloth"), TrianglePositions, nullptr));
	ASSERT_OK(Renderer->RemoveObject(Objects[2]));
	ASSERT_OK(Renderer->RemoveMesh(Find("Leaf")));
	ASSERT_OK(Renderer->RemoveMaterial(Masked));
	RenderUntilComplete(Second);
	EXPECT_EQ(Describe(Second).size(), 2u);
}

TEST_F(FModuleDeviceLossTest, TheLossIsSaidOnce)
{
	RenderUntilComplete(First);
	testing::internal::CaptureStderr();
	Lose();
	for (int Frame = 0; Frame < 5; ++Frame)
	{
		const FRTStatus Status = RenderOn(First);
		EXPECT_EQ(Status.Code, ERTResult::DeviceLost);
		EXPECT_NE(Status.Message[0], 0);
	}
	const std::string Log = testing::internal::GetCapturedStderr();
	std::istringstream Lines(Log);
	uint32_t Said = 0;
	for (std::string Line; std::getline(Lines, Line);) { Said += Line.find("lost") != std::string::npos; }
	EXPECT_EQ(Said, 1u) << Log;
	EXPECT_THAT(Log, HasSubstr("IRTModuleRenderer::Recreate"));
	ASSERT_OK(Renderer->Recreate(Second.Device.Get(), GetSource()));
	RenderUntilComplete(Second);
}

TEST_F(FModuleDeviceLossTest, WhatWasSaidMeanwhileCounts)
{
	RenderUntilComplete(First);
	Lose();
	EXPECT_EQ(RenderOn(First).Code, ERTResult::DeviceLost);
	const double Far[12] = {1, 0, 0, 9, 0, 1, 0, 0, 0, 0, 1, 0};
	ASSERT_OK(Renderer->SetObjectTransform(Objects[0], Far));
	ASSERT_OK(Renderer->RemoveObject(Objects[1]));
	Place("Leaf", Solid, 4.0);
	ASSERT_OK(Renderer->SetObjectMaterials(Objects[2], &Solid, 1));
	ASSERT_OK(Renderer->SetObjectCastsShadow(Objects[2], false));
	ASSERT_OK(Renderer->Recreate(Second.Device.Get(), GetSource()));
	ASSERT_OK(Renderer->SetObjectTransform(Objects[3], Far));
	RenderUntilComplete(Second);
	// As a renderer that never lost anything has it.
	const std::multiset<std::string> Moved = Describe(Second);
	FSide Third;
	MakeSide(Third);
	TRTRef<IRTModuleRenderer> Fresh;
	ASSERT_OK(Module->CreateRenderer(Third.Device.Get(), {}, Fresh.ReleaseAndGetAddress()));
	std::swap(Fresh, Renderer);
	ERTMaterialHandle White = ERTMaterialHandle::None;
	ASSERT_OK(Renderer->AddMaterial({}, &White));
	Names.clear();
	for (const char* Name : {"Wall", "Leaf"}) { Names[AddMesh(Meshes[Name])] = Name; }
	ASSERT_OK(SetSun(-1.0));
	Objects.clear();
	Place("Wall", White, 9.0);
	Place("Leaf", White, 3.0);
	ASSERT_OK(Renderer->SetObjectCastsShadow(Objects.back(), false));
	Place("Leaf", White, 9.0);
	RenderUntilComplete(Third);
	EXPECT_EQ(Moved, Describe(Third));
	Fresh.Reset();
	Renderer.Reset();
}

TEST_F(FModuleDeviceLossTest, AFrameMayLoseItsDeviceAnywhere)
{
	RenderUntilComplete(First);
	const std::multiset<std::string> Before = Describe(First);
	FSide* Side = &First;
	std::deque<FSide> Sides; // a renderer goes before its device
	for (const ERTMockCall At : {ERTMockCall::CreateBuffer, ERTMockCall::CreateTexture, ERTMockCall::CreateGeometry,
	         ERTMockCall::BuildGeometry, ERTMockCall::NotifyExternalSubmit, ERTMockCall::ImportCommandList})
	{
		GetMock(Side->Inner.Get()).LoseDeviceAt(At);
		const double Far[12] = {1, 0, 0, 1000.0 + static_cast<int>(At), 0, 1, 0, 0, 0, 0, 1, 0};
		ASSERT_OK(Renderer->SetObjectTransform(Objects[0], Far)); // there is something to do
		Meshes["New"] = DescribeTriangle();
		Meshes["New"].Name = "New";
		ERTMeshHandle New = ERTMeshHandle::None;
		if (Renderer->AddMesh(Meshes["New"], &New)) { Names[New] = "New"; }
		for (int Frame = 0; Frame < 10 && RenderOn(*Side); ++Frame) {}
		const double Near[12] = {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0};
		ASSERT_OK(Renderer->SetObjectTransform(Objects[0], Near));
		FSide& Next = Sides.emplace_back();
		MakeSide(Next);
		ASSERT_OK(Renderer->Recreate(Next.Device.Get(), GetSource()));
		Side = &Next;
		if (New != ERTMeshHandle::None) { ASSERT_OK(Renderer->RemoveMesh(New)); }
		RenderUntilComplete(*Side);
		EXPECT_EQ(Describe(*Side), Before) << static_cast<int>(At);
	}
	Renderer.Reset();
}

TEST_F(FModuleDeviceLossTest, MeshesThatAreNotGivenAreLeftOutByName)
{
	RenderUntilComplete(First);
	Lose();
	Meshes.erase("Leaf");
	testing::internal::CaptureStderr();
	ASSERT_OK(Renderer->Recreate(Second.Device.Get(), GetSource()));
	EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("mesh \"Leaf\" was not given again"));
	RenderUntilComplete(Second);
	EXPECT_EQ(Describe(Second).size(), 2u);
	const double Far[12] = {1, 0, 0, 9, 0, 1, 0, 0, 0, 0, 1, 0};
	ASSERT_OK(Renderer->SetObjectTransform(Objects[2], Far));
	ASSERT_OK(Renderer->RemoveObject(Objects[2]));
	ASSERT_OK(Renderer->RemoveMesh(Find("Leaf")));
	RenderUntilComplete(Second);
}

TEST_F(FModuleDeviceLossTest, AnotherMeshThanBeforeIsRefusedAndNothingHasChanged)
{
	RenderUntilComplete(First);
	const std::multiset<std::string> Before = Describe(First);
	Lose();
	EXPECT_EQ(RenderOn(First).Code, ERTResult::DeviceLost);
	EXPECT_REFUSED(Renderer->Recreate(nullptr, GetSource()), "Recreate: Device is null");
	Meshes["Cloth"].bDeformable = false;
	EXPECT_REFUSED(Renderer->Recreate(Second.Device.Get(), GetSource()), "mesh \"Cloth\" was given with other sections");
	EXPECT_EQ(RenderOn(First).Code, ERTResult::DeviceLost);
	Meshes["Cloth"].bDeformable = true;
	ASSERT_OK(Renderer->Recreate(Second.Device.Get(), GetSource()));
	RenderUntilComplete(Second);
	EXPECT_EQ(Describe(Second), Before);
}

TEST_F(FModuleDeviceLossTest, MapsOfMaterialsAreLetGoAndGivenAgain)
{
	FTexturedMaterial Bark = MakeTexturedMaterial("Bark");
	ASSERT_OK(Renderer->SetMaterial(Masked, Bark.Material));
	RenderUntilComplete(First);
	Bark.Texture.Reset();
	Lose();
	EXPECT_EQ(RenderOn(First).Code, ERTResult::DeviceLost);
	ASSERT_OK(Renderer->Recreate(Second.Device.Get(), GetSource()));
	EXPECT_EQ(CountDestroyed("Bark"), 1u) << "the lost device's texture is held";
	RenderUntilComplete(Second);
	std::swap(Device, Second.Device); // of which MakeTexturedMaterial makes it
	FTexturedMaterial New = MakeTexturedMaterial("Bark");
	std::swap(Device, Second.Device);
	ASSERT_OK(Renderer->SetMaterial(Masked, New.Material));
	RenderUntilComplete(Second);
	EXPECT_EQ(Describe(Second).size(), 3u);
}

TEST_F(FModuleDeviceLossTest, OtherThreadsGoOnMeanwhile)
{
	RenderUntilComplete(First);
	Lose();
	std::atomic<bool> bStop = false;
	std::thread Game([&] {
		while (!bStop)
		{
			double Place[12] = {1, 0, 0, 5, 0, 1, 0, 0, 0, 0, 1, 0};
			EXPECT_TRUE(Renderer->SetObjectTransform(Objects[0], Place).IsOk());
			ERTMaterialHandle Added = ERTMaterialHandle::None;
			EXPECT_TRUE(Renderer->AddMaterial({}, &Added).IsOk());
			EXPECT_TRUE(Renderer->RemoveMaterial(Added).IsOk());
			ERTMeshHandle Mesh = ERTMeshHandle::None; // the device may be either
			if (Renderer->AddMesh(DescribeTriangle(), &Mesh)) { EXPECT_TRUE(Renderer->RemoveMesh(Mesh).IsOk()); }
		}
	});
	EXPECT_EQ(RenderOn(First).Code, ERTResult::DeviceLost);
	ASSERT_OK(Renderer->Recreate(Second.Device.Get(), GetSource()));
	for (int Frame = 0; Frame < 20; ++Frame) { EXPECT_TRUE(RenderOn(Second).IsOk()); }
	bStop = true;
	Game.join();
	RenderUntilComplete(Second);
	EXPECT_EQ(Describe(Second).size(), 3u);
}

} // namespace
} // namespace Lantern
