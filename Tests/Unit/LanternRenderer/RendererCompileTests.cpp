// Frames of an engine while shaders compile: no call waits for a compiler or compiles by itself, passes whose shaders are missing
// are left out, and histories start anew behind them.
#include "DenoiseTypes.h"
#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternCore/Tasks/TaskTrace.h"
#include "LanternRenderer/Frame.h"
#include "Support/CoreTestTools.h"
#include "Support/RendererTestTools.h"
#include "Support/WaitTools.h"

namespace Lantern
{
namespace
{

using ::testing::ElementsAre;

/// Frames as an engine has them: the G-buffer comes from outside, so that every pipeline is the plugin's.
class FRendererCompileTest : public FRendererTest
{
protected:
	static constexpr FContent Content{.bMasked = true, .bSkinned = true, .bLights = true, .bEmissive = true, .bSky = true};
	static constexpr uint32_t Width = 40, Height = 24;

	void SetUp() override
	{
		FRendererTest::SetUp();
		ASSERT_TRUE(Load(Content));
		const ERTFormat Formats[] = {
		    ERTFormat::D32_FLOAT, ERTFormat::RGBA16_SNORM, ERTFormat::RGBA8_SRGB, ERTFormat::RGBA8_UNORM, ERTFormat::RGBA32_FLOAT};
		for (const ERTFormat Format : Formats)
		{
			FRTTextureDesc Desc;
			Desc.Width = Width;
			Desc.Height = Height;
			Desc.Format = Format;
			Desc.Usage = ERTTextureUsage::Sampled;
			Desc.Name = "Engine";
			ASSERT_TRUE(Device->ImportTexture(Desc, 1000 + Textures.size(), Textures.emplace_back().ReleaseAndGetAddress()));
		}
	}
	void TearDown() override
	{
		FTaskTrace::Stop();
		FTaskTrace::Clear();
		Textures.clear();
		FRendererTest::TearDown();
	}
	FRenderer& Renderer() { return Engine->GetRenderer(); }
	FFrameFeatures MakeFeatures()
	{
		FFrameFeatures Features;
		Features.bWaitForPipelines = Features.bBuildAll = Features.bMotion = false;
		Features.bCameraMotion = true;
		Features.Skinning = Engine->GetScene().SetTime(0.0);
		for (const FSignalInfo& Info : SignalInfos) { Features.Signals.Wanted.Add(Info.Signal); }
		return Features;
	}
	/// Calls and outputs are those of this frame.
	void Frame()
	{
		const std::vector<std::string> Made = Mock().GetCreatedPipelines();
		Tried.insert(Tried.end(), Made.begin(), Made.end());
		Mock().ClearCalls();
		FView View = LookAt({0, 0, 5}, {0, 0, 0}, 1.0f, Width, Height);
		View.FrameIndex = FrameIndex++;
		FConsoleVariables::Get().BeginFrame();
		const FRTStatus Begun = Renderer().BeginFrame(Engine->GetScene().GetScene(), View, MakeFeatures());
		ASSERT_TRUE(Begun) << Begun.Message;
		FFrameContext& Context = Renderer().GetContext();
		std::vector<FGraphTexture> Imported;
		for (const TRTRef<IRTTexture>& Texture : Textures)
		{
			Imported.push_back(Context.Graph.ImportTexture(Texture.Get(), ERTAccess::ShaderRead, ERTAccess::ShaderRead, "Engine"));
		}
		Outputs = AddFramePasses(Context, {Imported[0], Imported[1], Imported[2], Imported[3], Imported[4], {}});
		Context.Graph.AddPass("Engine", [&](FPassBuilder& Builder) -> FPassExecute {
			Builder.NeverCull();
			for (const FGraphTexture Texture : Outputs.Signals)
			{
				if (Texture.IsValid()) { Builder.Read(Texture, ERTAccess::ShaderRead); }
			}
			if (Outputs.Display.IsValid()) { Builder.Read(Outputs.Display, ERTAccess::ShaderRead); }
			return [](FPassContext&) {};
		});
		const FRTStatus Ended = Renderer().EndFrame(nullptr);
		ASSERT_TRUE(Ended) << Ended.Message;
	}
	void LetGo() { Mock().ClearCompileFaults(); }
	void FrameUntilReady()
	{
		const auto Step = [&] {
			ASSERT_NO_FATAL_FAILURE(Frame());
			if (bWatches) { ASSERT_THAT(GetCompilesOnRenderThread(), ElementsAre()); } // behind each frame: the trace forgets what is old
			GiveWay();
		};
		Frame();
		ASSERT_TRUE(WaitUntil(
		    "all shaders", [&] { return Renderer().AreShadersReady(); }, Step));
	}
	/// Variables that change what a frame is, and another value for each.
	static std::vector<std::pair<const FRTConsoleVariable*, std::string>> ListToggles()
	{
		std::vector<std::pair<const FRTConsoleVariable*, std::string>> Toggles;
		for (const FRTConsoleVariable* const Variable : FConsoleVariables::Get().GetAll())
		{
			const std::string& Name = Variable->GetName();
			// The trace is what this test looks at.
			if (Name.rfind("r.RT.", 0) != 0 || Name.rfind("r.RT.Trace", 0) == 0) { continue; }
			Toggles.emplace_back(Variable, PickOther(*Variable));
		}
		return Toggles;
	}
	static std::string PickOther(const FRTConsoleVariable& Variable)
	{
		if (Variable.GetName() == "r.RT.Pipeline.Fallback") { return "0"; } // 2 has frames wait, as it says
		if (Variable.GetName() == "r.RT.Debug.View") { return "ambient_occlusion"; }
		const FRTCVarValue Value = Variable.GetValue();
		const FRTCVarRange Range = Variable.GetRange();
		if (const bool* const Flag = std::get_if<bool>(&Value)) { return *Flag ? "0" : "1"; }
		if (const int32_t* const Whole = std::get_if<int32_t>(&Value))
		{
			return std::to_string(double(*Whole) + 1 <= Range.Max ? *Whole + 1 : *Whole - 1);
		}
		if (const float* const Real = std::get_if<float>(&Value))
		{
			return std::to_string(2.0 * double(*Real) + 0.5 <= Range.Max ? 2.0f * *Real + 0.5f : 0.5f * *Real);
		}
		return FConsoleVariables::ToString(Value);
	}
	/// Starts to record on which thread shaders are compiled.
	void WatchCompiles()
	{
		Set("r.RT.Trace.File", "/nonexistent/trace.json");
		Set("r.RT.Trace", "1");
		FTaskTrace::Start();
		const char* const Mark = "The render thread";
		{
			FTraceScope Scope(Mark);
		}
		// At once: while compiles take long, frames follow each other, and the trace forgets what is old.
		const std::vector<FTraceEvent> Events = FTaskTrace::GetEvents();
		const auto Found =
		    std::find_if(Events.begin(), Events.end(), [&](const FTraceEvent& Event) { return Event.Name == std::string(Mark); });
		ASSERT_NE(Found, Events.end());
		RenderThread = Found->Thread;
		bWatches = true;
	}
	std::vector<std::string> GetCompilesOnRenderThread() const
	{
		std::vector<std::string> Names;
		for (const FTraceEvent& Event : FTaskTrace::GetEvents())
		{
			const std::string Name = Event.Name;
			const bool bCompile = Name.rfind("SPIR-V", 0) == 0 || Name.rfind("Compile", 0) == 0;
			if (bCompile && Event.Thread == RenderThread) { Names.push_back(Name); }
		}
		return Names;
	}
	static size_t CountCompiles()
	{
		const std::vector<FTraceEvent> Events = FTaskTrace::GetEvents();
		return static_cast<size_t>(std::count_if(
		    Events.begin(), Events.end(), [](const FTraceEvent& Event) { return std::string(Event.Name).rfind("SPIR-V", 0) == 0; }));
	}
	bool HasHistory(const char* Filter)
	{
		for (const FRTMockCall& Call : Mock().FindCalls(ERTMockCall::Dispatch))
		{
			if (Call.Name.rfind(Filter, 0) != 0 || Call.Bytes.size() != sizeof(FTemporalConstants)) { continue; }
			FTemporalConstants Constants;
			std::memcpy(&Constants, Call.Bytes.data(), sizeof(Constants));
			return Constants.History != NO_TEXTURE;
		}
		ADD_FAILURE() << Filter << " was not dispatched";
		return false;
	}

	std::vector<TRTRef<IRTTexture>> Textures;
	FFrameOutputs Outputs;
	std::vector<std::string> Tried; ///< names of pipelines
	bool bWatches = false;          ///< WatchCompiles has been called
	uint32_t RenderThread = 0;      ///< as the trace counts threads
	uint32_t FrameIndex = 0;
};

TEST_F(FRendererCompileTest, NoFrameCompilesOrWaitsWhateverIsToggled)
{
	WatchCompiles();
	Mock().HoldCompiles("");
	const FHangGuard Guard("frames while the driver holds every compile", [&] { LetGo(); });
	ASSERT_NO_FATAL_FAILURE(Frame());
	EXPECT_FALSE(Outputs.Lighting.IsValid() || Outputs.Display.IsValid() || Outputs.Get(ESignal::SunShadow).IsValid());
	EXPECT_FALSE(Renderer().AreShadersReady());
	const auto Toggles = ListToggles();
	ASSERT_GT(Toggles.size(), 60u);
	for (const auto& [Variable, Value] : Toggles)
	{
		SCOPED_TRACE(Variable->GetName() + " = " + Value);
		const FRTCVarValue Before = Variable->GetValue();
		Set(Variable->GetName().c_str(), Value.c_str());
		ASSERT_NO_FATAL_FAILURE(Frame());
		FConsoleVariables::Get().Restore(*Variable, Before, ERTSetBy::Code);
	}
	EXPECT_THAT(GetCompilesOnRenderThread(), ElementsAre());
	LetGo();
	ASSERT_NO_FATAL_FAILURE(FrameUntilReady());
	EXPECT_TRUE(Outputs.Display.IsValid() && Outputs.Get(ESignal::SunShadow).IsValid());
}

TEST_F(FRendererCompileTest, EachToggleIsReadyAfterSomeFramesThatCompileNothingThemselves)
{
	ASSERT_NO_FATAL_FAILURE(FrameUntilReady());
	size_t Compiles = 0;
	for (const auto& [Variable, Value] : ListToggles())
	{
		WatchCompiles(); // anew: the trace forgets what is old
		SCOPED_TRACE(Variable->GetName() + " = " + Value);
		const FRTCVarValue Before = Variable->GetValue();
		Set(Variable->GetName().c_str(), Value.c_str());
		ASSERT_NO_FATAL_FAILURE(FrameUntilReady());
		EXPECT_TRUE(Outputs.Display.IsValid());
		ASSERT_NO_FATAL_FAILURE(Frame());
		EXPECT_TRUE(Renderer().AreShadersReady()) << "a second frame wants something that the first did not ask for";
		FConsoleVariables::Get().Restore(*Variable, Before, ERTSetBy::Code);
		ASSERT_THAT(GetCompilesOnRenderThread(), ElementsAre());
		Compiles += CountCompiles();
	}
	EXPECT_GT(Compiles, 8u) << "some variables change shaders, and the trace shows it";
}

TEST_F(FRendererCompileTest, PrecacheLeavesNothingToFrames)
{
	struct FCase
	{
		const char* Name;
		const char* Value;
	};
	for (const FCase& Case :
	    {FCase{"r.RT.Shadow.Path", "2"}, FCase{"r.RT.Shadow.Path", "1"}, FCase{"r.RT.AO.Path", "1"}, FCase{"r.RT.GI", "1"},
	        FCase{"r.RT.Reflections", "1"}, FCase{"r.RT.Debug.View", "ambient_occlusion"}, FCase{"r.RT.AO.Denoise", "0"},
	        FCase{"r.RT.Lights.HalfResolution", "1"}, FCase{"r.RT.GI", "3"}, FCase{"r.RT.GI.HalfResolution", "1"}})
	{
		SCOPED_TRACE(std::string(Case.Name) + " = " + Case.Value);
		Set(Case.Name, Case.Value);
		FConsoleVariables::Get().BeginFrame();
		std::vector<float> Progress;
		const FRTStatus Status =
		    Renderer().Precache(Engine->GetScene().GetScene(), MakeFeatures(), [&](float Done) { Progress.push_back(Done); });
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
			EXPECT_TRUE(Outputs.Display.IsValid());
			EXPECT_EQ(Mock().GetCreatedPipelines(), std::vector<std::string>());
		}
		LetGo();
	}
}

TEST_F(FRendererCompileTest, AFilterThatIsLeftOutStartsAnew)
{
	ASSERT_NO_FATAL_FAILURE(FrameUntilReady());
	ASSERT_NO_FATAL_FAILURE(Frame());
	EXPECT_TRUE(HasHistory("Denoise/Temporal.comp"));
	Mock().HoldCompiles("NO_GUARD");
	Set("r.RT.Debug.Denoise.Guard", "0");
	for (int I = 0; I < 3; ++I)
	{
		ASSERT_NO_FATAL_FAILURE(Frame());
		EXPECT_TRUE(Outputs.Get(ESignal::SunShadow).IsValid()) << "as its rays are";
		EXPECT_TRUE(HasPass("SunShadow") && HasPass("ToneMap"));
		EXPECT_FALSE(HasPass("SunShadowTemporal") || HasPass("SunShadowFilter0"));
		EXPECT_FALSE(Renderer().AreShadersReady());
	}
	LetGo();
	const auto HasFilter = [&] { return HasPass("SunShadowTemporal"); };
	ASSERT_TRUE(WaitUntil("the filter", HasFilter, [&] {
		ASSERT_NO_FATAL_FAILURE(Frame());
		GiveWay();
	}));
	EXPECT_FALSE(HasHistory("Denoise/Temporal.comp")) << "what it kept is too old";
	ASSERT_NO_FATAL_FAILURE(Frame());
	EXPECT_TRUE(HasHistory("Denoise/Temporal.comp"));
}

TEST_F(FRendererCompileTest, AShaderThatDoesNotCompileIsLeftOutAndToldOnce)
{
	FLogCapture Log;
	Mock().FailCompile("Lighting/DirectLighting.comp");
	ASSERT_NO_FATAL_FAILURE(FrameUntilReady());
	for (int I = 0; I < 5; ++I) { ASSERT_NO_FATAL_FAILURE(Frame()); }
	EXPECT_TRUE(Outputs.Get(ESignal::SunShadow).IsValid());
	EXPECT_FALSE(Outputs.Lighting.IsValid() || Outputs.Display.IsValid());
	EXPECT_TRUE(Renderer().AreShadersReady()) << "nothing more will come";
	EXPECT_EQ(Log.Count(ERTLogLevel::Error), 1u) << ::testing::PrintToString(Log.GetTexts());
}

TEST_F(FRendererCompileTest, WithoutMemoryForAPipelineFramesGoOnUntilThereIsSome)
{
	for (const char* Name : {"Lighting/", "Denoise/", "Tiles/", "Rays/ShadowQueue", "SunShadow/", "Skinning/Skin", "Skinning/RefitQuality",
	         "ToneMap/", "RTPSO"})
	{
		SCOPED_TRACE(Name);
		Textures.clear();
		ASSERT_NO_FATAL_FAILURE(SetUp());
		Set("r.RT.Shadow.Path", Name == std::string("RTPSO") ? "1" : "2");
		Mock().StarveCompiles(Name);
		const auto WasTried = [&] {
			for (const std::string& Made : Tried)
			{
				if (Made.find(Name) != std::string::npos) { return true; }
			}
			return false;
		};
		Tried.clear();
		const auto Step = [&] {
			ASSERT_NO_FATAL_FAILURE(Frame());
			GiveWay();
		};
		ASSERT_TRUE(WaitUntil("the compile", WasTried, Step));
		LetGo();
		ASSERT_NO_FATAL_FAILURE(FrameUntilReady());
		EXPECT_TRUE(WaitUntil(
		    "the whole frame", [&] { return Outputs.Display.IsValid() && HasPass("SunShadowTemporal") && HasPass("Skinning"); }, Step));
	}
}

TEST_F(FRendererCompileTest, SkinningThatIsLeftOutIsMadeUpFor)
{
	Engine->bRealTime = true;
	Mock().HoldCompiles("Skinning/Skin");
	for (int I = 0; I < 3; ++I)
	{
		Mock().ClearCalls();
		ASSERT_TRUE(RenderFrame(0.5));
		EXPECT_FALSE(HasPass("Skinning"));
		EXPECT_TRUE(Renderer().WasSkinningLeftOut());
	}
	LetGo();
	ASSERT_TRUE(WaitUntil(
	    "skinning", [&] { return HasPass("Skinning"); },
	    [&] {
		Mock().ClearCalls();
		ASSERT_TRUE(RenderFrame(0.5));
		GiveWay();
	    }));
	EXPECT_FALSE(Renderer().WasSkinningLeftOut());
	Mock().ClearCalls();
	ASSERT_TRUE(RenderFrame(0.5));
	EXPECT_FALSE(HasPass("Skinning")) << "the pose has not changed";
}

} // namespace
} // namespace Lantern
