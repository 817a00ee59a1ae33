// The threads of the RTPSO compiler on a device whose compiles the test holds up: how many work, and what they hold meanwhile.
#include "Pipelines/RTPSOThreads.h"

#include <atomic>
#include <filesystem>
#include <iterator>

#include "RTPSOTestTools.h"

namespace Lantern
{
namespace
{

class FRTPSOThreadsTest : public FPipelineTest
{
protected:
	void SetUp() override
	{
		FPipelineTest::SetUp();
		Settings.RoundLength = std::chrono::hours(1); // rounds end when they are done
		UnitCompiler = std::make_unique<FUnitCompiler>(*Device, *Compiler);
		Scheduler = std::make_unique<FRTPSOScheduler>(
		    Device->GetCapabilities(), *Programs, [] { return std::chrono::steady_clock::now(); }, [this] { ToWake->Wake(); });
		Threads = std::make_unique<FRTPSOThreads>(Mutex, *Scheduler, *UnitCompiler, *Device);
		ToWake = Threads.get();
	}
	void TearDown() override
	{
		Device->Open();
		Threads.reset();
		Scheduler.reset();
		FPipelineTest::TearDown();
	}
	void Frame(uint32_t Count = 2)
	{
		const std::lock_guard Lock(Mutex);
		Threads->SetCount(Count);
		Scheduler->BeginFrame(Wanted, Settings, false);
		Scheduler->Advance();
	}
	bool IsLinked()
	{
		const std::lock_guard Lock(Mutex);
		return Scheduler->GetCurrent() != nullptr;
	}
	/// Whether the mutex becomes free without anything being done for it.
	bool IsMutexFree()
	{
		const auto IsFree = [&] { return std::unique_lock(Mutex, std::try_to_lock).owns_lock(); };
		return WaitUntil("the mutex", IsFree);
	}
	void FramesUntilLinked()
	{
		ASSERT_TRUE(WaitUntil(
		    "a pipeline", [&] { return IsLinked(); }, [&] { Frame(), GiveWay(); }));
	}

	FRTPSOSettings Settings;
	std::mutex Mutex;
	std::unique_ptr<FUnitCompiler> UnitCompiler;
	std::unique_ptr<FRTPSOScheduler> Scheduler;
	std::unique_ptr<FRTPSOThreads> Threads;
	FRTPSOThreads* ToWake = nullptr; ///< also while Threads ends them
};

TEST_F(FRTPSOThreadsTest, OneFrameIsEnoughForCompilesAndTheLink)
{
	Frame();
	ASSERT_TRUE(WaitUntil("the link", [&] { return Device->Mock().CountCalls(ERTMockCall::CreateRayTracingPipeline, "RTPSO") == 1; }));
	EXPECT_FALSE(IsLinked()) << "taken over by a frame";
	ASSERT_NO_FATAL_FAILURE(FramesUntilLinked());
	const auto Links = Device->Mock().FindCalls(ERTMockCall::CreateRayTracingPipeline, "RTPSO");
	EXPECT_EQ(Links[0].Numbers[4], 5u) << "libraries";
}

TEST_F(FRTPSOThreadsTest, TheMutexIsFreeWhileTheDriverCompilesOrLinks)
{
	Device->Close("Generate");
	Device->Close("RTPSO");
	Frame();
	ASSERT_TRUE(WaitUntil("a compile in the driver", [&] { return Device->WasAsked("Generate"); }));
	EXPECT_TRUE(IsMutexFree());
	Device->Open("Generate");
	ASSERT_TRUE(WaitUntil("a link in the driver", [&] { return Device->WasAsked("RTPSO"); }));
	EXPECT_TRUE(IsMutexFree());
	Device->Open();
	ASSERT_NO_FATAL_FAILURE(FramesUntilLinked());
}

size_t CountThreadsOfProcess()
{
	const std::filesystem::directory_iterator Tasks("/proc/self/task");
	return static_cast<size_t>(std::distance(begin(Tasks), end(Tasks)));
}

TEST_F(FRTPSOThreadsTest, AFrameStartsNoThread)
{
	const size_t Before = CountThreadsOfProcess();
	{
		const std::lock_guard Lock(Mutex); // nobody else can start one
		Threads->SetCount(4);
		EXPECT_EQ(CountThreadsOfProcess(), Before);
	}
	EXPECT_TRUE(WaitUntil("the threads", [&] { return CountThreadsOfProcess() >= Before + 4; }));
}

TEST_F(FRTPSOThreadsTest, AsManyCompileAsTheCountSays)
{
	Device->Close(""); // all
	for (const size_t Count : {1u, 3u})
	{
		Frame(static_cast<uint32_t>(Count));
		ASSERT_TRUE(WaitUntil("the driver", [&] { return Device->GetAsked().size() >= Count; }));
		for (int I = 0; I < 10; ++I) { GiveWay(); }
		EXPECT_EQ(Device->GetAsked().size(), Count);
	}
	Device->Open();
	ASSERT_NO_FATAL_FAILURE(FramesUntilLinked());
}

TEST_F(FRTPSOThreadsTest, AWaitEndsWithTheResultThatItIsFor)
{
	Frame();
	std::unique_lock Lock(Mutex);
	Threads->WaitForResult(Lock, [&] { return Scheduler->GetResultCount() >= 6; });
	EXPECT_EQ(Scheduler->GetResultCount(), 6u) << "five units and a link";
	EXPECT_FALSE(Scheduler->IsLinkUnderWay());
}

TEST_F(FRTPSOThreadsTest, WhatIsDiscardedIsDestroyedByTheBackgroundThread)
{
	std::atomic<bool> bDestroyed = false;
	std::thread::id Destroyer;
	{
		const std::lock_guard Lock(Mutex);
		Threads->SetCount(1);
		Scheduler->GetTrash().Discard(std::shared_ptr<int>(new int(0), [&](const int* Object) {
			delete Object;
			Destroyer = std::this_thread::get_id();
			bDestroyed = true;
		}));
		Threads->Wake();
	}
	ASSERT_TRUE(WaitUntil("the end of it", [&] { return bDestroyed.load(); }));
	EXPECT_NE(Destroyer, std::this_thread::get_id());
}

TEST_F(FRTPSOThreadsTest, EditsAreFoundWithoutTheMutexAndCompiledAnew)
{
	ASSERT_NO_FATAL_FAILURE(FramesUntilLinked());
	Folder.Write("Materials/Material.glsl", "float Value() { return 3.0; }\n");
	Device->ForgetAsked();
	{
		std::unique_lock Lock(Mutex);
		const uint64_t Before = Scheduler->GetResultCount();
		Scheduler->AskForEdits();
		Threads->WaitForResult(Lock, [&] { return Scheduler->GetResultCount() > Before; });
	}
	Frame();
	ASSERT_TRUE(WaitUntil("the link", [&] { return Device->WasAsked("RTPSO"); }));
	EXPECT_THAT(Device->GetAsked(), ::testing::UnorderedElementsAre("RTPSO", "Standard MATERIAL opaque", "StandIn MATERIAL opaque"));
}

} // namespace
} // namespace Lantern
