// FRTModuleFrame::bSubmitAhead: what RenderFrame submits itself, what is left for the engine's list, and who waits.
#include <algorithm>

#include "ModuleTestTools.h"

namespace Lantern
{
namespace
{

class FModuleAheadTest : public FModuleTest
{
protected:
	void SetUp() override
	{
		FModuleTest::SetUp();
		Mesh = AddDeformableMesh();
		ASSERT_OK(AddObject(Mesh, Solid));
		ASSERT_OK(SetSun(-1.0));
	}
	/// Calls of the kind that came before the engine's submission, or in all.
	uint32_t CountBeforeNotice(ERTMockCall Kind)
	{
		uint32_t Count = 0;
		for (const FRTMockCall& Call : Mock().GetCalls())
		{
			if (Call.Kind == ERTMockCall::NotifyExternalSubmit) { break; }
			Count += Call.Kind == Kind ? 1 : 0;
		}
		return Count;
	}
	void RenderAhead(bool bAhead = true)
	{
		FRTModuleFrame Frame = DescribeFrame();
		Frame.bSubmitAhead = bAhead;
		Frame.Layout = Layout;
		Precache(Frame);
		Mock().ClearCalls();
		ASSERT_OK(Renderer->RenderFrame(Frame, &Outputs));
		Submits = CountBeforeNotice(ERTMockCall::Submit);
		ASSERT_OK(Renderer->EndFrame(nullptr));
	}
	/// Whether the list that traces is the one that builds the structures it traces.
	bool IsBuiltInTheEnginesList()
	{
		const std::vector<FRTMockCall> Builds = Mock().FindCalls(ERTMockCall::BuildGeometry);
		std::vector<FRTMockCall> Rays = Mock().FindCalls(ERTMockCall::DispatchIndirect);
		const std::vector<FRTMockCall> Traces = Mock().FindCalls(ERTMockCall::TraceRaysIndirect);
		Rays.insert(Rays.end(), Traces.begin(), Traces.end());
		EXPECT_EQ(Builds.size(), 1u);
		EXPECT_FALSE(Rays.empty());
		return !Builds.empty() && !Rays.empty() && Builds.front().Recording == Rays.back().Recording;
	}
	/// Renders until nothing of the scene waits any more.
	void Settle()
	{
		ASSERT_TRUE(WaitUntil(
		    "a complete frame", [&] { return Outputs.bComplete; }, [&] { RenderAhead(); }));
	}
	/// Sets new vertices, so that the next frame has a refit.
	void Deform()
	{
		const float Positions[] = {0, 0, 0, 1, 0, 0, 0, 1, float(++Deformed)};
		ASSERT_OK(Renderer->UpdateMeshVertices(Mesh, Positions, nullptr));
	}

	ERTMeshHandle Mesh = ERTMeshHandle::None;
	uint32_t Submits = 0; ///< in the last RenderFrame
	uint32_t Deformed = 0;
	FRTModuleGBufferLayout Layout;
};

TEST_F(FModuleAheadTest, SceneIsSubmittedBeforeTheEnginesList)
{
	Settle();
	Deform();
	RenderAhead();
	EXPECT_EQ(Submits, 1u);
	EXPECT_EQ(Outputs.Wait.Semaphore, 0u) << "one queue runs in order";
	EXPECT_NE(Outputs.Get(ESignal::SunShadow), nullptr);
	EXPECT_FALSE(IsBuiltInTheEnginesList());
	Deform();
	RenderAhead(false);
	EXPECT_EQ(Submits, 0u) << "all is in the engine's list";
	EXPECT_TRUE(IsBuiltInTheEnginesList());
}

/// The pass that converts the engine's G-buffer comes first, and reads nothing of the scene.
TEST_F(FModuleAheadTest, SceneOvertakesTheConversionOfTheGBuffer)
{
	Layout.Depth = ERTModuleDepth::Linear;
	Settle();
	Deform();
	RenderAhead();
	EXPECT_FALSE(IsBuiltInTheEnginesList());
}

TEST_F(FModuleAheadTest, FramesWithAndWithoutShowTheSame)
{
	Settle();
	const auto Run = [&](bool bAhead) {
		Deform();
		RenderAhead(bAhead);
		std::vector<std::string> Names;
		for (const FRTMockCall& Call : Mock().GetCalls())
		{
			const bool bWork = Call.Kind == ERTMockCall::BuildGeometry || Call.Kind == ERTMockCall::Dispatch ||
			                   Call.Kind == ERTMockCall::TraceRays || Call.Kind == ERTMockCall::BuildScene ||
			                   Call.Kind == ERTMockCall::DispatchIndirect || Call.Kind == ERTMockCall::TraceRaysIndirect;
			if (bWork) { Names.push_back(std::to_string(static_cast<int>(Call.Kind)) + Call.Name); }
		}
		std::sort(Names.begin(), Names.end());
		return Names;
	};
	const std::vector<std::string> Behind = Run(false);
	EXPECT_GT(Behind.size(), 2u);
	EXPECT_EQ(Run(true), Behind);
	EXPECT_EQ(Run(false), Behind);
}

/// The validation wrapper refuses a list that uses what another queue may still write: it would say so if EndFrame knew no wait.
TEST_F(FModuleAheadTest, ComputeQueueRunsBesideAndIsWaitedFor)
{
	SetVariable("r.RT.Async", "*");
	Settle();
	Mock().SetManualFences(true);
	bPrecache = false; // it would wait for the frames in flight
	for (int I = 0; I < 3; ++I)
	{
		if (I > 1) { Mock().CompleteUpTo(Mock().GetLastFence() - 2); } // all but the last frame
		Deform();
		RenderAhead();
		EXPECT_EQ(Submits, 1u);
		const std::vector<FRTMockCall> Submissions = Mock().FindCalls(ERTMockCall::Submit);
		ASSERT_EQ(Submissions.size(), 1u);
		EXPECT_EQ(Submissions[0].Numbers[2], uint64_t(ERTQueue::AsyncCompute));
		EXPECT_EQ(Submissions[0].Bytes.size(), sizeof(FRTFence)) << "the frame before";
		EXPECT_EQ(Outputs.Wait.Value, GetFenceValue(Submissions[0].Numbers[1]));
		const std::vector<FRTMockCall> Notices = Mock().FindCalls(ERTMockCall::NotifyExternalSubmit);
		ASSERT_EQ(Notices.size(), 1u);
		EXPECT_EQ(Notices[0].Bytes.size(), sizeof(FRTFence));
	}
	Mock().SetManualFences(false);
}

TEST_F(FModuleAheadTest, VerticesOfTheEnginesGpuAreWaitedFor)
{
	FRTModuleMesh Described = DescribeTriangle();
	Described.Name = "Skinned";
	Described.bDeformable = true;
	Described.BoundsRadius = 4.0f;
	Mesh = AddMesh(Described);
	ASSERT_OK(AddObject(Mesh, Solid));
	SetVariable("r.RT.Async", "*");
	Settle();
	RenderAhead();
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::NotifyExternalSubmit), 1u);
	ASSERT_OK(Renderer->MarkMeshDeformed(Mesh));
	RenderAhead();
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::NotifyExternalSubmit), 2u) << "one stands for the engine's work before RenderFrame";
	ASSERT_EQ(Mock().FindCalls(ERTMockCall::Submit).size(), 1u);
	EXPECT_EQ(Mock().FindCalls(ERTMockCall::Submit)[0].Bytes.size(), 2 * sizeof(FRTFence));
}

TEST_F(FModuleAheadTest, ListsAreUsedAgain)
{
	Settle();
	for (int I = 0; I < 3; ++I)
	{
		Deform();
		RenderAhead();
	}
	uint32_t Made = 0;
	for (int I = 0; I < 8; ++I)
	{
		Deform();
		RenderAhead();
		Made += Mock().CountCalls(ERTMockCall::CreateCommandList);
	}
	EXPECT_EQ(Made, 0u);
}

TEST_F(FModuleAheadTest, FailuresSubmitNothingAndTheNextFrameGoesOn)
{
	Settle();
	uint32_t Failures = 0;
	for (uint32_t N = 1; N <= 12; ++N)
	{
		Deform();
		FRTModuleFrame Frame = DescribeFrame();
		Frame.bSubmitAhead = true;
		Mock().ClearCalls();
		Mock().FailAllocation(N);
		const FRTStatus Status = Renderer->RenderFrame(Frame, &Outputs);
		Mock().FailAllocation(0);
		if (Status) { ASSERT_OK(Renderer->EndFrame(nullptr)); }
		else
		{
			++Failures;
			EXPECT_EQ(Status.Code, ERTResult::OutOfDeviceMemory);
			EXPECT_EQ(Mock().CountCalls(ERTMockCall::Submit), 0u);
		}
		RenderAhead();
		EXPECT_NE(Outputs.Get(ESignal::SunShadow), nullptr);
	}
	EXPECT_GT(Failures, 0u);
}

} // namespace
} // namespace Lantern
