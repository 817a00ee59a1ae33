// Frames of the sample engine while its raster pipelines compile: no frame waits for a compiler or compiles by itself, what has no
// pipeline is left out, and what is drawn meanwhile.
#include <set>

#include "LanternCore/Tasks/TaskTrace.h"
#include "Support/CoreTestTools.h"
#include "Support/RendererTestTools.h"
#include "Support/WaitTools.h"

namespace Lantern
{
namespace
{

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Not;

class FSampleEngineCompileTest : public FRendererTest
{
protected:
	static constexpr const char* Checker = "Materials/Checker.glsl";
	static constexpr const char* CheckerName = "GBuffer Checker";
	/// Quads: a plain one, leaves, and one whose material is the program Checker.
	static constexpr FContent Content{.bMasked = true, .bEmissive = true, .bSky = true};

	void SetUp() override
	{
		FRendererTest::SetUp();
		ASSERT_NO_FATAL_FAILURE(Prepare());
	}
	void TearDown() override
	{
		FTaskTrace::Stop();
		FTaskTrace::Clear();
		FRendererTest::TearDown();
	}
	void Prepare()
	{
		FSceneDescription Scene = MakeDescription(Content);
		Scene.Materials.back().Program = Checker;
		ASSERT_TRUE(Engine->Load(std::move(Scene)));
		ApplySky(Content);
		Engine->bRealTime = Engine->bPresent = true;
		Engine->ExtraPasses = [](FFrameContext& Context, const FGBuffer& GBuffer, const FFrameOutputs&) {
			Context.Graph.AddPass("Reader", [&](FPassBuilder& Builder) -> FPassExecute {
				Builder.NeverCull();
				Builder.Read(GBuffer.BaseColor, ERTAccess::ShaderRead);
				return {};
			});
		};
	}
	FRenderer& Renderer() { return Engine->GetRenderer(); }
	/// Calls are those of this frame.
	void Frame()
	{
		const std::vector<std::string> Made = Mock().GetCreatedPipelines();
		Tried.insert(Tried.end(), Made.begin(), Made.end());
		Mock().ClearCalls();
		const FRTStatus Status = Engine->RenderFrame(LookAt({0, 0, 5}, {0, 0, 0}, 1.0f, 40, 24), 0.0, {}, nullptr);
		ASSERT_TRUE(Status) << Status.Message;
	}
	/// Frames until Condition holds after one.
	bool FramesUntil(const std::string& What, const std::function<bool()>& Condition)
	{
		Frame();
		return WaitUntil(What, Condition, [&] {
			ASSERT_NO_FATAL_FAILURE(Frame());
			GiveWay();
		});
	}
	bool FramesUntilReady()
	{
		return FramesUntil("all shaders", [&] { return Renderer().AreShadersReady(); });
	}
	void LetGo() { Mock().ClearCompileFaults(); }
	/// Names of the raster pipelines that drew in the last frame, once for each draw.
	std::vector<std::string> GetDrawn()
	{
		std::vector<std::string> Names;
		for (const FRTMockCall& Call : Mock().FindCalls(ERTMockCall::DrawIndexed)) { Names.push_back(Call.Name); }
		return Names;
	}
	size_t CountTried(const std::string& Name)
	{
		return static_cast<size_t>(std::count(Tried.begin(), Tried.end(), Name)) +
		       Mock().CountCalls(ERTMockCall::CreateRasterPipeline, Name);
	}
	static void WatchCompiles()
	{
		Set("r.RT.Trace.File", "/nonexistent/trace.json");
		Set("r.RT.Trace", "1");
		FTaskTrace::Start();
	}
	/// Names of the threads that compiled something, without numbers.
	static std::set<std::string> GetCompilingThreads()
	{
		std::set<std::string> Threads;
		const std::vector<std::string> Names = FTaskTrace::GetThreadNames();
		for (const FTraceEvent& Event : FTaskTrace::GetEvents())
		{
			if (std::string_view(Event.Name).starts_with("SPIR-V"))
			{
				Threads.insert(Names[Event.Thread].substr(0, Names[Event.Thread].rfind(' ')));
			}
		}
		return Threads;
	}
	void Edit(const char* Text)
	{
		const uint32_t Program = Renderer().GetPrograms().GetCount() - 1;
		Renderer().GetPrograms().Edit(Program, {.Name = "Checker", .Text = Text});
	}

	std::vector<std::string> Tried; ///< names of pipelines, of earlier frames
};

TEST_F(FSampleEngineCompileTest, NoFrameCompilesOrWaitsWhateverIsToggled)
{
	WatchCompiles();
	Mock().HoldCompiles("");
	{
		const FHangGuard Guard("frames while the driver holds every compile", [&] { LetGo(); });
		ASSERT_NO_FATAL_FAILURE(Frame());
		EXPECT_THAT(GetDrawn(), ElementsAre()) << "nothing has a pipeline";
		EXPECT_TRUE(HasPass("GBuffer")) << "the sky is seen";
		for (const char* Name : {"r.RT.GBuffer.Motion", "r.RT.AlphaTest", "r.RT.Shadow.Denoise", "r.RT.AO.Denoise", "r.RT.Enable"})
		{
			for (const char* Value : {"0", "1"})
			{
				Set(Name, Value);
				ASSERT_NO_FATAL_FAILURE(Frame());
				EXPECT_FALSE(Renderer().AreShadersReady()) << Name << " = " << Value;
			}
		}
		Edit("#include \"Materials/Checker.glsl\"\n// edited\n");
		ASSERT_NO_FATAL_FAILURE(Frame());
	}
	LetGo();
	ASSERT_TRUE(FramesUntilReady());
	EXPECT_THAT(GetCompilingThreads(), ElementsAre("Plain compiler"));
	ASSERT_NO_FATAL_FAILURE(Frame());
	EXPECT_THAT(GetDrawn(), ::testing::UnorderedElementsAre("GBuffer", "GBufferMasked", CheckerName));
}

TEST_F(FSampleEngineCompileTest, TheStandardProgramStandsInForOneThatIsCompiled)
{
	for (const bool bStandIn : {true, false})
	{
		SCOPED_TRACE(bStandIn);
		Set("r.RT.Pipeline.Fallback", bStandIn ? "1" : "0");
		ASSERT_NO_FATAL_FAILURE(Prepare());
		Edit(bStandIn ? "#include \"Materials/Checker.glsl\"\n// 1\n" : "#include \"Materials/Checker.glsl\"\n// 2\n");
		Mock().HoldCompiles(CheckerName);
		ASSERT_TRUE(FramesUntil("both of the standard program", [&] {
			const std::vector<std::string> Drawn = GetDrawn();
			return std::count(Drawn.begin(), Drawn.end(), "GBuffer") == (bStandIn ? 2 : 1) &&
			       std::count(Drawn.begin(), Drawn.end(), "GBufferMasked") == 1;
		}));
		EXPECT_FALSE(Renderer().AreShadersReady());
		EXPECT_THAT(GetDrawn(), Not(Contains(CheckerName)));
		LetGo();
		ASSERT_TRUE(FramesUntil("the program", [&] { return GetDrawn().size() == 3 && Renderer().AreShadersReady(); }));
		EXPECT_THAT(GetDrawn(), Contains(CheckerName));
	}
}

TEST_F(FSampleEngineCompileTest, AnEditedProgramIsDrawnAsItWasUntilTheNewOneIsThere)
{
	FLogCapture Log;
	ASSERT_TRUE(FramesUntilReady());
	const size_t Before = CountTried(CheckerName);
	Mock().HoldCompiles(CheckerName);
	for (const char* Text : {"#include \"Materials/Checker.glsl\"\n// edit 1\n", "#include \"Materials/Checker.glsl\"\n// edit 2\n"})
	{
		Edit(Text);
		for (int I = 0; I < 3; ++I)
		{
			ASSERT_NO_FATAL_FAILURE(Frame());
			EXPECT_THAT(GetDrawn(), Contains(CheckerName));
			EXPECT_FALSE(Renderer().AreShadersReady());
		}
	}
	LetGo();
	ASSERT_TRUE(FramesUntilReady());
	EXPECT_GT(CountTried(CheckerName), Before);
	const auto IsOldGone = [&] {
		const std::vector<std::string> Live = Mock().GetLiveObjects();
		return std::count(Live.begin(), Live.end(), std::string("Pipeline ") + CheckerName) == 1;
	};
	EXPECT_TRUE(FramesUntil("the end of the old one", IsOldGone));
	Edit("nonsense\n");
	ASSERT_TRUE(FramesUntilReady());
	for (int I = 0; I < 3; ++I) { ASSERT_NO_FATAL_FAILURE(Frame()); }
	EXPECT_TRUE(Renderer().AreShadersReady()) << "nothing more will come";
	EXPECT_THAT(GetDrawn(), Contains(CheckerName));
	const std::vector<std::string> Texts = Log.GetTexts();
	EXPECT_EQ(std::count_if(Texts.begin(), Texts.end(), [](const std::string& Text) { return Text.starts_with("raster: "); }), 1)
	    << ::testing::PrintToString(Texts);
}

TEST_F(FSampleEngineCompileTest, ATogglesShadersDoNotBlankThePicture)
{
	ASSERT_TRUE(FramesUntilReady());
	Mock().HoldCompiles("GBuffer");
	for (const char* Value : {"0", "1"})
	{
		Set("r.RT.GBuffer.Motion", Value);
		for (int I = 0; I < 3; ++I)
		{
			ASSERT_NO_FATAL_FAILURE(Frame());
			EXPECT_EQ(GetDrawn().size(), 3u) << "with motion vectors or without";
			EXPECT_EQ(Renderer().AreShadersReady(), *Value == '1') << "as before the toggles";
		}
	}
	LetGo();
}

// The first material that scatters light through brings a target of its own.
TEST_F(FSampleEngineCompileTest, AMaterialThatBringsATargetDoesNotBlankThePicture)
{
	ASSERT_TRUE(FramesUntilReady());
	Mock().HoldCompiles("GBuffer");
	FRTScene& Scene = Engine->GetScene().GetScene();
	FMaterialData Leaf = Scene.GetMaterials()[0];
	Leaf.DiffuseTransmission = 0.5f;
	Leaf.DiffuseTransmissionColor = glm::vec3(1);
	Scene.SetMaterial(0, Leaf);
	for (int I = 0; I < 3; ++I)
	{
		ASSERT_NO_FATAL_FAILURE(Frame());
		EXPECT_EQ(GetDrawn().size(), 3u) << "without the target";
		EXPECT_FALSE(Renderer().AreShadersReady());
	}
	LetGo();
	ASSERT_TRUE(FramesUntilReady());
	ASSERT_NO_FATAL_FAILURE(Frame());
	EXPECT_EQ(GetDrawn().size(), 3u);
}

TEST_F(FSampleEngineCompileTest, WithoutMemoryForAPipelineFramesGoOnUntilThereIsSome)
{
	for (const char* Name : {"GBuffer", "GBufferMasked", CheckerName})
	{
		SCOPED_TRACE(Name);
		Open();
		ASSERT_NO_FATAL_FAILURE(Prepare());
		Tried.clear();
		Mock().StarveCompiles(Name);
		ASSERT_TRUE(FramesUntil("the compile", [&] { return CountTried(Name) > 0; }));
		for (int I = 0; I < 3; ++I)
		{
			ASSERT_NO_FATAL_FAILURE(Frame());
			EXPECT_FALSE(Renderer().AreShadersReady());
		}
		EXPECT_THAT(GetDrawn(), Not(Contains(Name)));
		LetGo();
		ASSERT_TRUE(FramesUntil("all draws", [&] { return Renderer().AreShadersReady() && GetDrawn().size() == 3; }));
		EXPECT_THAT(GetDrawn(), Contains(Name));
	}
}

TEST_F(FSampleEngineCompileTest, PipelinesThatNothingDrawsWithAreDropped)
{
	Set("r.RT.Pipeline.KeepFrames", "10");
	ASSERT_TRUE(FramesUntilReady());
	const auto IsMaskedThere = [&] {
		const std::vector<std::string> Live = Mock().GetLiveObjects();
		return std::count(Live.begin(), Live.end(), "Pipeline GBufferMasked") > 0;
	};
	EXPECT_TRUE(IsMaskedThere());
	Set("r.RT.AlphaTest", "0");
	EXPECT_TRUE(FramesUntil("its end", [&] { return !IsMaskedThere(); }));
	Set("r.RT.AlphaTest", "1");
	EXPECT_TRUE(FramesUntil("its return", [&] { return Renderer().AreShadersReady(); }));
	EXPECT_THAT(GetDrawn(), Contains("GBufferMasked"));
}

TEST_F(FSampleEngineCompileTest, PrecacheLeavesNothingToFrames)
{
	for (const char* Denoise : {"1", "0"})
	{
		Set("r.RT.Shadow.Denoise", Denoise);
		Set("r.RT.AO.Denoise", Denoise);
		FConsoleVariables::Get().BeginFrame();
		std::vector<float> Progress;
		const FRTStatus Status = Engine->Precache({}, [&](float Done) { Progress.push_back(Done); });
		ASSERT_TRUE(Status) << Status.Message;
		ASSERT_FALSE(Progress.empty());
		EXPECT_TRUE(std::is_sorted(Progress.begin(), Progress.end()));
		EXPECT_FLOAT_EQ(Progress.back(), 1.0f);
		Mock().HoldCompiles("");
		const FHangGuard Guard("a frame after Precache", [&] { LetGo(); });
		for (int I = 0; I < 3; ++I)
		{
			ASSERT_NO_FATAL_FAILURE(Frame());
			EXPECT_TRUE(Renderer().AreShadersReady());
			EXPECT_EQ(Mock().GetCreatedPipelines(), std::vector<std::string>());
			EXPECT_EQ(GetDrawn().size(), 3u);
		}
		LetGo();
	}
}

TEST_F(FSampleEngineCompileTest, PicturesThatAreNotOfAGameWaitForAllPipelines)
{
	Engine->bRealTime = false;
	Mock().SlowCompile("GBuffer", 50);
	ASSERT_NO_FATAL_FAILURE(Frame());
	EXPECT_TRUE(Renderer().AreShadersReady());
	EXPECT_EQ(GetDrawn().size(), 3u);
}

} // namespace
} // namespace Lantern
