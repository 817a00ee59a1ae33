// For tests that wait for a thread or a process: a condition, what it has come to, and a limit that slow machines keep to.
#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include <gtest/gtest.h>

namespace Lantern
{

/// Tells what never comes from what is late, and nothing else. An idle machine needs seconds at most for whatever is waited
/// for; this is ten times that and more, so that it also holds under sanitizers and where other builds have the cores.
inline constexpr std::chrono::seconds WaitLimit{600};
inline constexpr uint64_t WaitLimitNs = std::chrono::nanoseconds(WaitLimit).count(); ///< as IRTDevice::WaitFor has it
inline constexpr std::chrono::seconds WaitLineInterval{5};                           ///< between lines that say what is still waited for

/// Lets other threads run. Not a time that anything may depend on.
inline void GiveWay() { std::this_thread::sleep_for(std::chrono::milliseconds(1)); }

inline void PrintWaiting(const std::string& What, std::chrono::steady_clock::duration Waited, const std::string& Progress)
{
	const auto Seconds = static_cast<long long>(std::chrono::duration_cast<std::chrono::seconds>(Waited).count());
	std::printf("still waiting for %s: %lld s%s%s\n", What.c_str(), Seconds, Progress.empty() ? "" : ", ", Progress.c_str());
	std::fflush(stdout); // or the line is lost where ctest ends the program
}

/// Polls Condition, with a Step between polls (a frame, say; none: other threads run), and prints a line every few seconds.
/// False, with a failure of the test: it did not come within Limit, or a Step had a fatal failure.
/// What: completes "still waiting for …". Progress: what there is so far, "3 of 8 programs".
inline bool WaitUntil(const std::string& What, const std::function<bool()>& Condition, const std::function<void()>& Step = {},
    const std::function<std::string()>& Progress = {}, std::chrono::steady_clock::duration Limit = WaitLimit)
{
	using FClock = std::chrono::steady_clock;
	const auto CountFailures = [] {
		const auto* const Info = ::testing::UnitTest::GetInstance()->current_test_info();
		return Info ? Info->result()->total_part_count() : 0;
	};
	const int Before = CountFailures();
	const auto Start = FClock::now();
	auto NextLine = Start + WaitLineInterval;
	while (!Condition())
	{
		if (CountFailures() > Before && ::testing::Test::HasFatalFailure()) { return false; }
		const auto Now = FClock::now();
		const std::string Text = Progress && (Now >= NextLine || Now - Start >= Limit) ? Progress() : std::string();
		if (Now - Start >= Limit)
		{
			ADD_FAILURE() << "waited in vain for " << What << (Text.empty() ? "" : ": ") << Text;
			return false;
		}
		if (Now >= NextLine)
		{
			PrintWaiting(What, Now - Start, Text);
			NextLine = Now + WaitLineInterval;
		}
		Step ? Step() : GiveWay();
	}
	return true;
}

/// Stands around calls that return at once where they are right, and never where they are wrong. The test fails when it
/// lives longer than Limit, and LetGo ends what they wait for, on a thread of the guard's own: else the program would hang.
class FHangGuard
{
public:
	FHangGuard(std::string InWhat, std::function<void()> InLetGo, std::chrono::steady_clock::duration InLimit = WaitLimit)
	    : What(std::move(InWhat)),
	      LetGo(std::move(InLetGo)),
	      Limit(InLimit),
	      Thread([this] { Watch(); })
	{}
	~FHangGuard()
	{
		{
			const std::lock_guard Lock(Mutex);
			bOver = true;
		}
		Over.notify_all();
		Thread.join();
	}
	FHangGuard(const FHangGuard&) = delete;
	FHangGuard& operator=(const FHangGuard&) = delete;

private:
	void Watch()
	{
		using FClock = std::chrono::steady_clock;
		const auto Start = FClock::now(), End = Start + Limit;
		std::unique_lock Lock(Mutex);
		for (auto Next = Start; !bOver && FClock::now() < End;)
		{
			Next = std::min(Next + FClock::duration(WaitLineInterval), End);
			if (!Over.wait_until(Lock, Next, [&] { return bOver; }) && Next < End) { PrintWaiting(What, Next - Start, {}); }
		}
		if (!bOver)
		{
			ADD_FAILURE() << "never came: " << What;
			Lock.unlock();
			LetGo();
		}
	}

	const std::string What;
	const std::function<void()> LetGo;
	const std::chrono::steady_clock::duration Limit;
	std::mutex Mutex;
	std::condition_variable Over;
	bool bOver = false;
	std::thread Thread; ///< last: it uses all of the above
};

} // namespace Lantern
