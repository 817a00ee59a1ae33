// Gathering and pre-binding beside the frame: the same frame comes out however the work is spread, the render thread
// goes on meanwhile, and errors within the tasks are the frame's.
#include <condition_variable>
#include <random>
#include <thread>

#include "LanternCore/TaskTrace.h"
#include "RendererTestTools.h"

namespace Lantern
{
namespace
{

using ::testing::Contains;
using ::testing::HasSubstr;

constexpr FContent Everything{
    .bMasked = true, .bSkinned = true, .bLights = true, .bTexture = true, .bEmissive = true, .bSky = true};

/// Keeps all of TBB's workers but the calling thread busy until Open.
class FBlockedWorkers
{
public:
	FBlockedWorkers()
	{
		const size_t Workers = GetWorkerCount() - 1;
		for (size_t I = 0; I < Workers; ++I)
		{
			Group.Run(
			    [this]
			    {
				    std::unique_lock Lock(Mutex);
				    ++Blocked;
				    Changed.notify_all();
				    Changed.wait(Lock, [&] { return bOpen; });
			    });
		}
		std::unique_lock Lock(Mutex);
		bAllBlocked = Changed.wait_for(Lock, std::chrono::seconds(20), [&] { return Blocked == Workers; });
	}
	~FBlockedWorkers() { Open(); }
	bool AreAllBlocked() const { return bAllBlocked; }
	void Open()
	{
		{
			std::lock_guard Lock(Mutex);
			bOpen = true;
		}
		Changed.notify_all();
		Group.Wait();
	}

private:
	std::mutex Mutex;
	std::condition_variable Changed;
	size_t Blocked = 0;
	bool bOpen = false, bAllBlocked = false;
	FTaskGroup Group;
};

class FFrameTaskTest : public FRendererTest
{
protected:
	void SetUp() override
	{
		FRendererTest::SetUp();
		Set("r.RT.Shadow.Path", "1");
	}
	void TearDown() override
	{
		GBufferPass.reset();
		FTaskTrace::Stop();
		FTaskTrace::Clear();
		FRendererTest::TearDown();
	}
	FRTScene& GetScene() { return Engine->GetScene().GetScene(); }
	static void SetToggles(int Combination)
	{
		if (FConsoleVariables::Get().Find("r.RT.Scene.Hoist"))
		{
			Set("r.RT.Scene.Hoist", Combination & 1 ? "1" : "0");
		}
		Set("r.RT.SBT.Prebind", Combination & 2 ? "1" : "0");
	}
	static constexpr int Combinations = 4;

	/// What a frame's rays would find: transforms, and the shaders and data of every record.
	std::string DescribeRays()
	{
		std::string Text;
		const std::vector<FRTMockInstance> Instances = Mock().GetSceneInstances(Unwrap(GetScene().GetStructure()));
		for (uint32_t I = 0; I < Instances.size(); ++I)
		{
			const FRTMockRecord Record = Resolve(I, 0);
			EXPECT_TRUE(Record.IsGood()) << Record.Error;
			Text += Instances[I].GeometryName + ' ' + Record.AnyHit + " :";
			for (const float Value : Instances[I].Instance.Transform)
			{
				Text += ' ' + std::to_string(Value);
			}
			Text += '\n';
		}
		return Text;
	}
	/// Recorded calls without what follows from addresses.
	std::vector<std::string> DescribeCalls()
	{
		std::vector<std::string> Lines;
		for (const FRTMockCall& Call : Mock().GetCalls())
		{
			if (Call.List.empty())
			{
				continue;
			}
			std::string Line = std::to_string(static_cast<int>(Call.Kind)) + ' ' + Call.Name;
			for (const uint64_t Number : Call.Numbers)
			{
				Line += ' ' + std::to_string(Number);
			}
			Lines.push_back(Line + ' ' + std::to_string(Call.Bytes.size()));
		}
		return Lines;
	}
	/// One frame of a short film in which something of everything changes.
	void ChangeScene(int Frame)
	{
		FHostScene& Host = Engine->GetScene();
		glm::dmat4 Transform(1.0);
		Transform[3] = glm::dvec4(0.1 * Frame, 0, 0, 1);
		Host.SetTransform(0, Transform);
		if (Frame == 2)
		{
			Added = GetScene().AddObject(GetScene().GetObject(Host.GetDraws()[1].Object));
		}
		if (Frame == 4)
		{
			GetScene().SetMaterials(Added, {0});
		}
		if (Frame == 6)
		{
			GetScene().RemoveObject(Added);
		}
		if (Frame == 7)
		{
			FMaterialData Material = GetScene().GetMaterials()[1];
			Material.Flags ^= MATERIAL_MASKED;
			GetScene().SetMaterial(1, Material);
		}
	}
	/// A frame of the host's own, with Before added in front of all that traces.
	FRTStatus RenderWith(const std::function<void(FFrameContext&)>& Before)
	{
		FRenderer& Renderer = Engine->GetRenderer();
		FView View = LookAt({0, 0, 5}, {0, 0, 0}, 1.0f, 40, 24);
		View.FrameIndex = FrameIndex++;
		if (FRTStatus S = Renderer.BeginFrame(GetScene(), View, {}); !S)
		{
			return S;
		}
		FFrameContext& Context = Renderer.GetContext();
		if (!GBufferPass)
		{
			GBufferPass = std::make_unique<FGBufferPass>(Renderer);
		}
		const FGBuffer GBuffer = GBufferPass->Add(Context, Engine->GetScene());
		Before(Context);
		const FFrameOutputs Frame = AddFramePasses(Context, GBuffer);
		Context.Graph.AddPass("Use",
		                      [&](FPassBuilder& Builder) -> FPassExecute
		                      {
			                      Builder.NeverCull();
			                      Builder.Read(Frame.Display, ERTAccess::ShaderRead);
			                      return {};
		                      });
		return Renderer.EndFrame(nullptr);
	}
	static void AddPass(FFrameContext& Context, const char* Name, const std::function<void()>& Do)
	{
		Context.Graph.AddPass(Name,
		                      [&](FPassBuilder& Builder) -> FPassExecute
		                      {
			                      Builder.NeverCull();
			                      return [Do](FPassContext&) { Do(); };
		                      });
	}
	static size_t CountEvents(const std::string& Name)
	{
		const std::vector<FTraceEvent> Events = FTaskTrace::GetEvents();
		return std::count_if(Events.begin(), Events.end(), [&](const auto& Event) { return Name == Event.Name; });
	}
	static FTraceEvent FindEvent(const std::string& Name)
	{
		for (const FTraceEvent& Event : FTaskTrace::GetEvents())
		{
			if (Name == Event.Name)
			{
				return Event;
			}
		}
		ADD_FAILURE() << "no event " << Name;
		return {};
	}
	static bool WaitForEvent(const std::string& Name)
	{
		const auto End = std::chrono::steady_clock::now() + std::chrono::seconds(20);
		while (CountEvents(Name) == 0 && std::chrono::steady_clock::now() < End)
		{
			std::this_thread::yield();
		}
		return CountEvents(Name) > 0;
	}
	void StartTrace()
	{
		Set("r.RT.Trace.File", "/nonexistent/trace.json");
		Set("r.RT.Trace", "1");
	}

	FRTObjectId Added;
	std::unique_ptr<FGBufferPass> GBufferPass;
	uint32_t FrameIndex = 0;
};

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
			if (Frame > 0)
			{
				ChangeScene(Frame);
			}
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
			if (Frame > 0)
			{
				ChangeScene(Frame % 8);
			}
			if (bToggle)
			{
				SetToggles(static_cast<int>(Random() % Combinations));
			}
			Set("r.RT.SBT.Mode", Frame % 5 == 3 ? "0" : "1");
			Set("r.RT.AlphaTest", Frame % 7 == 6 ? "0" : "1");
			Render(0.1 * Frame);
			if (!bToggle)
			{
				Rays.push_back(DescribeRays());
			}
			else
			{
				EXPECT_EQ(DescribeRays(), Rays[Frame]) << "frame " << Frame;
			}
		}
	}
}

TEST_F(FFrameTaskTest, TasksRunWhileTheRenderThreadRecords)
{
	if (GetWorkerCount() < 2)
	{
		GTEST_SKIP() << "one core";
	}
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
	ASSERT_TRUE(Load(Everything));
	for (const bool bLate : {false, true})
	{
		FFrameFeatures Features;
		Features.bRays = true;
		Features.bLateRays = bLate;
		FRenderer& Renderer = Engine->GetRenderer();
		ChangeScene(bLate ? 1 : 3);
		Mock().ClearCalls();
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
		EXPECT_EQ(Passes, bLate ? (std::vector<std::string>{"Host", "Structures", "Trace"})
		                        : (std::vector<std::string>{"Structures", "Host", "Trace"}));
	}
}

TEST_F(FFrameTaskTest, FrameWhosePassesNeverTraceStillRecordsWhatItBegan)
{
	ASSERT_TRUE(Load({.bMasked = true}));
	FRenderer& Renderer = Engine->GetRenderer();
	ASSERT_TRUE(Renderer.BeginFrame(GetScene(), LookAt({0, 0, 5}, {0, 0, 0}, 1.0f, 40, 24), {}));
	ASSERT_TRUE(Renderer.EndFrame(nullptr));
	DescribeRays();
	Mock().ClearCalls();
	Render();
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::BuildScene), 0u) << "it was built before";
}

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
			EXPECT_EQ(GetScene().GetFacts().Objects,
			          Mock().GetSceneInstances(Unwrap(GetScene().GetStructure())).size());
			DescribeRays();
		}
		EXPECT_GT(Failures, 8) << "combination " << Combination;
	}
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
			const FRTStatus Status = RenderWith(
			    [&](FFrameContext& Context)
			    {
				    AddPass(Context, "Bad",
				            [&Context] { Context.Fail(FRTStatus::Error(ERTResult::IoError, "the host's own error")); });
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
			auto Renderer = std::make_unique<FRenderer>(*Inner, Desc);
			std::unique_ptr<FHostScene> Host;
			ASSERT_TRUE(FHostScene::Create(*Renderer, MakeDescription(Everything), {}, Host));
			Host->SetSun({.Irradiance = 3.0f});
			std::optional<FBlockedWorkers> Blocked;
			if (bBlocked)
			{
				Blocked.emplace();
			}
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
		for (const ERTMockCall Kind : {ERTMockCall::CreateShaderTable, ERTMockCall::CreateScene,
		                               ERTMockCall::CreateGeometry, ERTMockCall::CreateBuffer, ERTMockCall::Submit})
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

TEST_F(FFrameTaskTest, TraceOfAFrameShowsItsParts)
{
	StartTrace();
	ASSERT_TRUE(Load(Everything));
	ASSERT_TRUE(RenderWith([](FFrameContext&) {}));
	const FTraceEvent Begin = FindEvent("BeginFrame"), Record = FindEvent("Record passes"),
	                  Submit = FindEvent("Submit");
	EXPECT_LE(Begin.EndNs, Record.BeginNs);
	EXPECT_LE(Record.EndNs, Submit.BeginNs);
	for (const char* Pass : {"Pass: GBuffer", "Pass: Structures", "Pass: ShaderTable", "Pass: SunShadow"})
	{
		const FTraceEvent Event = FindEvent(Pass);
		EXPECT_EQ(Event.Thread, Record.Thread) << Pass;
		EXPECT_LE(Record.BeginNs, Event.BeginNs) << Pass;
		EXPECT_GE(Record.EndNs, Event.EndNs) << Pass;
	}
}

} // namespace
} // namespace Lantern
