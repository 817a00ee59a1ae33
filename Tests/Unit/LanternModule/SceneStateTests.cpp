// FSceneCalls and FSceneState without a module around them: what a frame looks at follows what changed, not what there is.
#include <atomic>
#include <thread>

#include <gtest/gtest.h>

#include "LanternRHIMock/MockDevice.h"
#include "SceneCalls.h"
#include "SceneState.h"

namespace Lantern
{
namespace
{

constexpr float Positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
constexpr uint32_t Indices[] = {0, 1, 2};

class FSceneStateTest : public ::testing::Test
{
protected:
	void SetUp() override
	{
		ASSERT_TRUE(CreateMockDevice({}, Device.ReleaseAndGetAddress()));
		Scene = std::make_unique<FRTScene>(*Device);
		Uploads = std::make_unique<FBufferUploads>(*Device);
		Calls = std::make_unique<FSceneCalls>(*Device, FModuleWorld(), *Uploads);
		State = std::make_unique<FSceneState>(*Device, *Scene, *Uploads);
		ASSERT_TRUE(Calls->AddMaterial({}, &Material));
	}
	ERTMeshHandle AddMesh()
	{
		FRTModuleMesh Mesh;
		Mesh.Name = "Cloth";
		Mesh.Positions = Positions;
		Mesh.VertexCount = Mesh.IndexCount = 3;
		Mesh.Indices = Indices;
		Mesh.bDeformable = true;
		ERTMeshHandle Out = ERTMeshHandle::None;
		EXPECT_TRUE(Calls->AddMesh(Mesh, &Out));
		return Out;
	}
	/// Takes over all commands, and returns how many there were.
	size_t Frame()
	{
		std::vector<FSceneCommand> Commands;
		EXPECT_FALSE(Calls->Take(0, Commands));
		const size_t Count = Commands.size();
		State->Apply(Commands);
		TRTRef<IRTCommandList> List;
		EXPECT_TRUE(Device->CreateCommandList("Frame", List.ReleaseAndGetAddress()));
		EXPECT_TRUE(List->Begin());
		EXPECT_TRUE(State->Record(*List));
		EXPECT_TRUE(List->End());
		IRTCommandList* const Lists[] = {List.Get()};
		FRTFence Fence = 0;
		EXPECT_TRUE(Device->Submit(Lists, 1, &Fence));
		State->EndFrame(Fence);
		return Count;
	}

	TRTRef<IRTDevice> Device;
	std::unique_ptr<FRTScene> Scene;
	std::unique_ptr<FBufferUploads> Uploads;
	std::unique_ptr<FSceneCalls> Calls;
	std::unique_ptr<FSceneState> State;
	ERTMaterialHandle Material = ERTMaterialHandle::None;
};

TEST_F(FSceneStateTest, AFrameVisitsTheMeshesThatChanged)
{
	std::vector<ERTMeshHandle> Meshes;
	for (int I = 0; I < 2000; ++I) { Meshes.push_back(AddMesh()); }
	for (int I = 0; I < 8; ++I) { Frame(); } // until all are on the GPU
	EXPECT_EQ(State->GetVisitedMeshes(), 0u) << "nothing changed";
	for (const int Which : {7, 1500, 3, 7}) { ASSERT_TRUE(Calls->UpdateMeshVertices(Meshes[Which], Positions, nullptr)); }
	EXPECT_EQ(Frame(), 3u) << "two calls for one mesh are one change";
	EXPECT_EQ(State->GetVisitedMeshes(), 3u);
	EXPECT_EQ(Frame(), 0u);
	EXPECT_EQ(State->GetVisitedMeshes(), 0u);
}

TEST_F(FSceneStateTest, ThreadsCallWhileFramesRun)
{
	std::atomic<uint32_t> Running = 3;
	const auto Stream = [&] {
		for (int Round = 0; Round < 100; ++Round)
		{
			const ERTMeshHandle Mesh = AddMesh();
			FRTModuleObject Object;
			Object.Mesh = Mesh;
			Object.Materials = &Material;
			Object.MaterialCount = 1;
			ERTObjectHandle Handle = ERTObjectHandle::None;
			EXPECT_TRUE(Calls->AddObjects(&Object, 1, &Handle));
			EXPECT_TRUE(Calls->UpdateMeshVertices(Mesh, Positions, nullptr));
			EXPECT_TRUE(Calls->SetObjectCastsShadow(Handle, Round % 2 == 0));
			EXPECT_TRUE(Calls->RemoveObject(Handle));
			EXPECT_TRUE(Calls->RemoveMesh(Mesh));
		}
		--Running;
	};
	std::vector<std::thread> Threads;
	for (uint32_t Thread = 0; Thread < 3; ++Thread) { Threads.emplace_back(Stream); }
	do {
		Frame();
	}
	while (Running > 0);
	for (std::thread& Thread : Threads) { Thread.join(); }
	Frame();
	EXPECT_EQ(Scene->RefreshFacts().Objects, 0u);
}

TEST_F(FSceneStateTest, AMaterialThatBecomesMaskedIsOneCommand)
{
	const ERTMeshHandle Mesh = AddMesh();
	for (int I = 0; I < 1000; ++I)
	{
		FRTModuleObject Object;
		Object.Mesh = Mesh;
		Object.Materials = &Material;
		Object.MaterialCount = 1;
		ERTObjectHandle Handle = ERTObjectHandle::None;
		ASSERT_TRUE(Calls->AddObjects(&Object, 1, &Handle));
	}
	Frame();
	FRTModuleMaterial Masked;
	Masked.bMasked = true;
	ASSERT_TRUE(Calls->SetMaterial(Material, Masked));
	EXPECT_EQ(Frame(), 1u);
	EXPECT_TRUE(Scene->RefreshFacts().bMasked);
}

} // namespace
} // namespace Lantern
