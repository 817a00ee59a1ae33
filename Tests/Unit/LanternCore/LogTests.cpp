#include <stdexcept>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "Support/CoreTestTools.h"
#include "Support/TextCheck.h"

namespace Lantern
{
namespace
{

using testing::ElementsAre;

class Log : public testing::Test
{
protected:
	~Log() override
	{
		SetLogSink({});
		SetLogLevel(ERTLogLevel::Info);
	}
};

TEST_F(Log, StandardErrorGetsTheLevelAndNoColourUnlessATerminal)
{
	// GoogleTest lays a file under standard error, which is no terminal.
	testing::internal::CaptureStderr();
	testing::internal::CaptureStdout();
	LogInfo("plain {}", 1);
	LogWarning("careful {}", 2);
	LogError("broken {{}}");
	LogDebug("hidden");
	EXPECT_EQ(testing::internal::GetCapturedStderr(), "plain 1\nwarning: careful 2\nerror: broken {}\n");
	EXPECT_EQ(testing::internal::GetCapturedStdout(), "") << "results belong there, not the log";
}

TEST_F(Log, TextIsNeverReadAsAFormat)
{
	testing::internal::CaptureStderr();
	LogLine(ERTLogLevel::Info, "100 % {} {0} %v %^");
	EXPECT_EQ(testing::internal::GetCapturedStderr(), "100 % {} {0} %v %^\n");
}

TEST_F(Log, WhatNobodyEscapedIsEscapedByTheSink)
{
	const std::string Raw("a\x1b[31m\0\xff\u202E\u0085\r\nb\tc", 18);
	const std::string Shown = "a\\x1b[31m\\x00\\xff\\u{202e}\\u{0085}\\r\nb\tc";
	testing::internal::CaptureStderr();
	LogLine(ERTLogLevel::Error, Raw);
	EXPECT_EQ(testing::internal::GetCapturedStderr(), "error: " + Shown + "\n") << "lines stay lines: logs of compilers have several";
	FLogCapture Capture;
	LogWarning("{}", Raw);
	LogOnce(ERTLogLevel::Info, Raw);
	EXPECT_THAT(Capture.GetTexts(), ElementsAre(Shown, Shown));
	for (int Byte = 0; Byte < 256; ++Byte) LogLine(ERTLogLevel::Info, std::string(1, static_cast<char>(Byte)));
	for (const std::string& Text : Capture.GetTexts()) EXPECT_TRUE(AreCleanLines(Text)) << Text;
	testing::internal::CaptureStderr();
	SetLogSink([&](ERTLogLevel, std::string_view) { LogInfo("{}", Raw); });
	LogInfo("outside");
	EXPECT_EQ(testing::internal::GetCapturedStderr(), Shown + "\n") << "from inside a sink";
}

TEST_F(Log, TheSinkReplacesStandardErrorAndAnEmptyOneRestoresIt)
{
	testing::internal::CaptureStderr();
	{
		FLogCapture Capture;
		LogWarning("to the sink");
		EXPECT_THAT(Capture.GetTexts(), ElementsAre("to the sink"));
		EXPECT_EQ(Capture.Count(ERTLogLevel::Warning), 1u);
	}
	LogWarning("back");
	EXPECT_EQ(testing::internal::GetCapturedStderr(), "warning: back\n");
}

TEST_F(Log, TheLevelHidesWhatIsBelow)
{
	FLogCapture Capture;
	SetLogLevel(ERTLogLevel::Error);
	LogDebug("d");
	LogInfo("i");
	LogWarning("w");
	LogError("e");
	SetLogLevel(ERTLogLevel::Debug);
	LogDebug("d2");
	EXPECT_THAT(Capture.GetTexts(), ElementsAre("e", "d2"));
}

TEST_F(Log, OnceIsOncePerTextAndOnlyCountsWhenShown)
{
	FLogCapture Capture;
	SetLogLevel(ERTLogLevel::Error);
	LogOnce(ERTLogLevel::Warning, "once: a");
	SetLogLevel(ERTLogLevel::Info);
	for (int I = 0; I < 3; ++I)
	{
		LogOnce(ERTLogLevel::Warning, "once: a");
		LogOnce(ERTLogLevel::Warning, "once: b");
	}
	EXPECT_THAT(Capture.GetTexts(), ElementsAre("once: a", "once: b"));
}

TEST_F(Log, ASinkMayLogThrowAndReplaceItself)
{
	int Calls = 0;
	testing::internal::CaptureStderr();
	SetLogSink([&](ERTLogLevel, std::string_view) {
		++Calls;
		LogInfo("from inside");
	});
	LogInfo("outside");
	SetLogSink([](ERTLogLevel, std::string_view) { throw std::runtime_error("sink"); });
	EXPECT_NO_THROW(LogInfo("kept"));
	SetLogSink([&](ERTLogLevel, std::string_view) { SetLogSink({}); });
	LogInfo("swallowed");
	LogInfo("after");
	EXPECT_EQ(Calls, 1);
	EXPECT_EQ(testing::internal::GetCapturedStderr(), "from inside\nkept\nafter\n");
}

TEST_F(Log, LinesOfThreadsStayWhole)
{
	std::vector<std::string> Lines; // not guarded: the log calls one sink at a time
	SetLogSink([&](ERTLogLevel, std::string_view Text) { Lines.emplace_back(Text); });
	std::vector<std::thread> Threads;
	for (int Thread = 0; Thread < 4; ++Thread)
		Threads.emplace_back([Thread] {
			for (int I = 0; I < 200; ++I)
			{
				LogInfo("{}", std::string(40, static_cast<char>('a' + Thread)));
				LogOnce(ERTLogLevel::Info, "threads: the same");
				LogDebug("{}", I);
			}
		});
	for (int I = 0; I < 20; ++I) SetLogLevel(I % 2 ? ERTLogLevel::Info : ERTLogLevel::Debug);
	for (std::thread& Thread : Threads) Thread.join();
	SetLogSink({});
	const auto IsLetters = [](const std::string& Line) {
		return Line.size() == 40 && Line.find_first_not_of(Line[0]) == std::string::npos;
	};
	EXPECT_EQ(std::count_if(Lines.begin(), Lines.end(), IsLetters), 800);
	EXPECT_EQ(std::count(Lines.begin(), Lines.end(), "threads: the same"), 1);
}

} // namespace
} // namespace Lantern
