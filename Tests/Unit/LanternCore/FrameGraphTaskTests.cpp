// Passes that tasks record: their lists, their order on the device, and errors.
#include <algorithm>
#include <atomic>

#include <gmock/gmock.h>

#include "FrameGraphTestBase.h"
#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternCore/Tasks/Tasks.h"
#include "Support/WakeWorkers.h"

namespace Lantern
{
namespace
{

using testing::ElementsAre;

class FFrameGraphTaskTest : public FFrameGraphTestBase
{
protected:
	void SetUp() override
	{
		FFrameGraphTestBase::SetUp();
		SetTasks(true);
	}
	void TearDown() override
	{
		Lists.clear();
		FConsoleVariables::Get().ResetAll();
		FConsoleVariables::Get().BeginFrame();
		FFrameGraphTestBase::TearDown();
	}
	static void SetTasks(bool bTasks)
	{
		EXPECT_FALSE(FConsoleVariables::Get().Set("r.RT.FrameGraph.Tasks", bTasks ? "1" : "0", ERTSetBy::Console, "test"));
		FConsoleVariables::Get().BeginFrame();
	}
	/// A pass of one mark, which a task records.
	void AddTaskPass(FFrameGraph& Graph, const char* Name, std::vector<FTestUse> Reads, std::vector<FTestUse> Writes,
	    const std::function<void()>& Body = {})
	{
		Graph.AddPass(Name, [&](FPassBuilder& Builder) -> FPassExecute {
			for (const FTestUse& Use : Reads) { Builder.Read(Use.Texture, Use.Access); }
			for (const FTestUse& Use : Writes) { Builder.Write(Use.Texture, Use.Access); }
			Builder.NeverCull();
			Builder.RecordOnTask();
			return [Body](FPassContext&) {
				if (Body) { Body(); }
			};
		});
	}
	FGraphRecorder MakeRecorder()
	{
		return {[this](ERTQueue, IRTCommandList*& Out) {
			const std::string Name = "List" + std::to_string(Lists.size());
			FRTStatus Status = Device->CreateCommandList(Name.c_str(), Lists.emplace_back().ReleaseAndGetAddress());
			Out = Lists.back().Get();
			return Status ? Out->Begin() : Status;
		        },
		    [this] { return Failure; }};
	}
	/// Executes into several lists and submits them.
	FRTStatus ExecuteOnTasks(FFrameGraph& Graph)
	{
		Lists.clear();
		FRTStatus Status = Graph.Execute(MakeRecorder());
		std::vector<IRTCommandList*> Raw;
		for (const TRTRef<IRTCommandList>& Item : Lists)
		{
			EXPECT_TRUE(Item->End().IsOk());
			Raw.push_back(Item.Get());
		}
		return Status ? Device->Submit(Raw.data(), static_cast<uint32_t>(Raw.size()), &Fence) : Status;
	}
	/// Skin → [A] → [B] → Light: those in brackets are recorded by tasks.
	std::vector<std::string> TraceFrame()
	{
		Mock().ClearCalls();
		FFrameGraph Graph(*Resources);
		const FGraphTexture A = MakeTexture(Graph, "A"), B = MakeTexture(Graph, "B");
		const FGraphTexture Out = ImportTexture(Graph, "Out", ERTAccess::None, ERTAccess::ShaderRead);
		AddPass(Graph, "Skin", {}, {{A, Storage}});
		AddTaskPass(Graph, "MakeA", {{A, ERTAccess::StorageRead}}, {{A, Storage}});
		AddTaskPass(Graph, "MakeB", {{A, Sampled}}, {{B, Storage}});
		AddPass(Graph, "Light", {{A, Sampled}, {B, Sampled}}, {{Out, Storage}});
		const FRTStatus Status = ExecuteOnTasks(Graph);
		EXPECT_TRUE(Status.IsOk()) << Status.Message;
		return Trace();
	}

	std::vector<TRTRef<IRTCommandList>> Lists;
	FRTStatus Failure;
};

// The device sees the same commands in the same order, whoever records them.
TEST_F(FFrameGraphTaskTest, OrderOnTheDeviceIsThatOfOneList)
{
	SetTasks(false);
	(void)TraceFrame(); // the pool is filled
	const std::vector<std::string> Alone = TraceFrame();
	EXPECT_EQ(Lists.size(), 1u);
	SetTasks(true);
	for (int I = 0; I < 50; ++I)
	{
		ASSERT_EQ(TraceFrame(), Alone);
		ASSERT_EQ(Lists.size(), 4u);
	}
	EXPECT_THAT(Mock().GetErrors(), testing::IsEmpty());
}

TEST_F(FFrameGraphTaskTest, PassesAreRecordedAtOnce)
{
	if (GetWorkerCount() < 2) { GTEST_SKIP() << "one core"; }
	FFrameGraph Graph(*Resources);
	std::atomic<bool> bStarted = false;
	bool bSeen = false;
	FWakeWorkers Wake;
	Graph.AddPass("Waits", [&](FPassBuilder& Builder) -> FPassExecute {
		Builder.NeverCull();
		return [&](FPassContext&) {
			bSeen = WaitUntil(
			    "the task's pass", [&] { return bStarted.load(); }, std::ref(Wake));
		};
	});
	AddTaskPass(Graph, "Starts", {}, {}, [&] { bStarted = true; });
	ASSERT_TRUE(ExecuteOnTasks(Graph).IsOk());
	EXPECT_TRUE(bSeen) << "though it is behind the one that waits";
}

TEST_F(FFrameGraphTaskTest, TimingsAreInTheOrderOfPasses)
{
	for (int Frame = 0; Frame < 2; ++Frame) { (void)TraceFrame(); }
	std::vector<std::string> Names;
	for (const FPassTiming& Timing : Resources->GetTimings())
	{
		Names.push_back(Timing.Name);
		EXPECT_GT(Timing.GpuMs, 0.0) << Timing.Name;
	}
	EXPECT_THAT(Names, ElementsAre("Skin", "MakeA", "MakeB", "Light"));
}

TEST_F(FFrameGraphTaskTest, NothingIsRecordedAfterAFailure)
{
	FFrameGraph Graph(*Resources);
	std::atomic<int> Recorded = 0;
	Failure = FRTStatus::Error(ERTResult::OutOfDeviceMemory, "before the first");
	AddTaskPass(Graph, "A", {}, {}, [&] { ++Recorded; });
	AddTaskPass(Graph, "B", {}, {}, [&] { ++Recorded; });
	EXPECT_EQ(ExecuteOnTasks(Graph).Code, ERTResult::OutOfDeviceMemory);
	EXPECT_EQ(Recorded.load(), 0);
}

TEST_F(FFrameGraphTaskTest, ListsThatCannotBeHadAreAnError)
{
	FFrameGraph Graph(*Resources);
	AddTaskPass(Graph, "A", {}, {});
	FGraphRecorder Recorder = MakeRecorder();
	Recorder.NextList = [&](ERTQueue, IRTCommandList*& Out) {
		Out = nullptr;
		return FRTStatus::Error(ERTResult::OutOfHostMemory, "no list");
	};
	EXPECT_EQ(Graph.Execute(Recorder).Code, ERTResult::OutOfHostMemory);
}

} // namespace
} // namespace Lantern
