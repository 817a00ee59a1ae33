// Errors within the tasks of a frame are the frame's, and the next one recovers.
#include "FrameTaskTools.h"

namespace Lantern
{
namespace
{

using ::testing::HasSubstr;

TEST_F(FFrameTaskTest, FailedAllocationFailsItsFrameAndTheNextRecovers)
{
	for (int Combination = 0; Combination < Combinations; ++Combination)
	{
		int Failures = 0;
		for (uint32_t N = 1; N < 60; ++N)
		{
			Open();
			SetToggles(Combination);
			ASSERT_TRUE(Load(Everything));
			Mock().FailAllocation(N);
			const FRTStatus Status = RenderFrame();
			if (!Status)
			{
				++Failures;
				EXPECT_EQ(Status.Code, ERTResult::OutOfDeviceMemory) << Status.Message;
				EXPECT_GT(std::strlen(Status.Message), 0u);
			}
			Mock().FailAllocation(0);
			ChangeScene(1);
			Render(0.1);
			EXPECT_EQ(GetScene().GetFacts().Objects, Mock().GetSceneInstances(Unwrap(GetScene().GetStructure())).size());
			DescribeRays();
		}
		EXPECT_GT(Failures, 8) << "combination " << Combination;
	}
}

// A frame that fails, wherever it does, loses its own counts and no other's.
TEST_F(FFrameTaskTest, FramesThatFailLoseNoCountsOfOthers)
{
	Set("r.RT.Opacity.Count", "1");
	ASSERT_TRUE(Load(Everything));
	const auto Frame = [&] { return RenderWith([](FFrameContext&) {}).IsOk(); };
	uint32_t Submitted = 0, Failed = 0;
	for (int I = 0; I < 2; ++I) { Submitted += Frame() ? 1 : 0; } // what counts has its memory
	for (uint32_t N = 1; N < 12; ++N)
	{
		const FRTObjectInfo Object = GetScene().GetObject(Engine->GetScene().GetDraws()[1].Object);
		for (int I = 0; I < 64 << std::min(N, 5u); ++I) { GetScene().AddObject(FRTObjectInfo(Object)); } // tables and structures grow
		Mock().FailAllocation(N);
		const bool bOk = Frame();
		Mock().FailAllocation(0);
		(bOk ? Submitted : Failed) += 1;
		Submitted += Frame() ? 1 : 0;
	}
	ASSERT_TRUE(Engine->GetRenderer().WaitForAll());
	EXPECT_GT(Failed, 0u);
	EXPECT_EQ(Engine->GetRenderer().GetAnyHits().Frames, Submitted);
	GBufferPass.reset();
}

TEST_F(FFrameTaskTest, FrameLostByAPassRecovers)
{
	for (int Combination = 0; Combination < Combinations; ++Combination)
	{
		Open();
		SetToggles(Combination);
		ASSERT_TRUE(Load(Everything));
		Render();
		for (int Frame = 0; Frame < 6; ++Frame)
		{
			ChangeScene(Frame);
			const FRTStatus Status = RenderWith([&](FFrameContext& Context) {
				AddPass(Context, "Bad", [&Context] { Context.Fail(FRTStatus::Error(ERTResult::IoError, "the host's own error")); });
			});
			EXPECT_THAT(std::string(Status.Message), HasSubstr("the host's own error"));
		}
		Render(0.2);
		DescribeRays();
		GBufferPass.reset();
	}
}

TEST_F(FFrameTaskTest, RendererGoesWhileItsTasksRun)
{
	for (int Combination = 0; Combination < Combinations; ++Combination)
	{
		for (const bool bBlocked : {false, true})
		{
			ASSERT_TRUE(CreateMockDevice({}, Inner.ReleaseAndGetAddress()));
			FRendererDesc Desc;
			Desc.ShaderFolders = {GetShaderFolder()};
			Desc.CacheFolder = LANTERN_TEST_CACHE;
			SetToggles(Combination);
			FConsoleVariables::Get().BeginFrame();
			auto Renderer = std::make_unique<FRenderer>(*Inner, Desc);
			std::unique_ptr<FHostScene> Host;
			ASSERT_TRUE(FHostScene::Create(*Renderer, MakeDescription(Everything), {}, Host));
			Host->SetSun({.Irradiance = 3.0f});
			std::optional<FBlockedWorkers> Blocked;
			if (bBlocked) { Blocked.emplace(); }
			ASSERT_TRUE(Renderer->BeginFrame(Host->GetScene(), LookAt({0, 0, 5}, {0, 0, 0}, 1.0f, 40, 24), {}));
			Renderer.reset(); // before EndFrame
			Blocked.reset();
			Host.reset();
			Inner.Reset();
		}
	}
}

TEST_F(FFrameTaskTest, FrameThatIsGivenUpLeavesNoTaskBehind)
{
	StartTrace();
	ASSERT_TRUE(Load(Everything));
	FBlockedWorkers Blocked;
	ASSERT_TRUE(Blocked.AreAllBlocked());
	FRenderer& Renderer = Engine->GetRenderer();
	FConsoleVariables::Get().BeginFrame();
	ASSERT_TRUE(Renderer.BeginFrame(GetScene(), LookAt({0, 0, 5}, {0, 0, 0}, 1.0f, 40, 24), {}));
	EXPECT_EQ(CountEvents("Prebind"), 0u);
	Renderer.FrameSubmitted(0);
	EXPECT_EQ(CountEvents("Prebind"), 1u) << "the scene may change from now on";
	EXPECT_EQ(CountEvents("Gather instances"), 1u);
	Blocked.Open();
	ASSERT_TRUE(RenderWith([](FFrameContext&) {}));
	DescribeRays();
}

TEST_F(FFrameTaskTest, RayQueriesSeeObjectsWhoseProgramsAreMissing)
{
	ASSERT_TRUE(Load(Everything));
	GetScene().SetMissingPrograms({{StandardProgram, ERTHitClass::Opaque}});
	Set("r.RT.Shadow.Path", "2");
	ASSERT_TRUE(RenderFrame());
	ASSERT_FALSE(GetRTPSO());
	EXPECT_EQ(Mock().GetSceneInstances(Unwrap(GetScene().GetStructure())).size(), GetScene().GetFacts().Objects);
}

TEST_F(FFrameTaskTest, DeviceLossInTheTasksIsTheFramesError)
{
	for (int Combination = 0; Combination < Combinations; ++Combination)
	{
		for (const ERTMockCall Kind : {ERTMockCall::CreateShaderTable, ERTMockCall::CreateScene, ERTMockCall::CreateGeometry,
		         ERTMockCall::CreateBuffer, ERTMockCall::Submit})
		{
			Open();
			SetToggles(Combination);
			ASSERT_TRUE(Load(Everything));
			Mock().LoseDeviceAt(Kind);
			EXPECT_EQ(RenderFrame().Code, ERTResult::DeviceLost) << static_cast<int>(Kind);
			EXPECT_EQ(RenderFrame(0.1).Code, ERTResult::DeviceLost);
		}
	}
}

} // namespace
} // namespace Lantern
