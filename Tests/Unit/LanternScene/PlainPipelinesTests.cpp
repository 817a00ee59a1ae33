// Compute and raster pipelines on the mock: compiles beside the frames, errors, shortage of memory, and which pipelines are kept.
#include "LanternScene/Pipelines/PlainPipelines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternRHIMock/MockDevice.h"
#include "Support/WaitTools.h"

namespace Lantern
{
namespace
{

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class FPlainPipelinesTest : public ::testing::Test
{
protected:
	void SetUp() override
	{
		FConsoleVariables::Get().ResetAll();
		Set("r.RT.Pipeline.Threads", "3");
		ASSERT_TRUE(CreateMockDevice({}, Device.ReleaseAndGetAddress()));
		Pipelines = std::make_unique<FPlainPipelines>(*Device, Compiler);
	}
	void TearDown() override
	{
		Mock().ClearCompileFaults();
		Pipelines.reset();
		EXPECT_EQ(Mock().GetLiveObjectCount(), 0u);
		EXPECT_EQ(Mock().GetErrors(), std::vector<std::string>());
		FConsoleVariables::Get().ResetAll();
		FConsoleVariables::Get().BeginFrame();
	}
	FRTMock& Mock() { return GetMock(Device.Get()); }
	static void Set(const char* Name, const char* Value)
	{
		EXPECT_FALSE(FConsoleVariables::Get().Set(Name, Value, ERTSetBy::Console, "test"));
		FConsoleVariables::Get().BeginFrame();
	}
	static FShaderSource MakeSource(const char* Name, const char* Body = "")
	{
		FShaderSource Source;
		Source.Path = Name;
		Source.Text = std::string("#version 460\nvoid main() {") + Body + "}\n";
		return Source;
	}
	/// In a frame of its own; null while it is compiled.
	template <class TSource>
	IRTPipeline* FindInFrame(const TSource& Source)
	{
		IRTPipeline* Pipeline = nullptr;
		Pipelines->BeginFrame();
		Status = Pipelines->Find(Source, Pipeline);
		return Pipeline;
	}
	template <class TSource>
	IRTPipeline* Get(const TSource& Source)
	{
		IRTPipeline* Pipeline = nullptr;
		Status = Pipelines->Get(Source, Pipeline);
		return Pipeline;
	}
	FRasterSource MakeRaster(uint32_t Revision, const char* Body = "")
	{
		FRasterSource Source;
		Source.Key = "Key";
		Source.Revision = Revision;
		Source.Name = "Raster" + std::to_string(Revision);
		Source.Vertex = MakeSource("Vertex", "gl_Position = vec4(0);");
		Source.Vertex.Stage = ERTShaderStage::Vertex;
		Source.Fragment = MakeSource("Fragment", Body);
		Source.Fragment.Stage = ERTShaderStage::Fragment;
		Source.ColorFormats = {ERTFormat::RGBA8_UNORM, ERTFormat::RGBA16_FLOAT};
		Source.Cull = ERTCull::Front;
		return Source;
	}
	bool IsLive(const std::string& Name)
	{
		const std::vector<std::string> Live = Mock().GetLiveObjects();
		return std::find(Live.begin(), Live.end(), "Pipeline " + Name) != Live.end();
	}
	uint32_t CountMade(const std::string& Name) { return Mock().CountCalls(ERTMockCall::CreateComputePipeline, Name); }

	TRTRef<IRTDevice> Device;
	FShaderCompiler Compiler{{}};
	std::unique_ptr<FPlainPipelines> Pipelines;
	FRTStatus Status;
};

TEST_F(FPlainPipelinesTest, FindNeverWaitsAndGetsItsPipelineLater)
{
	FShaderSource Source = MakeSource("Held");
	Source.Defines = {{"ONE", "1"}, {"TWO", "2"}};
	Mock().HoldCompiles("Held");
	{
		const FHangGuard Guard("Find while the driver holds the compile", [&] { Mock().ClearCompileFaults(); });
		ASSERT_TRUE(WaitUntil("the compile", [&] {
			EXPECT_EQ(FindInFrame(Source), nullptr);
			return Mock().GetCompilesInDriver() == 1;
		}));
		EXPECT_TRUE(Status) << "to be compiled is no error";
		EXPECT_TRUE(Pipelines->IsAnyToCome());
	}
	Mock().ClearCompileFaults();
	ASSERT_TRUE(WaitUntil("the pipeline", [&] { return FindInFrame(Source) != nullptr; }));
	EXPECT_FALSE(Pipelines->IsAnyToCome());
	EXPECT_THAT(Mock().GetCreatedPipelines(), ElementsAre("Held ONE TWO=2")) << "once";
	EXPECT_EQ(Get(Source), FindInFrame(Source));
}

TEST_F(FPlainPipelinesTest, WhatIsWantedCompilesSideBySide)
{
	Mock().HoldCompiles("");
	Pipelines->BeginFrame();
	Pipelines->Want({MakeSource("A"), MakeSource("B"), MakeSource("C"), MakeSource("A")});
	EXPECT_TRUE(Pipelines->IsAnyToCome());
	EXPECT_TRUE(WaitUntil("three in the driver", [&] { return Mock().GetCompilesInDriver() == 3; }));
	Mock().ClearCompileFaults();
	std::vector<float> Progress;
	EXPECT_TRUE(Pipelines->Finish({MakeSource("A"), MakeSource("B"), MakeSource("D")}, [&](float Done) { Progress.push_back(Done); }));
	EXPECT_THAT(Progress, ElementsAre(1.0f / 3.0f, 2.0f / 3.0f, 1.0f));
	for (const char* Name : {"A", "B", "D"}) { EXPECT_EQ(CountMade(Name), 1u) << Name; }
	EXPECT_NE(Get(MakeSource("C")), nullptr);
	EXPECT_EQ(Pipelines->GetCount(), 4u);
}

TEST_F(FPlainPipelinesTest, AShaderThatDoesNotCompileIsCompiledOnce)
{
	const FShaderSource Source = MakeSource("Broken", "wrong;");
	for (int I = 0; I < 3; ++I)
	{
		EXPECT_EQ(Get(Source), nullptr);
		EXPECT_EQ(Status.Code, ERTResult::CompileFailed);
		EXPECT_THAT(std::string(Status.Message), HasSubstr("Broken:2:"));
		EXPECT_EQ(FindInFrame(Source), nullptr);
		EXPECT_EQ(Status.Code, ERTResult::CompileFailed);
		EXPECT_FALSE(Pipelines->IsAnyToCome()) << "it will never come";
	}
	EXPECT_EQ(Compiler.GetStats().Failed, 1u);
	Mock().FailCompile("Driver");
	for (int I = 0; I < 3; ++I) { EXPECT_EQ(Get(MakeSource("Driver")), nullptr); }
	EXPECT_EQ(CountMade("Driver"), 1u);
	EXPECT_EQ(Pipelines->Finish({MakeSource("Fine"), Source, MakeSource("Driver")}, {}).Code, ERTResult::CompileFailed);
	EXPECT_EQ(CountMade("Fine"), 1u);
}

TEST_F(FPlainPipelinesTest, ShortageOfMemoryIsTriedAgain)
{
	const FShaderSource Source = MakeSource("Large");
	Mock().StarveCompiles("Large");
	for (uint32_t I = 1; I <= 3; ++I)
	{
		EXPECT_EQ(Get(Source), nullptr);
		EXPECT_EQ(Status.Code, ERTResult::OutOfDeviceMemory);
		EXPECT_EQ(CountMade("Large"), I) << "each call that waits tries again";
	}
	Pipelines->BeginFrame();
	for (int Frame = 0; Frame < 50; ++Frame)
	{
		EXPECT_EQ(FindInFrame(Source), nullptr);
		EXPECT_EQ(Status.Code, ERTResult::OutOfDeviceMemory);
		EXPECT_TRUE(Pipelines->IsAnyToCome());
	}
	EXPECT_EQ(CountMade("Large"), 3u) << "frames let some time pass";
	Mock().ClearCompileFaults();
	EXPECT_TRUE(WaitUntil("memory", [&] { return FindInFrame(Source) != nullptr; }));
	EXPECT_EQ(CountMade("Large"), 4u);
}

TEST_F(FPlainPipelinesTest, WhatNobodyUsesIsDropped)
{
	Set("r.RT.Pipeline.KeepFrames", "10");
	const FShaderSource Used = MakeSource("Used"), Unused = MakeSource("Unused");
	ASSERT_TRUE(Get(Used) && Get(Unused));
	for (int Frame = 0; Frame < 10; ++Frame) { EXPECT_NE(FindInFrame(Used), nullptr); }
	EXPECT_EQ(Pipelines->GetCount(), 2u) << "for as many frames";
	EXPECT_NE(FindInFrame(Used), nullptr);
	EXPECT_EQ(Pipelines->GetCount(), 1u);
	EXPECT_TRUE(WaitUntil("its end", [&] {
		FindInFrame(Used);
		return Mock().CountCalls(ERTMockCall::Destroy, "Unused") == 1;
	}));
	ASSERT_NE(Get(Unused), nullptr);
	EXPECT_EQ(CountMade("Unused"), 2u);
	EXPECT_EQ(CountMade("Used"), 1u);
}

TEST_F(FPlainPipelinesTest, RasterPipelinesAreMadeBesideTheFramesAsWell)
{
	Mock().HoldCompiles("Raster");
	{
		const FHangGuard Guard("Find while the driver holds the compile", [&] { Mock().ClearCompileFaults(); });
		ASSERT_TRUE(WaitUntil("the compile", [&] {
			EXPECT_EQ(FindInFrame(MakeRaster(0)), nullptr);
			return Mock().GetCompilesInDriver() == 1;
		}));
		EXPECT_TRUE(Status && Pipelines->IsAnyToCome());
	}
	Mock().ClearCompileFaults();
	IRTPipeline* const Made = Get(MakeRaster(0));
	ASSERT_NE(Made, nullptr);
	EXPECT_FALSE(Pipelines->IsAnyToCome()) << "it is there now";
	EXPECT_EQ(FindInFrame(MakeRaster(0)), Made);
	const std::vector<FRTMockCall> Calls = Mock().FindCalls(ERTMockCall::CreateRasterPipeline);
	ASSERT_EQ(Calls.size(), 1u);
	EXPECT_EQ(Calls[0].Numbers[0], 2u) << "colour targets";
	ASSERT_EQ(Pipelines->GetRasterSources().size(), 1u);
	EXPECT_EQ(Pipelines->GetRasterSources()[0].Key, "Key");
	EXPECT_EQ(Pipelines->GetComputeSources().size(), 0u);
}

TEST_F(FPlainPipelinesTest, TheRevisionBeforeServesUntilTheNewOneDoes)
{
	IRTPipeline* const First = Get(MakeRaster(1));
	ASSERT_NE(First, nullptr);
	EXPECT_EQ(Get(MakeRaster(2, "nonsense;")), First) << "for good, if the new one does not compile";
	EXPECT_EQ(Status.Code, ERTResult::CompileFailed);
	Mock().HoldCompiles("Raster3");
	Mock().HoldCompiles("Raster4");
	for (const uint32_t Revision : {3u, 4u, 3u})
	{
		EXPECT_EQ(FindInFrame(MakeRaster(Revision)), First);
		EXPECT_TRUE(Status && Pipelines->IsAnyToCome());
	}
	Mock().ClearCompileFaults();
	EXPECT_NE(Get(MakeRaster(5)), First);
	EXPECT_TRUE(IsLive("Raster1")) << "what this frame has found may still be recorded";
	const auto IsOldGone = [&] {
		EXPECT_NE(FindInFrame(MakeRaster(5)), nullptr);
		return !IsLive("Raster1") && !IsLive("Raster3") && !IsLive("Raster4");
	};
	EXPECT_TRUE(WaitUntil("the end of the others", IsOldGone));
	EXPECT_TRUE(IsLive("Raster5"));
	EXPECT_EQ(Pipelines->GetCount(), 1u);
}

TEST_F(FPlainPipelinesTest, ShortageOfMemoryForARevisionIsTriedAgain)
{
	IRTPipeline* const First = Get(MakeRaster(0));
	Mock().StarveCompiles("Raster1");
	EXPECT_EQ(Get(MakeRaster(1)), First);
	EXPECT_EQ(Status.Code, ERTResult::OutOfDeviceMemory);
	EXPECT_EQ(FindInFrame(MakeRaster(1)), First);
	EXPECT_TRUE(Pipelines->IsAnyToCome());
	Mock().ClearCompileFaults();
	EXPECT_TRUE(WaitUntil("memory", [&] { return FindInFrame(MakeRaster(1)) != First; }));
	EXPECT_FALSE(Pipelines->IsAnyToCome());
}

} // namespace
} // namespace Lantern
