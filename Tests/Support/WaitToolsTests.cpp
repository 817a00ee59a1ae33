// The tests' own waiting: what never comes is a failure with words, and what hangs is let go.
#include <atomic>

#include <gmock/gmock.h>
#include <gtest/gtest-spi.h>

#include "Support/WaitTools.h"

namespace Lantern
{
namespace
{

using std::chrono::milliseconds;

TEST(WaitTools, WaitsForAnotherThread)
{
	std::atomic<bool> bDone = false;
	std::thread Other([&] { bDone = true; });
	EXPECT_TRUE(WaitUntil("the other thread", [&] { return bDone.load(); }));
	Other.join();
}

TEST(WaitTools, StepsUntilTheConditionHolds)
{
	int Steps = 0;
	EXPECT_TRUE(WaitUntil(
	    "three steps", [&] { return Steps == 3; }, [&] { ++Steps; }));
	EXPECT_EQ(Steps, 3);
	EXPECT_TRUE(WaitUntil(
	    "nothing", [] { return true; }, [&] { ++Steps; }));
	EXPECT_EQ(Steps, 3) << "a step too many";
}

TEST(WaitTools, WhatNeverComesIsAFailureWithItsProgress)
{
	static bool bCame = true;
	EXPECT_NONFATAL_FAILURE(bCame = WaitUntil(
	                            "Godot", [] { return false; }, {}, [] { return "0 of 1"; }, milliseconds(1)),
	    "waited in vain for Godot: 0 of 1");
	EXPECT_FALSE(bCame);
}

TEST(WaitTools, LineSaysWhatIsWaitedForAndHowFarItIs)
{
	testing::internal::CaptureStdout();
	PrintWaiting("programs", std::chrono::seconds(10), "3 of 8");
	PrintWaiting("a frame", milliseconds(5999), "");
	EXPECT_EQ(testing::internal::GetCapturedStdout(), "still waiting for programs: 10 s, 3 of 8\n"
	                                                  "still waiting for a frame: 5 s\n");
}

TEST(WaitTools, GuardLetsGoOfWhatHangsAndOfNothingElse)
{
	static std::atomic<int> LetGo;
	LetGo = 0;
	{
		const FHangGuard Guard("a call that returns", [] { ++LetGo; });
	}
	EXPECT_EQ(LetGo, 0);
	const auto Hang = [] {
		const FHangGuard Guard(
		    "a call that hangs", [] { ++LetGo; }, milliseconds(1));
		WaitUntil("the guard", [] { return LetGo > 0; });
	};
	EXPECT_NONFATAL_FAILURE_ON_ALL_THREADS(Hang(), "never came: a call that hangs");
	EXPECT_EQ(LetGo, 1);
}

} // namespace
} // namespace Lantern
