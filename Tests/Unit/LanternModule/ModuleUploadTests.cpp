// New meshes on their way to the GPU: nothing waits, a frame does so much and no more, and what arrives is what was handed over.
#include <cstring>

#include "ModuleTestTools.h"

namespace Lantern
{
namespace
{

class FModuleUploadTest : public FModuleTest
{
protected:
	void SetUp() override
	{
		FModuleTest::SetUp();
		ASSERT_OK(SetSun(-1.0));
	}
	/// A mesh of Count triangles whose coordinates tell them apart.
	struct FMany
	{
		std::vector<float> Positions;
		std::vector<uint32_t> Indices;
		FRTModuleMesh Mesh;
	};
	static FMany MakeMany(const char* Name, uint32_t Count)
	{
		FMany Out;
		for (uint32_t I = 0; I < Count * 3; ++I)
		{
			Out.Positions.insert(Out.Positions.end(), {float(I), float(I % 3 == 1), float(I % 3 == 2)});
			Out.Indices.push_back(Count * 3 - 1 - I);
		}
		Out.Mesh.Name = Name;
		Out.Mesh.Positions = Out.Positions.data();
		Out.Mesh.VertexCount = Count * 3;
		Out.Mesh.Indices = Out.Indices.data();
		Out.Mesh.IndexCount = Count * 3;
		return Out;
	}
	/// Adds an object of the mesh, and renders a frame that is lost and one that is not.
	void AddInALostFrame(const FMany& Many)
	{
		ASSERT_OK(AddObject(AddMesh(Many.Mesh), Solid));
		Mock().FailEveryAllocation(1);
		EXPECT_FALSE(Render().IsOk());
		Mock().FailEveryAllocation(0);
		ASSERT_OK(RenderWholeFrame());
	}
	static uint64_t GetBytes(const FMany& Many) { return Many.Mesh.VertexCount * (12ull + 28ull) + Many.Mesh.IndexCount * 4ull; }
	/// Replaces the renderer by one that is made under the present variables.
	void Restart()
	{
		Renderer.Reset();
		ASSERT_OK(Module->CreateRenderer(Device.Get(), {}, Renderer.ReleaseAndGetAddress()));
		ASSERT_OK(Renderer->AddMaterial({}, &Solid));
		ASSERT_OK(SetSun(-1.0));
	}
	uint64_t CountCopiedBytes()
	{
		uint64_t Bytes = 0;
		for (const FRTMockCall& Call : Mock().FindCalls(ERTMockCall::CopyBuffer, "Many")) { Bytes += Call.Numbers[2]; }
		return Bytes;
	}
	bool IsBuilt(const char* Name) { return Mock().CountCalls(ERTMockCall::BuildGeometry, Name) > 0; }
	void RenderUntilBuilt(const char* Name)
	{
		const auto Step = [&] {
			ASSERT_OK(RenderWholeFrame());
			GiveWay();
		};
		ASSERT_TRUE(WaitUntil(
		    "a mesh on its way", [&] { return IsBuilt(Name); }, Step));
	}
	/// Reads the mesh from the device and compares it.
	void ExpectArrived(const FMany& Many)
	{
		const auto Buffers = Mock().FindLiveBuffers(Many.Mesh.Name);
		ASSERT_EQ(Buffers.size(), 1u);
		const uint8_t* const Bytes = Mock().GetBytes(Buffers[0]);
		ASSERT_EQ(Buffers[0]->GetDesc().Size, GetBytes(Many));
		const size_t PositionBytes = Many.Positions.size() * 4, IndexBytes = Many.Indices.size() * 4;
		EXPECT_EQ(std::memcmp(Bytes, Many.Positions.data(), PositionBytes), 0);
		EXPECT_EQ(std::memcmp(Bytes + GetBytes(Many) - IndexBytes, Many.Indices.data(), IndexBytes), 0);
	}
	/// Frames wait only for the frames before the last ones.
	FRTStatus RenderBehind()
	{
		if (const FRTFence Last = Mock().GetLastFence(); Last > 1) { Mock().CompleteUpTo(Last - 1); }
		return RenderWholeFrame();
	}
	void ExpectNoWaits()
	{
		EXPECT_EQ(Mock().CountCalls(ERTMockCall::WaitIdle), 0u);
		EXPECT_EQ(Mock().GetBlockingWaits(), 0u);
	}
};

TEST_F(FModuleUploadTest, AddingMeshesWaitsForNothing)
{
	Mock().SetManualFences(true); // whoever waited would find work unfinished
	for (int Round = 0; Round < 10; ++Round)
	{
		const uint32_t Waits = Mock().CountCalls(ERTMockCall::WaitFor);
		for (int I = 0; I < 10; ++I) { ASSERT_OK(AddObject(AddMesh(DescribeTriangle()), Solid)); }
		EXPECT_EQ(Mock().CountCalls(ERTMockCall::WaitFor), Waits);
		ASSERT_OK(RenderBehind());
	}
	ExpectNoWaits();
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::Submit), 0u) << "copies run within the engine's frames";
	EXPECT_EQ(CountCopies("Triangle"), 100u);
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::BuildGeometry, "Triangle"), 100u);
	Mock().SetManualFences(false);
}

TEST_F(FModuleUploadTest, AFrameCopiesSoMuchAndNoMore)
{
	SetVariable("r.RT.Upload.MBPerFrame", "1");
	const FMany Many = MakeMany("Many", 60'000); // 9.6 MB
	ASSERT_OK(AddObject(AddMesh(Many.Mesh), Solid));
	ASSERT_OK(RenderWholeFrame()); // takes over the variable's value
	Mock().ClearCalls();
	uint64_t Copied = CountCopiedBytes();
	for (int Frame = 0; Frame < 20 && !IsBuilt("Many"); ++Frame)
	{
		ASSERT_OK(Render());
		EXPECT_LE(CountCopiedBytes() - Copied, 1u << 20);
		if (!IsBuilt("Many")) { EXPECT_FALSE(Outputs.bComplete); }
		ASSERT_OK(Renderer->EndFrame(nullptr));
		Copied = CountCopiedBytes();
	}
	ExpectArrived(Many);
	ExpectNoWaits();
}

TEST_F(FModuleUploadTest, WhatIsLargerThanTheRingComesInPieces)
{
	SetVariable("r.RT.Upload.StagingMB", "1");
	ASSERT_NO_FATAL_FAILURE(Restart());
	const FMany Many = MakeMany("Many", 30'000), Other = MakeMany("Other", 20'000);
	ASSERT_OK(AddObject(AddMesh(Many.Mesh), Solid));
	ASSERT_OK(AddObject(AddMesh(Other.Mesh), Solid));
	ASSERT_NO_FATAL_FAILURE(RenderUntilBuilt("Many"));
	ASSERT_NO_FATAL_FAILURE(RenderUntilBuilt("Other"));
	ExpectArrived(Many);
	ExpectArrived(Other);
	ExpectNoWaits();
}

TEST_F(FModuleUploadTest, StagingIsNotWrittenOverWhileTheGpuReadsIt)
{
	SetVariable("r.RT.Upload.StagingMB", "1");
	ASSERT_NO_FATAL_FAILURE(Restart());
	Mock().SetManualFences(true); // copies run late: they find what the ring holds then
	const FMany Many = MakeMany("Many", 30'000);
	ASSERT_OK(AddObject(AddMesh(Many.Mesh), Solid));
	const auto Step = [&] {
		ASSERT_OK(RenderBehind());
		GiveWay();
	};
	ASSERT_TRUE(WaitUntil(
	    "a mesh on its way", [&] { return IsBuilt("Many"); }, Step));
	ExpectNoWaits();
	Mock().SetManualFences(false);
	ExpectArrived(Many);
}

TEST_F(FModuleUploadTest, MeshesOfALostFrameAreCopiedAgain)
{
	const FMany Many = MakeMany("Many", 10);
	ASSERT_NO_FATAL_FAILURE(AddInALostFrame(Many));
	EXPECT_EQ(CountCopies("Many"), 2u);
	EXPECT_TRUE(IsBuilt("Many"));
	ExpectArrived(Many);
}

TEST_F(FModuleUploadTest, MeshesMayGoWhileTheyAreOnTheirWay)
{
	SetVariable("r.RT.Upload.MBPerFrame", "1");
	ASSERT_OK(RenderWholeFrame());
	const FMany Many = MakeMany("Many", 30'000);
	const ERTMeshHandle Mesh = AddMesh(Many.Mesh);
	ASSERT_OK(AddObject(Mesh, Solid));
	ASSERT_OK(RenderWholeFrame());
	ASSERT_OK(Renderer->RemoveObject(Object));
	ASSERT_OK(Renderer->RemoveMesh(Mesh));
	for (int Frame = 0; Frame < 12; ++Frame) { ASSERT_OK(RenderWholeFrame()); }
	EXPECT_FALSE(IsBuilt("Many"));
	EXPECT_EQ(CountDestroyed("Many"), 1u) << "its memory was kept";
	ASSERT_OK(Render());
	EXPECT_TRUE(WaitUntil(
	    "shaders",
	    [&] {
		return Outputs.bComplete;
	    },
	    [&] {
		ASSERT_OK(Renderer->EndFrame(nullptr));
		GiveWay();
		ASSERT_OK(Render());
	})) << "something still waits for it";
	ASSERT_OK(Renderer->EndFrame(nullptr));
}

TEST_F(FModuleUploadTest, WithoutMemoryForItAMeshIsRefused)
{
	ERTMeshHandle Mesh = ERTMeshHandle::None;
	for (uint32_t Failing = 1; Failing <= 2; ++Failing) // the mesh's buffer, the ring
	{
		Mock().FailAllocation(Failing);
		EXPECT_EQ(Renderer->AddMesh(DescribeTriangle(), &Mesh).Code, ERTResult::OutOfDeviceMemory);
		EXPECT_EQ(Mesh, ERTMeshHandle::None);
	}
	ASSERT_OK(AddObject(AddMesh(DescribeTriangle()), Solid));
	ASSERT_OK(RenderWholeFrame());
	EXPECT_TRUE(IsBuilt("Triangle"));
}

/// A device with a queue for copies.
class FModuleTransferTest : public FModuleUploadTest
{
protected:
	FRTMockDesc DescribeMock() const override
	{
		FRTMockDesc Desc;
		Desc.bTransferQueue = true;
		return Desc;
	}
	uint32_t CountTransfers()
	{
		uint32_t Count = 0;
		for (const FRTMockCall& Call : Mock().FindCalls(ERTMockCall::Submit)) { Count += Call.Numbers[2] == uint64_t(ERTQueue::Transfer); }
		return Count;
	}
};

TEST_F(FModuleTransferTest, MeshesAreCopiedBesideTheFrame)
{
	const FMany Many = MakeMany("Many", 100);
	ASSERT_OK(AddObject(AddMesh(Many.Mesh), Solid));
	ASSERT_OK(RenderWholeFrame());
	EXPECT_EQ(CountTransfers(), 1u);
	for (const FRTMockCall& Call : Mock().FindCalls(ERTMockCall::CopyBuffer, "Many")) { EXPECT_EQ(Call.List, "Uploads"); }
	EXPECT_TRUE(IsBuilt("Many"));
	ExpectArrived(Many);
	ASSERT_OK(RenderWholeFrame());
	EXPECT_EQ(CountTransfers(), 1u) << "nothing is new";
	ExpectNoWaits();
}

TEST_F(FModuleTransferTest, WhatIsStillBeingCopiedIsNotBuilt)
{
	Mock().SetManualFences(true);
	const FMany Many = MakeMany("Many", 100);
	ASSERT_OK(AddObject(AddMesh(Many.Mesh), Solid));
	ASSERT_OK(RenderWholeFrame());
	EXPECT_FALSE(IsBuilt("Many"));
	ExpectNoWaits();
	Mock().CompleteUpTo(Mock().GetLastFence());
	ASSERT_OK(RenderWholeFrame());
	EXPECT_TRUE(IsBuilt("Many"));
	Mock().SetManualFences(false);
	ExpectArrived(Many);
}

TEST_F(FModuleTransferTest, ALostFrameTakesTheMeshOverOnceMore)
{
	const FMany Many = MakeMany("Many", 10);
	ASSERT_NO_FATAL_FAILURE(AddInALostFrame(Many));
	EXPECT_EQ(CountCopies("Many"), 1u) << "the copy itself was not lost";
	EXPECT_TRUE(IsBuilt("Many"));
}

TEST_F(FModuleTransferTest, VerticesThatComeBeforeTheMeshIsThereWait)
{
	Mock().SetManualFences(true);
	const ERTMeshHandle Cloth = AddDeformableMesh();
	ASSERT_OK(AddObject(Cloth, Solid));
	const float Moved[] = {0, 0, 1, 2, 0, 0, 0, 3, 0};
	ASSERT_OK(Renderer->UpdateMeshVertices(Cloth, Moved, nullptr));
	ASSERT_OK(RenderWholeFrame());
	EXPECT_EQ(CountCopies("Cloth"), 1u) << "the new vertices would be written over";
	Mock().CompleteUpTo(Mock().GetLastFence());
	ASSERT_OK(RenderWholeFrame());
	EXPECT_EQ(CountCopies("Cloth"), 2u);
	Mock().SetManualFences(false);
	const auto Buffers = Mock().FindLiveBuffers("Cloth");
	ASSERT_EQ(Buffers.size(), 1u);
	EXPECT_EQ(std::memcmp(Mock().GetBytes(Buffers[0]), Moved, sizeof(Moved)), 0);
}

TEST_F(FModuleTransferTest, TheQueueCanBeLeftAlone)
{
	SetVariable("r.RT.Upload.TransferQueue", "0");
	ASSERT_OK(RenderWholeFrame());
	ASSERT_OK(AddObject(AddMesh(DescribeTriangle()), Solid));
	ASSERT_OK(RenderWholeFrame());
	EXPECT_EQ(CountTransfers(), 0u);
	EXPECT_TRUE(IsBuilt("Triangle"));
}

} // namespace
} // namespace Lantern
