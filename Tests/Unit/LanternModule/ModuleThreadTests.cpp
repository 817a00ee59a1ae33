// Calls of the scene from several threads, and how frames take them over.
#include <atomic>
#include <thread>

#include "ModuleTestTools.h"

namespace Lantern
{
namespace
{

class FModuleThreadTest : public FModuleTest
{
protected:
	void SetUp() override
	{
		FModuleTest::SetUp();
		ASSERT_OK(SetSun(-1.0));
		ASSERT_OK(AddObject(AddOpaqueMesh(), Solid)); // there is always something to build over
	}
	/// Instances of the last structure that was built.
	uint64_t CountInstances() { return Mock().FindCalls(ERTMockCall::BuildScene).back().Numbers[0]; }
	/// Things of all kinds come, change and go.
	void Stream(uint32_t Seed, uint32_t Rounds)
	{
		FRTStatus Status;
		const auto Do = [&](const FRTStatus& Each) { Status = Status ? Each : Status; };
		for (uint32_t Round = 0; Round < Rounds && Status; ++Round)
		{
			ERTMaterialHandle Material = ERTMaterialHandle::None;
			ERTMeshHandle Mesh = ERTMeshHandle::None;
			ERTObjectHandle Objects[2] = {};
			FRTModuleMesh Desc = DescribeTriangle();
			Desc.bDeformable = (Seed + Round) % 2 == 0;
			Do(Renderer->AddMaterial({}, &Material));
			Do(Renderer->AddMesh(Desc, &Mesh));
			for (ERTObjectHandle& Each : Objects)
			{
				FRTModuleObject Info;
				Info.Mesh = Mesh;
				Info.Materials = &Material;
				Info.MaterialCount = 1;
				Do(Renderer->AddObject(Info, &Each));
			}
			const double Transform[12] = {1, 0, 0, double(Seed), 0, 1, 0, double(Round), 0, 0, 1, 0};
			Do(Renderer->SetObjectTransform(Objects[0], Transform));
			if (Desc.bDeformable) { Do(Renderer->UpdateMeshVertices(Mesh, TrianglePositions, nullptr)); }
			Do(Renderer->SetObjectMaterials(Objects[1], &Solid, 1));
			FRTModuleMaterial Changed;
			Changed.BaseColor[0] = 0.25f;
			Do(Renderer->SetMaterial(Material, Changed));
			Do(Renderer->SetObjectCastsShadow(Objects[1], false));
			if (Renderer->RemoveMesh(Mesh).IsOk()) { Do(FRTStatus::Error(ERTResult::InvalidArgument, "a mesh in use was removed")); }
			for (const ERTObjectHandle Each : Objects) { Do(Renderer->RemoveObject(Each)); }
			Do(Renderer->RemoveMaterial(Material));
			Do(Renderer->RemoveMesh(Mesh));
			if (Renderer->RemoveObject(Objects[0]).IsOk()) { Do(FRTStatus::Error(ERTResult::InvalidArgument, "a stale handle was taken")); }
		}
		EXPECT_TRUE(Status.IsOk()) << Status.Message;
	}
};

TEST_F(FModuleThreadTest, SceneCallsComeFromAnyThread)
{
	constexpr uint32_t Threads = 4, Rounds = 200;
	std::atomic<uint32_t> Running = Threads;
	std::vector<std::thread> Streams;
	for (uint32_t Thread = 0; Thread < Threads; ++Thread)
	{
		Streams.emplace_back([&, Thread] {
			Stream(Thread, Rounds);
			--Running;
		});
	}
	do {
		EXPECT_TRUE(RenderWholeFrame().IsOk());
		GiveWay();
	}
	while (Running > 0);
	for (std::thread& Each : Streams) { Each.join(); }
	SetVariable("r.RT.Scene.ArrivalsPerFrame", "0");
	for (int Frame = 0; Frame < 4; ++Frame) { ASSERT_OK(RenderWholeFrame()); }
	EXPECT_EQ(CountInstances(), 1u) << "what came has gone again";
	EXPECT_EQ(CountDestroyed("Triangle"),
	    Mock().CountCalls(ERTMockCall::CreateBuffer, "Triangle") + Mock().CountCalls(ERTMockCall::CreateGeometry, "Triangle"));
}

TEST_F(FModuleThreadTest, AFrameTakesOverSoManyArrivals)
{
	for (int Frame = 0; Frame < 2; ++Frame) { ASSERT_OK(RenderWholeFrame()); }
	SetVariable("r.RT.Scene.ArrivalsPerFrame", "2");
	ASSERT_OK(RenderWholeFrame()); // takes over the variable's value
	bPrecache = false;             // it would take over all
	const ERTObjectHandle Early = Object;
	const ERTMeshHandle Mesh = AddMesh(DescribeTriangle());
	std::vector<ERTObjectHandle> Added;
	for (int I = 0; I < 5; ++I)
	{
		ASSERT_OK(AddObject(Mesh, Solid));
		Added.push_back(Object);
	}
	// What is said of a thing that has not come yet comes with it. A mesh counts as four and fills a frame.
	// Five objects and one change fill three.
	const double Far[12] = {1, 0, 0, 1e6, 0, 1, 0, 0, 0, 0, 1, 0};
	ASSERT_OK(Renderer->SetObjectTransform(Added[4], Far));
	// What has come is not held up by what has not.
	ASSERT_OK(Renderer->SetObjectTransform(Early, Far));
	const uint64_t Counts[] = {0, 2, 4, 4};
	for (int Frame = 0; Frame < 4; ++Frame)
	{
		ASSERT_OK(Render());
		if (Frame < 3) { EXPECT_FALSE(Outputs.bComplete); }
		ASSERT_OK(Renderer->EndFrame(nullptr));
		EXPECT_EQ(CountInstances(), Counts[Frame]) << Frame;
	}
}

TEST_F(FModuleThreadTest, WhatComesAndGoesBetweenFramesLeavesNothing)
{
	ASSERT_OK(RenderWholeFrame());
	const uint32_t Before = Mock().GetLiveObjectCount();
	Stream(0, 1);
	for (int Frame = 0; Frame < 4; ++Frame) { ASSERT_OK(RenderWholeFrame()); }
	Device->CollectGarbage();
	EXPECT_EQ(CountInstances(), 1u);
	EXPECT_LE(Mock().GetLiveObjectCount(), Before + 2) << "pages of vertices may stay";
}

} // namespace
} // namespace Lantern
