// Gathering and pre-binding beside the frame: the same frame comes out however the work is spread, the render thread
// goes on meanwhile, and errors within the tasks are the frame's.
#include "FrameTaskTools.h"

namespace Lantern
{
namespace
{

TEST_F(FFrameTaskTest, EveryCombinationRecordsTheSame)
{
	constexpr int Frames = 10;
	std::vector<std::vector<std::string>> Calls;
	std::vector<std::string> Rays;
	for (int Combination = 0; Combination < Combinations; ++Combination)
	{
		Open();
		SetToggles(Combination);
		ASSERT_TRUE(Load(Everything));
		for (int Frame = 0; Frame < Frames; ++Frame)
		{
			if (Frame > 0) { ChangeScene(Frame); }
			Render(0.1 * Frame);
			const std::string Where = "combination " + std::to_string(Combination) + ", frame " + std::to_string(Frame);
			if (Combination == 0)
			{
				Calls.push_back(DescribeCalls());
				Rays.push_back(DescribeRays());
				EXPECT_FALSE(Rays.back().empty());
			}
			else
			{
				EXPECT_EQ(DescribeCalls(), Calls[Frame]) << Where;
				EXPECT_EQ(DescribeRays(), Rays[Frame]) << Where;
			}
		}
	}
}

/// The device gets the same commands in the same order, whether tasks record passes or the render thread alone.
TEST_F(FFrameTaskTest, RecordingTasksChangeNothingThatTheDeviceSees)
{
	const auto IsOfAList = [](const std::string& Line) {
		const std::string Kind = Line.substr(0, Line.find(' '));
		return Kind == std::to_string(static_cast<int>(ERTMockCall::Begin)) || Kind == std::to_string(static_cast<int>(ERTMockCall::End));
	};
	std::vector<std::vector<std::string>> Calls;
	for (const bool bTasks : {false, true})
	{
		Open();
		SetRecordingTasks(bTasks);
		ASSERT_TRUE(Load(Everything));
		for (int Frame = 0; Frame < 10; ++Frame)
		{
			if (Frame > 0) { ChangeScene(Frame); }
			Render(0.1 * Frame);
			std::vector<std::string> Now = DescribeCalls();
			std::erase_if(Now, IsOfAList);
			if (!bTasks) { Calls.push_back(std::move(Now)); }
			else { EXPECT_EQ(Now, Calls[Frame]) << "frame " << Frame; }
		}
	}
}

TEST_F(FFrameTaskTest, AnySequenceOfTogglesGivesTheSameRays)
{
	std::vector<std::string> Rays;
	for (const bool bToggle : {false, true})
	{
		std::mt19937 Random(7);
		Open();
		SetToggles(0);
		ASSERT_TRUE(Load(Everything));
		for (int Frame = 0; Frame < 60; ++Frame)
		{
			if (Frame > 0) { ChangeScene(Frame % 8); }
			if (bToggle) { SetToggles(static_cast<int>(Random() % Combinations)); }
			Set("r.RT.SBT.Mode", Frame % 5 == 3 ? "0" : "1");
			Set("r.RT.AlphaTest", Frame % 7 == 6 ? "0" : "1");
			Render(0.1 * Frame);
			if (!bToggle) { Rays.push_back(DescribeRays()); }
			else { EXPECT_EQ(DescribeRays(), Rays[Frame]) << "frame " << Frame; }
		}
	}
}

TEST_F(FFrameTaskTest, TasksRunWhileTheRenderThreadRecords)
{
	if (GetWorkerCount() < 2) { GTEST_SKIP() << "one core"; }
	StartTrace();
	ASSERT_TRUE(Load(Everything));
	bool bSeen = false;
	const auto Busy = [&] { bSeen = WaitForEvent("Prebind") && WaitForEvent("Gather instances"); };
	ASSERT_TRUE(RenderWith([&](FFrameContext& Context) { AddPass(Context, "Busy", Busy); }));
	EXPECT_TRUE(bSeen) << "the render thread was in a pass of the host's all the time";
	EXPECT_NE(FindEvent("Prebind").Thread, FindEvent("Record passes").Thread);
	EXPECT_NE(FindEvent("Gather instances").Thread, FindEvent("Record passes").Thread);
	EXPECT_EQ(CountEvents("Shader records"), 0u);
	DescribeRays();
}

TEST_F(FFrameTaskTest, RenderThreadNeverWaitsForWorkersThatAreBusy)
{
	StartTrace();
	ASSERT_TRUE(Load(Everything));
	FBlockedWorkers Blocked;
	ASSERT_TRUE(Blocked.AreAllBlocked());
	size_t Began = ~0ull;
	const auto Host = [&] { Began = CountEvents("Prebind") + CountEvents("Gather instances"); };
	ASSERT_TRUE(RenderWith([&](FFrameContext& Context) { AddPass(Context, "Host", Host); }))
	    << "with no worker free the render thread does it itself";
	EXPECT_EQ(Began, 0u) << "not before it is needed";
	EXPECT_EQ(FindEvent("Prebind").Thread, FindEvent("Record passes").Thread);
	EXPECT_EQ(FindEvent("Gather instances").Thread, FindEvent("Record passes").Thread);
	DescribeRays();
	Blocked.Open();
}

TEST_F(FFrameTaskTest, WithoutHoistingAllIsOnTheRenderThread)
{
	StartTrace();
	SetToggles(0);
	ASSERT_TRUE(Load(Everything));
	ASSERT_TRUE(RenderWith([](FFrameContext&) {}));
	EXPECT_EQ(CountEvents("Prebind"), 0u);
	EXPECT_EQ(FindEvent("Shader records").Thread, FindEvent("Record passes").Thread);
	EXPECT_EQ(FindEvent("Gather instances").Thread, FindEvent("BeginFrame").Thread);
	EXPECT_LE(FindEvent("Gather instances").EndNs, FindEvent("BeginFrame").EndNs);
}

TEST_F(FFrameTaskTest, StructuresAreRecordedBehindTheHostsPasses)
{
	ASSERT_TRUE(Load(Everything));
	Mock().ClearCalls();
	ASSERT_TRUE(RenderWith([](FFrameContext&) {}));
	const std::vector<std::string> Passes = GetPasses();
	const auto At = [&](const char* Name) { return std::find(Passes.begin(), Passes.end(), Name) - Passes.begin(); };
	EXPECT_LT(At("SceneUpdate"), At("GBuffer"));
	EXPECT_LT(At("GBuffer"), At("Structures"));
	EXPECT_LT(At("Structures"), At("SunShadow"));
	EXPECT_LT(At("ShaderTable"), At("SunShadow"));
}

TEST_F(FFrameTaskTest, HostThatTracesMayAskForStructuresEarlyOrLate)
{
	Set("r.RT.Shadow", "0");
	Set("r.RT.Lights", "0");
	ASSERT_TRUE(Load(Everything));
	for (const bool bLate : {false, true})
	{
		FFrameFeatures Features;
		Features.bRays = true;
		Features.bLateRays = bLate;
		FRenderer& Renderer = Engine->GetRenderer();
		ChangeScene(bLate ? 1 : 3);
		Mock().ClearCalls();
		FConsoleVariables::Get().BeginFrame();
		ASSERT_TRUE(Renderer.BeginFrame(GetScene(), LookAt({0, 0, 5}, {0, 0, 0}, 1.0f, 40, 24), Features));
		AddPass(Renderer.GetContext(), "Host", [] {});
		if (bLate)
		{
			Renderer.GetContext().RequireRays();
			Renderer.GetContext().RequireRays();
		}
		AddPass(Renderer.GetContext(), "Trace", [] {});
		ASSERT_TRUE(Renderer.EndFrame(nullptr));
		std::vector<std::string> Passes = GetPasses();
		std::erase(Passes, "SceneUpdate");
		EXPECT_EQ(Passes,
		    bLate ? (std::vector<std::string>{"Host", "Structures", "Trace"}) : (std::vector<std::string>{"Structures", "Host", "Trace"}));
	}
}

TEST_F(FFrameTaskTest, FrameWhosePassesNeverTraceStillRecordsWhatItBegan)
{
	ASSERT_TRUE(Load({.bMasked = true}));
	FRenderer& Renderer = Engine->GetRenderer();
	FConsoleVariables::Get().BeginFrame();
	ASSERT_TRUE(Renderer.BeginFrame(GetScene(), LookAt({0, 0, 5}, {0, 0, 0}, 1.0f, 40, 24), {}));
	ASSERT_TRUE(Renderer.EndFrame(nullptr));
	DescribeRays();
	Mock().ClearCalls();
	Render();
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::BuildScene), 0u) << "it was built before";
}

TEST_F(FFrameTaskTest, TraceOfAFrameShowsItsParts)
{
	StartTrace();
	ASSERT_TRUE(Load(Everything));
	ASSERT_TRUE(RenderWith([](FFrameContext&) {}));
	const FTraceEvent Begin = FindEvent("BeginFrame"), Record = FindEvent("Record passes"), Submit = FindEvent("Submit");
	EXPECT_LE(Begin.EndNs, Record.BeginNs);
	EXPECT_LE(Record.EndNs, Submit.BeginNs);
	for (const char* Pass : {"Pass: GBuffer", "Pass: Structures", "Pass: ShaderTable", "Pass: SunShadow"})
	{
		const FTraceEvent Event = FindEvent(Pass);
		const bool bOnTask = std::string(Pass) == "Pass: GBuffer"; // on whichever thread is free
		EXPECT_TRUE(bOnTask || Event.Thread == Record.Thread) << Pass;
		EXPECT_LE(Record.BeginNs, Event.BeginNs) << Pass;
		EXPECT_GE(Record.EndNs, Event.EndNs) << Pass;
	}
}

} // namespace
} // namespace Lantern
