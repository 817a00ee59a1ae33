// Console variables flipped between frames: the next frame is right, and only what it needs runs.
#include <random>

#include "DenoiseTypes.h"
#include "LanternCore/FrameGraph/History.h"
#include "PassTools.h"
#include "RayQueueTypes.h"
#include "Support/CoreTestTools.h"
#include "Support/RendererTestTools.h"
#include "Support/WaitTools.h"

namespace Lantern
{
namespace
{

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class FRendererToggleTest : public FRendererTest
{
protected:
	std::string GetLightingVariant()
	{
		for (const FRTMockCall& Call : Mock().FindCalls(ERTMockCall::Dispatch))
		{
			if (Call.Name.rfind("Lighting/DirectLighting.comp", 0) == 0) { return Call.Name.substr(28); }
		}
		return "none";
	}
	/// Push constants of the pass that traces the queue of shadow rays.
	FShadowQueueConstants GetShadowConstants()
	{
		FShadowQueueConstants Constants{};
		for (const FRTMockCall& Call : Mock().GetCalls())
		{
			const bool bTrace = Call.Kind == ERTMockCall::TraceRaysIndirect;
			const bool bQuery = Call.Kind == ERTMockCall::DispatchIndirect;
			if (!bTrace && !bQuery) { continue; }
			EXPECT_EQ(Call.Bytes.size(), sizeof(Constants));
			std::memcpy(&Constants, Call.Bytes.data(), std::min(sizeof(Constants), Call.Bytes.size()));
		}
		return Constants;
	}
	/// Switches diffuse GI on, and holds its compile up for some frames.
	void ExpectOcclusionUntilDiffuseGI()
	{
		bool bRuns = false;
		const auto Frame = [&] {
			ASSERT_NO_FATAL_FAILURE(Render());
			bRuns = HasPass("DiffuseGI");
			ASSERT_NE(HasPass("AmbientOcclusion"), bRuns);
			GiveWay();
		};
		const auto LetGo = [&] { Mock().ClearCompileFaults(); };
		const auto IsInDriver = [&] { return Mock().GetCompilesInDriver() > 0; };
		Engine->bRealTime = true;
		Set("r.RT.GI", "1");
		Mock().HoldCompiles("DiffuseGI");
		{
			const FHangGuard Guard("frames while diffuse GI is compiled", LetGo);
			ASSERT_TRUE(WaitUntil("diffuse GI's compile in the driver", IsInDriver, Frame));
			for (int I = 0; I < 5; ++I)
			{
				ASSERT_NO_FATAL_FAILURE(Frame());
				EXPECT_FALSE(bRuns) << "before it was compiled";
			}
		}
		LetGo();
		ASSERT_TRUE(WaitUntil(
		    "diffuse GI", [&] { return bRuns; }, Frame));
	}
};

TEST_F(FRendererToggleTest, EveryFeatureCanBeSwitchedOffAndOn)
{
	LoadAndRender({.bMasked = true, .bLights = true, .bSky = true});
	struct FCase
	{
		const char* Name;
		const char* Off;
		const char* On;
		std::string LightingOff;
		bool bShadowOff;
	};
	const std::string All = " HAS_SUN HAS_SKY HAS_LIGHTS";
	for (const FCase& Case : {FCase{"r.RT.Enable", "0", "1", All, false}, FCase{"r.RT.Shadow", "0", "1", All, false},
	         FCase{"r.RT.LocalLights", "0", "1", " HAS_SUN HAS_SKY", true}, FCase{"r.RT.SkyAmbient", "0", "1", " HAS_SUN HAS_LIGHTS", true},
	         FCase{"r.RT.AlphaTest", "0", "1", All, true}})
	{
		for (const char* Path : {"1", "2"})
		{
			Set("r.RT.Shadow.Path", Path);
			Set(Case.Name, Case.Off);
			Render();
			EXPECT_EQ(GetLightingVariant(), Case.LightingOff) << Case.Name;
			EXPECT_EQ(HasPass("SunShadow"), Case.bShadowOff) << Case.Name;
			EXPECT_EQ(Captured.Get(ESignal::SunShadow).IsEmpty(), !Case.bShadowOff) << Case.Name;
			Set(Case.Name, Case.On);
			Render();
			EXPECT_EQ(GetLightingVariant(), All) << Case.Name;
			EXPECT_TRUE(HasPass("SunShadow")) << Case.Name;
		}
	}
}

TEST_F(FRendererToggleTest, ShadowOffTracesNothingAndKeepsNoPipeline)
{
	Set("r.RT.Shadow.Path", "1");
	Set("r.RT.Shadow.MoreRays", "0");
	LoadAndRender({});
	EXPECT_TRUE(GetRTPSO());
	Set("r.RT.Shadow", "0");
	Render();
	EXPECT_FALSE(GetRTPSO());
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::TraceRays), 0u);
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::TraceRaysIndirect), 0u);
	EXPECT_FALSE(HasPass("ShaderTable"));
	Set("r.RT.Shadow", "1");
	Render();
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::TraceRaysIndirect), 1u);
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::CreateRayTracingPipeline), 0u) << "the pipeline of before is used again";
	EXPECT_TRUE(Resolve(0, 0).IsGood()) << Resolve(0, 0).Error;
}

TEST_F(FRendererToggleTest, AlphaTestSwapsThePipelineAndItsRecords)
{
	Set("r.RT.Shadow.Path", "1");
	LoadAndRender({.bMasked = true});
	EXPECT_EQ(Resolve(1, 0).AnyHit, "Rays/AlphaTest.rahit");
	for (const char* Name : {"r.RT.AlphaTest", "r.RT.Material.Override"})
	{
		const bool bOverride = std::string(Name) == "r.RT.Material.Override";
		Set(Name, bOverride ? "2" : "0");
		Render();
		EXPECT_EQ(GetRTPSO()->GetHitGroupCount(), 1u) << Name;
		EXPECT_TRUE(Resolve(1, 0).IsGood()) << Resolve(1, 0).Error;
		EXPECT_EQ(Resolve(1, 0).AnyHit, "") << Name;
		Set(Name, bOverride ? "0" : "1");
		Render();
		EXPECT_TRUE(Resolve(1, 0).IsGood()) << Resolve(1, 0).Error;
		EXPECT_EQ(Resolve(1, 0).AnyHit, "Rays/AlphaTest.rahit") << Name;
	}
}

TEST_F(FRendererToggleTest, ShadowSettingsReachTheShader)
{
	LoadAndRender({});
	EXPECT_EQ(GetShadowConstants().SamplesPerPixel, 1u);
	Set("r.RT.Shadow.Samples", "16");
	Set("r.RT.Shadow.MaxDistance", "50");
	Set("r.RT.Shadow.CasterFaces", "2");
	Set("r.RT.Shadow.InstanceMask", "4");
	for (const char* Path : {"1", "2"})
	{
		Set("r.RT.Shadow.Path", Path);
		Render();
		EXPECT_EQ(GetShadowConstants().SamplesPerPixel, 16u);
		EXPECT_EQ(GetShadowConstants().MaxDistance, 50.0f);
		EXPECT_EQ(GetShadowConstants().RayFlags, 0x10u);
		EXPECT_EQ(GetShadowConstants().InstanceMask, 4u);
		EXPECT_GT(GetShadowConstants().SunOneMinusCos, 0.0f);
	}
	Set("r.RT.Shadow.Soft", "0");
	Render();
	EXPECT_EQ(GetShadowConstants().SamplesPerPixel, 1u) << "hard shadows need one ray";
	EXPECT_EQ(GetShadowConstants().SunOneMinusCos, 0.0f);
}

TEST_F(FRendererToggleTest, ValueSetInTheMiddleOfAFrameWaitsForTheNext)
{
	LoadAndRender({});
	Engine->ExtraPasses = [](FFrameContext&, const FGBuffer&, const FFrameOutputs& Outputs) {
		EXPECT_TRUE(Outputs.Get(ESignal::SunShadow).IsValid());
		Set("r.RT.Shadow", "0");
	};
	Render();
	EXPECT_TRUE(HasPass("SunShadow"));
	Engine->ExtraPasses = {};
	Render();
	EXPECT_FALSE(HasPass("SunShadow"));
}

TEST_F(FRendererToggleTest, AnySequenceOfTogglesGivesRightFrames)
{
	LoadAndRender({.bMasked = true, .bSkinned = true, .bLights = true, .bEmissive = true, .bSky = true});
	struct FVariable
	{
		const char* Name;
		std::vector<const char*> Values;
	};
	const std::vector<FVariable> Variables = {{"r.RT.Enable", {"0", "1", "1"}}, {"r.RT.Shadow", {"0", "1", "1"}},
	    {"r.RT.Shadow.Path", {"0", "1", "2"}}, {"r.RT.Shadow.Soft", {"0", "1"}}, {"r.RT.Shadow.Samples", {"1", "4"}},
	    {"r.RT.AlphaTest", {"0", "1"}}, {"r.RT.Material.Override", {"0", "1", "2"}}, {"r.RT.LocalLights", {"0", "1"}},
	    {"r.RT.SkyAmbient", {"0", "1"}}, {"r.RT.AO", {"0", "1"}}, {"r.RT.AO.Path", {"0", "1", "2"}}, {"r.RT.AO.Denoise", {"0", "1", "1"}},
	    {"r.RT.GI", {"0", "1"}}, {"r.RT.Reflections", {"0", "1"}}, {"r.RT.Shadow.Denoise", {"0", "1", "1"}},
	    {"r.RT.GBuffer.Motion", {"0", "1"}}, {"r.RT.Debug.PoisonHistory", {"0", "1", "3"}},
	    {"r.RT.Skinning.RebuildInterval", {"1", "2", "16"}}};
	std::mt19937 Random(6);
	FContent Content{.bMasked = true, .bSkinned = true, .bLights = true, .bEmissive = true, .bSky = true};
	for (int Step = 0; Step < 150; ++Step)
	{
		for (uint32_t Changes = Random() % 3; Changes > 0; --Changes)
		{
			const FVariable& Variable = Variables[Random() % Variables.size()];
			Set(Variable.Name, Variable.Values[Random() % Variable.Values.size()]);
		}
		if (Random() % 10 == 0)
		{
			Content.bSun = Random() % 3 != 0;
			Content.bSky = Random() % 2;
			ApplySky(Content);
		}
		ASSERT_NO_FATAL_FAILURE(Render(Random() % 4 * 0.25)) << "step " << Step;
		const auto IsOn = [](const char* Name) {
			return FConsoleVariables::ToString(FConsoleVariables::Get().Find(Name)->GetValue()) == "1";
		};
		const bool bRays = IsOn("r.RT.Enable");
		ASSERT_EQ(HasPass("SunShadow"), bRays && Content.bSun && IsOn("r.RT.Shadow")) << "step " << Step;
		ASSERT_EQ(HasPass("DiffuseGI"), bRays && IsOn("r.RT.GI")) << "step " << Step;
		ASSERT_EQ(HasPass("Reflections"), bRays && IsOn("r.RT.Reflections")) << "step " << Step;
		const bool bAmbient = Content.bSky && IsOn("r.RT.SkyAmbient") && !IsOn("r.RT.GI");
		ASSERT_EQ(HasPass("AmbientOcclusion"), bRays && bAmbient && IsOn("r.RT.AO")) << "step " << Step;
		const bool bMasked = Engine->GetScene().GetScene().GetFacts().bMasked;
		for (uint32_t Instance = 0; GetRTPSO() && Instance < 4; ++Instance)
		{
			const FRTMockRecord Record = Resolve(Instance, 0);
			ASSERT_TRUE(Record.IsGood()) << "step " << Step << ": " << Record.Error;
			ASSERT_EQ(Record.AnyHit.empty(), Instance != 1 || !bMasked) << "step " << Step;
		}
	}
}

/// Until diffuse GI is compiled, the sky's ambient light is there in its stead, and is occluded.
TEST_F(FRendererToggleTest, AmbientOcclusionStaysUntilDiffuseGIRuns)
{
	for (const char* const Path : {"1", "2"})
	{
		FConsoleVariables::Get().ResetAll();
		Open();
		Set("r.RT.AO.Path", Path);
		LoadAndRender({.bSky = true});
		ASSERT_TRUE(HasPass("AmbientOcclusion")) << Path;
		ASSERT_NO_FATAL_FAILURE(ExpectOcclusionUntilDiffuseGI()) << "path " << Path;
		Engine->bRealTime = false;
		Render();
		EXPECT_TRUE(HasPass("DiffuseGI")) << Path;
		EXPECT_FALSE(HasPass("AmbientOcclusion")) << Path;
		const FShaderSource RayGen{"AmbientOcclusion/AmbientOcclusion.rgen", ERTShaderStage::RayGen, {{"ONE_SAMPLE", "1"}}, {}};
		EXPECT_EQ(GetRTPSO()->FindRayGen(RayGen), NoRayGen) << "nothing is compiled that does not run";
	}
}

TEST_F(FRendererToggleTest, ReorderingIsForMaterialShadersOfDevicesThatCan)
{
	for (const bool bCan : {true, false})
	{
		FRTMockDesc Desc;
		Desc.Rung = bCan ? ERTRung::Reorder : ERTRung::Pipeline;
		Open(Desc);
		FLogCapture Log;
		Set("r.RT.GI", "1");
		Set("r.RT.Shadow.Path", "1");
		Set("r.RT.Reorder", "1");
		LoadAndRender({.bSky = true});
		std::vector<std::pair<std::string, std::string>> Defines = {{"HAS_SUN", "1"}, {"HAS_SKY", "1"}, {"SECOND_LOBE", "1"}};
		const std::vector<std::pair<std::string, std::string>> Unordered = Defines;
		if (bCan) { Defines.emplace_back("REORDER", "1"); }
		EXPECT_NE(GetRTPSO()->FindRayGen({"DiffuseGI/DiffuseGI.rgen", ERTShaderStage::RayGen, Defines, {}}), NoRayGen) << bCan;
		EXPECT_NE(GetRTPSO()->FindRayGen({"Rays/ShadowQueue.rgen", ERTShaderStage::RayGen,
		              {{"SUN_RAYS", "1"}, {"ONE_SAMPLE", "1"}, {"WITH_PENUMBRA", "1"}}, {}}),
		    NoRayGen)
		    << "shadow rays run no material shader";
		EXPECT_EQ(Log.Count(ERTLogLevel::Warning), bCan ? 0u : 1u) << "once";
		Set("r.RT.Reorder", "0");
		Render();
		EXPECT_NE(GetRTPSO()->FindRayGen({"DiffuseGI/DiffuseGI.rgen", ERTShaderStage::RayGen, Unordered, {}}), NoRayGen);
	}
}

/// Until the shader that measures penumbrae is compiled, the one without serves. The filter must not read what nobody writes.
TEST_F(FRendererToggleTest, FilterReadsOnlyPenumbraeThatAreWritten)
{
	Set("r.RT.Shadow.Path", "1");
	Set("r.RT.Shadow.MoreRays", "0"); // whose trace a frame may have as well, as soon as their shader is there
	Set("r.RT.Shadow.Denoise", "0");
	LoadAndRender({});
	Engine->bRealTime = true;
	Set("r.RT.Shadow.Denoise", "1");
	bool bWritten = false, bRead = false;
	const auto Frame = [&] {
		ASSERT_NO_FATAL_FAILURE(Render());
		const std::vector<FRTMockCall> Traces = Mock().FindCalls(ERTMockCall::TraceRaysIndirect);
		ASSERT_EQ(Traces.size(), 1u);
		EXPECT_THAT(GetRTPSO()->GetRayGen(static_cast<uint32_t>(Traces[0].Numbers[0])).Path, HasSubstr("ShadowQueue"));
		const FShaderDefines& Defines = GetRTPSO()->GetRayGen(static_cast<uint32_t>(Traces[0].Numbers[0])).Defines;
		bWritten = std::count(Defines.begin(), Defines.end(), std::pair<std::string, std::string>("WITH_PENUMBRA", "1")) > 0;
		bRead = false;
		for (const FRTMockCall& Call : Mock().FindCalls(ERTMockCall::Dispatch))
		{
			if (Call.Name.rfind("Denoise/Temporal.comp", 0) != 0) { continue; }
			FTemporalConstants Constants{};
			ASSERT_EQ(Call.Bytes.size(), sizeof(Constants));
			std::memcpy(&Constants, Call.Bytes.data(), sizeof(Constants));
			bRead |= Constants.Extent != NO_TEXTURE;
		}
		EXPECT_TRUE(bWritten || !bRead);
		GiveWay();
	};
	const auto LetGo = [&] { Mock().ClearCompileFaults(); };
	Mock().HoldCompiles("ShadowQueue");
	{
		const FHangGuard Guard("frames while the shadow shader is compiled", LetGo);
		ASSERT_TRUE(WaitUntil(
		    "its compile in the driver", [&] { return Mock().GetCompilesInDriver() > 0; }, Frame));
		for (int I = 0; I < 5; ++I)
		{
			ASSERT_NO_FATAL_FAILURE(Frame());
			EXPECT_FALSE(bWritten) << "before it was compiled";
		}
	}
	LetGo();
	ASSERT_TRUE(WaitUntil(
	    "a measured penumbra", [&] { return bWritten && bRead; }, Frame));
}

// The variant from before serves while another rate's is compiled: that of the first launch, and not the second one's, which reads its list.
TEST_F(FRendererToggleTest, NeitherLaunchOfDiffuseGIServesForTheOther)
{
	Set("r.RT.GI", "3");
	Set("r.RT.GI.Path", "1");
	Set("r.RT.Reflections", "0");
	LoadAndRender({.bSky = true});
	Engine->bRealTime = true;
	const auto CountLaunches = [&](const char* File) {
		std::vector<FRTMockCall> Traces = Mock().FindCalls(ERTMockCall::TraceRays);
		for (const FRTMockCall& Call : Mock().FindCalls(ERTMockCall::TraceRaysIndirect)) { Traces.push_back(Call); }
		return std::count_if(Traces.begin(), Traces.end(), [&](const FRTMockCall& Call) {
			return GetRTPSO()->GetRayGen(static_cast<uint32_t>(Call.Numbers[0])).Path.find(File) != std::string::npos;
		});
	};
	for (const char* const Rate : {"2", "1", "0"})
	{
		Set("r.RT.GI.Rate", Rate);
		for (int I = 0; I < 4; ++I)
		{
			ASSERT_NO_FATAL_FAILURE(Render());
			EXPECT_EQ(CountLaunches("DiffuseGI/DiffuseGI.rgen"), 1) << Rate;
			EXPECT_EQ(CountLaunches("DiffuseGI/Deferred.rgen"), 1) << Rate;
		}
		ASSERT_TRUE(WaitUntil(
		    "all shaders", [&] { return Engine->GetRenderer().AreShadersReady(); },
		    [&] {
			Render();
			GiveWay();
		    }));
	}
}

/// What frames use and what the device holds, while the picture changes its size.
class FRendererSizeTest : public FRendererTest
{
protected:
	void Draw(uint32_t Width, uint32_t Height)
	{
		FFrameCapture Capture;
		Capture.bDisplay = true;
		const FRTStatus Status = Engine->RenderFrame(LookAt({0, 0, 5}, {0, 0, 0}, 1.0f, Width, Height), 0.0, Capture, &Captured);
		ASSERT_TRUE(Status) << Status.Message;
		EXPECT_EQ(Captured.Display.Width, Width);
		EXPECT_EQ(Captured.Display.Height, Height);
	}
	/// As many frames as resources live without use.
	void DrawUntilOldSizesAreGone(uint32_t Width, uint32_t Height)
	{
		for (uint32_t I = 0; I <= FHistoryResources::KeepFrames; ++I) { ASSERT_NO_FATAL_FAILURE(Draw(Width, Height)); }
		Device->CollectGarbage();
	}
	uint64_t GetPooled() { return Engine->GetRenderer().GetGraphResources().GetPooledBytes(); }
	/// Bytes of the pool after each frame. Widths: 64, 65 … 256, and seven of them again.
	std::vector<uint64_t> Resize(const char* KeepFrames)
	{
		Set("r.RT.FrameGraph.KeepFrames", KeepFrames);
		std::vector<uint64_t> Bytes;
		for (uint32_t Frame = 0; Frame < 200; ++Frame)
		{
			Draw(64 + Frame % 193, 36);
			Bytes.push_back(GetPooled());
		}
		return Bytes;
	}
};

TEST_F(FRendererSizeTest, PoolHoldsNoMoreThanTheLastFramesUsed)
{
	constexpr size_t KeepFrames = 8;
	LoadAndRender({.bSky = true});
	const std::vector<uint64_t> Used = Resize("1"); // what each frame uses by itself
	const std::vector<uint64_t> Held = Resize("8");
	for (size_t Frame = 0; Frame < Held.size(); ++Frame)
	{
		uint64_t Most = 0;
		for (size_t Back = 0; Back < std::min(KeepFrames, Frame + 1); ++Back) { Most += Used[Frame - Back]; }
		ASSERT_GT(Used[Frame], 0u);
		ASSERT_LE(Held[Frame], Most + (Frame < KeepFrames ? Used.back() : 0)) << "frame " << Frame;
	}
}

TEST_F(FRendererSizeTest, SizeOfThePictureMayChangeEveryFrame)
{
	LoadAndRender({});
	ASSERT_NO_FATAL_FAILURE(DrawUntilOldSizesAreGone(1, 2));
	const uint64_t Bytes = Device->GetMemoryStats().Total;
	const uint32_t Objects = Mock().GetLiveObjectCount();
	for (const uint32_t Size : {1u, 33u, 8u, 200u, 1u}) { ASSERT_NO_FATAL_FAILURE(Draw(Size, 2 * Size)); }
	EXPECT_GT(Device->GetMemoryStats().Total, Bytes);
	ASSERT_NO_FATAL_FAILURE(DrawUntilOldSizesAreGone(1, 2));
	EXPECT_EQ(Device->GetMemoryStats().Total, Bytes);
	EXPECT_EQ(Mock().GetLiveObjectCount(), Objects);
}

TEST_F(FRendererToggleTest, ManyFramesDoNotLeak)
{
	LoadAndRender({.bMasked = true, .bSkinned = true, .bSky = true});
	for (int I = 0; I < 5; ++I) { Render(I * 0.1); }
	const uint32_t Objects = Mock().GetLiveObjectCount();
	const uint64_t Bytes = Device->GetMemoryStats().Total;
	for (int I = 0; I < 100; ++I) { Render(I * 0.1); }
	EXPECT_EQ(Mock().GetLiveObjectCount(), Objects);
	EXPECT_EQ(Device->GetMemoryStats().Total, Bytes);
}

/// The device is always one frame behind: a frame that waited for the one before would find it unfinished.
TEST_F(FRendererToggleTest, FramesWaitForNoFrameInFlight)
{
	LoadAndRender({.bMasked = true, .bSkinned = true, .bSky = true});
	Engine->bPresent = Engine->bRealTime = true;
	Mock().SetManualFences(true);
	const uint32_t Waits = Mock().GetBlockingWaits();
	FRTFence Before = Mock().GetLastFence();
	for (int I = 0; I < 50; ++I)
	{
		const FRTStatus Status = Engine->RenderFrame(LookAt({0, 0, 5}, {0, 0, 0}, 1.0f, 40, 24), I * 0.1, {}, nullptr);
		ASSERT_TRUE(Status) << Status.Message;
		ASSERT_GT(Mock().GetLastFence(), Before) << "something was submitted";
		ASSERT_EQ(Mock().GetBlockingWaits(), Waits) << "frame " << I;
		Mock().CompleteUpTo(std::exchange(Before, Mock().GetLastFence()));
	}
	Mock().SetManualFences(false);
}

/// Whatever runs on the compute queue: the wrapper refuses lists that use what the other queue has not finished with.
TEST_F(FRendererToggleTest, PassesMayRunOnTheComputeQueue)
{
	Set("r.RT.Shadow.Path", "1");
	LoadAndRender({.bMasked = true, .bSkinned = true, .bLights = true, .bSky = true});
	Engine->bPresent = Engine->bRealTime = true;
	Mock().SetManualFences(true);
	FRTFence Before = Mock().GetLastFence();
	for (const char* const Async : {"*", "Skinning", "Structures,AmbientOcclusion", "ShaderTable SceneUpdate", ""})
	{
		Set("r.RT.Async", Async);
		for (int I = 0; I < 6; ++I)
		{
			Mock().ClearCalls();
			const FRTStatus Status = Engine->RenderFrame(LookAt({0, 0, 5}, {0, 0, 0}, 1.0f, 40, 24), I * 0.1, {}, nullptr);
			ASSERT_TRUE(Status) << Async << ": " << Status.Message;
			ASSERT_EQ(Messages, std::vector<std::string>()) << Async;
			bool bCompute = false;
			for (const FRTMockCall& Call : Mock().FindCalls(ERTMockCall::Submit)) { bCompute |= Call.Numbers[2] == 1; }
			EXPECT_EQ(bCompute, *Async != 0) << Async << ", frame " << I;
			Mock().CompleteUpTo(std::exchange(Before, Mock().GetLastFence()));
		}
	}
	Mock().SetManualFences(false);
}

} // namespace
} // namespace Lantern
