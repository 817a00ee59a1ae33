// Compute pipelines on the mock: compiles beside the frames, errors, shortage of memory, and which pipelines are kept.
#include "LanternScene/Pipelines/ComputePipelines.h"

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

class FComputePipelinesTest : public ::testing::Test
{
protected:
	void SetUp() override
	{
		FConsoleVariables::Get().ResetAll();
		Set("r.RT.Pipeline.Threads", "3");
		ASSERT_TRUE(CreateMockDevice({}, Device.ReleaseAndGetAddress()));
		Pipelines = std::make_unique<FComputePipelines>(*Device, Compiler);
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
	IRTPipeline* FindInFrame(const FShaderSource& Source)
	{
		IRTPipeline* Pipeline = nullptr;
		Pipelines->BeginFrame();
		Status = Pipelines->Find(Source, Pipeline);
		return Pipeline;
	}
	IRTPipeline* Get(const FShaderSource& Source)
	{
		IRTPipeline* Pipeline = nullptr;
		Status = Pipelines->GetCompute(Source, Pipeline);
		return Pipeline;
	}
	uint32_t CountMade(const std::string& Name) { return Mock().CountCalls(ERTMockCall::CreateComputePipeline, Name); }

	TRTRef<IRTDevice> Device;
	FShaderCompiler Compiler{{}};
	std::unique_ptr<FComputePipelines> Pipelines;
	FRTStatus Status;
};

TEST_F(FComputePipelinesTest, FindNeverWaitsAndGetsItsPipelineLater)
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

TEST_F(FComputePipelinesTest, WhatIsWantedCompilesSideBySide)
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

TEST_F(FComputePipelinesTest, AShaderThatDoesNotCompileIsCompiledOnce)
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

TEST_F(FComputePipelinesTest, ShortageOfMemoryIsTriedAgain)
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

TEST_F(FComputePipelinesTest, WhatNobodyUsesIsDropped)
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

} // namespace
} // namespace Lantern
